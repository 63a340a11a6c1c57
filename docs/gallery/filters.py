"""
Windows and overshoot
=====================

A series that is cut off rings at steps: it goes 9 % too far, at any degree. Windows let the
degrees fall off smoothly, for less overshoot and wider flanks.
"""

import numpy as np
import rholm
from matplotlib import pyplot as plt

# %%
# A ball with a plateau: the radius is 1.2 around the north pole, and 1 elsewhere.

ball = rholm.icosphere(7)
high = ball.vertices[:, 2] > 0.5
step = rholm.Mesh(ball.vertices * np.where(high, 1.2, 1)[:, None], ball.faces)
s = rholm.expand(step, degree=160, center="none")

filtered = {
    "ideal": s.low_pass(32, "ideal"),
    "lanczos": s.low_pass(32, "lanczos"),
    "gaussian": s.low_pass(32, "gaussian"),
    "heat": s.low_pass(32, "heat"),
}
panels = [rholm.Panel(f.mesh(7), name) for name, f in filtered.items()]
rholm.render(panels, (1400, 380), view=(-0.55, 0.75, -0.6))

# %%
# The profile from the pole to the equator, and how far each filter goes beyond a step, in parts of its
# height.

theta = np.linspace(0, np.pi / 2, 800)
directions = np.stack([np.sin(theta), 0 * theta, np.cos(theta)], axis=1)
figure, ax = plt.subplots()
for name, f in filtered.items():
    above = rholm.harmonics.overshoot(name, 32).above
    ax.plot(np.degrees(theta), f(directions), label=f"{name}: {above:.2%}")
ax.plot(np.degrees(theta), np.where(theta < np.pi / 3, 1.2, 1), ":", color="0.4")
ax.set(xlabel="angle from the pole, degrees", ylabel="radius", title="Cut off at degree 32")
ax.legend()
plt.show()

# %%
# Other filters of the same kind: `rholm.band_pass` keeps a band, `rholm.harmonics.sharpened` adds
# what a low pass takes away, and any array of gains will do.

body = rholm.expand(rholm.bumpy_sphere(6, 0.35, seed=5), degree=64)
low = rholm.low_pass(8, 64, "heat")
panels = [
    rholm.Panel(body.filter(low), "low pass"),
    rholm.Panel(body, "as it was"),
    rholm.Panel(body.filter(rholm.harmonics.sharpened(low, 0.7)), "sharpened"),
]
rholm.render(panels, (1200, 380))
