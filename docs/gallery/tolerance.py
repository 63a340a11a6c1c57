"""
An error instead of a degree
============================

``tolerance`` finds the smallest degree that keeps an error. The error is measured along rays or between
the surfaces, as rms or largest value, in the unit of the mesh or as a part of its size. The plots
show the wanted and the reached error, and the picture shows where the error is.
"""

# sphinx_gallery_thumbnail_number = 2
import numpy as np
import rholm
from matplotlib import pyplot as plt

# %%
# A rounded cube with fine ripples on one side: hard for low degrees at its edges.

ball = rholm.icosphere(7)
x = ball.vertices
cube = (np.abs(x) ** 8).sum(axis=1) ** (-1 / 8)
ripples = 0.01 * np.sin(40 * x[:, 2]) * np.exp(-((x[:, 0] - 1) ** 2) / 0.2)
body = rholm.Mesh(x * (cube + ripples)[:, None], ball.faces)

# %%
# Tolerances over two decades, of the rms and of the largest distance between the surfaces.

wanted = np.geomspace(1e-2, 2e-4, 7)
figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.6))
for norm in ("rms", "max"):
    found = [
        rholm.expand(body, tolerance=t, unit="diagonal", norm=norm, rays=0) for t in wanted
    ]
    kept = [s.expanded.tolerance for s in found]
    reached = [report.reached / body.bounds.diagonal for report in kept if report]
    left.loglog(wanted, reached, "o-", label=norm)
    right.semilogx(wanted, [s.degree for s in found], "o-", label=norm)
left.loglog(wanted, wanted, ":", color="0.5", label="allowed")
left.set(xlabel="tolerance, parts of the diagonal", ylabel="reached")
right.set(xlabel="tolerance, parts of the diagonal", ylabel="degree")
left.legend()
right.legend()
plt.show()

# %%
# Where the error is: distances of the vertices of three surfaces to the mesh. At low degree the edges of
# the cube and all ripples are missing; then the ripples come, and corners are left.

panels = []
for t in (5e-3, 2e-3, 5e-4):
    s = rholm.expand(body, tolerance=t, unit="diagonal")
    surface = s.mesh(7)
    error = rholm.meshes.distances_to_surface(surface.vertices, body)
    panels.append(
        rholm.Panel(surface, f"{t:g} of the diagonal: L = {s.degree}", scalars=error)
    )
rholm.render(
    panels, (1400, 480), view=(-0.8, 0.45, -0.4), scale=(0, 0.02), scale_label="distance"
)
