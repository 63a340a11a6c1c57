"""
A scratch, and a slider
=======================

Detail finer than a wavelength goes from a region; what is outside stays to the last bit. The slow part is
done once, then the strength is a property that moves the vertices where they lie.
"""

import numpy as np
import rholm
from matplotlib import pyplot as plt

# %%
# A bumpy body with a bent scratch.

body = rholm.bumpy_sphere(7, 0.25, seed=4)
u = rholm.icosphere(7).vertices
side = u[:, 0] - 0.12 * np.sin(6 * u[:, 2]) + 0.1
depth = (
    0.035
    * np.exp(-((side / 0.022) ** 2))
    * (u[:, 1] < 0)
    / (1 + np.exp((abs(u[:, 2]) - 0.5) / 0.02))
)
scratched = rholm.Mesh(body.vertices * (1 - depth)[:, None], body.faces)

# %%
# Three ways: everything finer than the wavelength goes from a ball; only what stands out goes; the scratch
# is painted, and bridged from what is around it.

ball = "ball:0,-1,0,0.85"
painted = depth > 0.0008
ways = {
    "as it is": scratched,
    "smoothed": rholm.smooth(scratched, ball, 0.35, fitting="mean"),
    "repaired": rholm.smooth(scratched, ball, 0.35, repair=True),
    "bridged": rholm.smooth(scratched, painted, 0.25, fitting="around"),
}
view = (0, 1, -0.25)
rholm.render(
    [rholm.Panel(mesh, name) for name, mesh in ways.items()], (1300, 340), view=view
)

# %%
# How far each is from the body without the scratch, along the scratch and in the ball around it.
# Vertices that are outside of both have not moved.

around = rholm.meshes.region_weights(scratched, ball) > 0.5
for name, mesh in ways.items():
    off = np.linalg.norm(mesh.vertices - body.vertices, axis=1)
    along = np.sqrt(np.mean(off[painted] ** 2))
    else_ = np.sqrt(np.mean(off[around & ~painted] ** 2))
    print(f"{name:9} rms {along:.5f} along the scratch, {else_:.5f} around it")

# %%
# The slider: 0 leaves all as it is, 1 takes the detail away, -1 doubles it.

editor = rholm.meshes.analyze_patch(scratched, ball, 0.35)
panels = []
for strength in (-1, 0, 0.5, 1):
    editor.strength = strength
    shown = editor.mesh.copy()  # the editor's own moves on
    panels.append(rholm.Panel(shown, f"strength {strength}"))
rholm.render(panels, (1300, 340), view=view)

# %%
# A cut across the scratch: heights over the body that never had it.

cut = np.flatnonzero((abs(u[:, 2]) < 0.008) & (u[:, 1] < 0) & (abs(u[:, 0] + 0.1) < 0.4))
cut = cut[np.argsort(u[cut, 0])]
figure, ax = plt.subplots()
for name, mesh in ways.items():
    height = np.linalg.norm(mesh.vertices[cut], axis=1) - np.linalg.norm(
        body.vertices[cut], axis=1
    )
    ax.plot(u[cut, 0], height, label=name)
ax.set(xlabel="x of the direction", ylabel="height over the body without a scratch")
ax.legend()
plt.show()
