"""
Detail of one surface on another
================================

The texture of a patch consists of heights over its smooth base. It is laid on a patch of another mesh:
turned to fit, scaled, or repeated side by side until the region is full.
"""

import numpy as np
import rholm

# %%
# The source: a ball with scales. The target: a smooth bowl-like body.

ball = rholm.icosphere(7)
u = ball.vertices
a, b = u[:, 0] * 26, u[:, 1] * 26
scales = np.abs(np.cos(a) + np.cos(0.5 * a + 0.87 * b) + np.cos(0.5 * a - 0.87 * b)) / 3
source = rholm.Mesh(u * (1 + 0.05 * scales * (u[:, 2] > 0))[:, None], ball.faces)

v = rholm.icosphere(7)
z = v.vertices[:, 2]
target = rholm.Mesh(
    v.vertices * (1 + 0.25 * z - 0.3 * (1 - z**2) ** 2)[:, None] * [1.1, 1.1, 1.2],
    v.faces,
)

# %%
# Once, at the size of the target's region; and at half of it, side by side. Copies meet where they
# agree best.

from_, to = "ball:0,0,1,0.5", "ball:0.45,-0.45,0.8,0.75"
once = rholm.transfer(source, from_, target, to)
repeated = rholm.transfer(source, from_, target, to, scale=0.5, repeat=True, refine=True)
panels = [
    rholm.Panel(source, "source"),
    rholm.Panel(target, "target"),
    rholm.Panel(once, "once"),
    rholm.Panel(repeated, "half as large, repeated"),
]
rholm.render(panels, (1300, 360), view=(-0.4, 0.55, -0.7), fit_each=True)

# %%
# Sliders need the analysis only once: after it, height and angle move the vertices in place.

editor = rholm.meshes.analyze_transfer(source, from_, target, to)
report = editor.report
print(
    f"lengths times {report.scale:.2f}; height of the texture {report.source_rms:.4f} rms"
)
panels = []
for height, angle in ((0.5, 0), (1, 0), (2, 0), (2, np.pi / 6)):
    editor.set(height=height, angle=angle)
    shown = rholm.Mesh(editor.mesh.vertices, editor.mesh.faces)
    panels.append(rholm.Panel(shown, f"height {height}, {np.degrees(angle):.0f} degrees"))
rholm.render(panels, (1300, 360), view=(-0.4, 0.55, -0.7))

# %%
# Outside of the region and its transition nothing has moved.

moved = np.zeros(len(target.vertices), bool)
moved[editor.vertices] = True
still = np.array_equal(editor.mesh.vertices[~moved], target.vertices[~moved])
print(
    f"{moved.sum()} of {len(moved)} vertices may move; all others are the same bits: {still}"
)
