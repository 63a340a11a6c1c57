"""
A surface from noisy points
===========================

Points with colours, noise, outliers and gaps become a closed surface, coloured like the points. Nothing
is chosen by hand: what was found in the points stands in the report.
"""

import numpy as np
import rholm

# %%
# A scan of a ring of beads: 40 000 points with noise, 2 % of them anywhere in the box, and five gaps.

ring = rholm.torus(1, 0.32, 240, 90)
phi = np.arctan2(ring.vertices[:, 1], ring.vertices[:, 0])
line = np.stack([np.cos(phi), np.sin(phi), 0 * phi], axis=1)
beads = rholm.Mesh(
    line + (ring.vertices - line) * (1 + 0.28 * np.cos(9 * phi))[:, None], ring.faces
)
scan = rholm.sample_surface(
    beads,
    40_000,
    noise=0.002,
    outliers=0.02,
    holes=5,
    hole_radius=0.045,
    normals=False,
    seed=3,
)


def colors_at(points: np.ndarray) -> np.ndarray:
    """A colour that runs around the ring."""
    angle = np.arctan2(points[:, 1], points[:, 0])
    return np.asarray(150 + 90 * np.cos(angle[:, None] + [0, 2.1, 4.2]), np.uint8)


scan = rholm.clouds.as_points(scan, attributes={"rgb": colors_at(scan.points)})
r = rholm.reconstruct(scan)
kept = rholm.reconstruct(scan, holes="keep")
rholm.render(
    [
        rholm.Panel(scan, f"{len(scan)} points"),
        rholm.Panel(r, "surface"),
        rholm.Panel(kept, "holes kept open"),
    ],
    (1500, 460),
    view=(-0.2, 0.6, -0.8),
)

# %%
# The table compares the values that were found with the true ones.

diagonal = beads.bounds.diagonal
report = r.report
print(
    f"noise {report.noise / diagonal:.4f} of the diagonal (0.002),"
    f" {report.outliers} outliers, {report.holes} holes closed"
)
what = r.mesh.inspect()
print(
    f"closed {what.closed}, manifold {what.manifold}, genus {what.genus}, {what.faces} faces"
)
distance = rholm.compare(beads, r.mesh)
print(
    f"rms distance of the surface to the ring {distance.b_to_a.rms / diagonal:.5f} of the diagonal"
)

# %%
# The error where it is. It is largest where there were no points.

error = rholm.meshes.distances_to_surface(r.mesh.vertices, beads) / diagonal
rholm.render(
    r.mesh,
    (1000, 520),
    scalars=error,
    view=(-0.2, 0.6, -0.8),
    scale=(0, 0.004),
    scale_label="distance to the ring, parts of the diagonal",
)
