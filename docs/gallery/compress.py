"""
A knot as few caps
==================

Large caps, each a function on its own sphere, cover a shape that is visible from no single centre. You name
an error; number, places and degrees of the caps are found.
"""

import numpy as np
import rholm

# %%
# A tube around the knot (2, 3), as a mesh.


def torus_knot(n: int = 400, m: int = 30, tube: float = 0.5) -> rholm.Mesh:
    """A closed tube of 2 n m triangles."""
    t = 2 * np.pi * np.arange(n) / n
    line = np.stack(
        [
            (2 + np.cos(3 * t)) * np.cos(2 * t),
            (2 + np.cos(3 * t)) * np.sin(2 * t),
            np.sin(3 * t),
        ],
        1,
    )
    along = np.roll(line, -1, axis=0) - np.roll(line, 1, axis=0)
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    side = np.cross(along, line - 2 * np.stack([np.cos(2 * t), np.sin(2 * t), 0 * t], 1))
    side /= np.linalg.norm(side, axis=1, keepdims=True)
    up = np.cross(side, along)
    s = 2 * np.pi * np.arange(m) / m
    rings = line[:, None] + tube * (
        np.cos(s)[:, None] * up[:, None] + np.sin(s)[:, None] * side[:, None]
    )
    i, j = np.divmod(np.arange(n * m), m)
    a, b, c, d = (
        i * m + j,
        (i + 1) % n * m + j,
        (i + 1) % n * m + (j + 1) % m,
        i * m + (j + 1) % m,
    )
    return rholm.Mesh(
        rings.reshape(-1, 3),
        np.concatenate([np.stack([a, d, b], 1), np.stack([d, c, b], 1)]),
    )


knot = torus_knot()
a = rholm.compress(knot, 2e-3, unit="diagonal")
print(a)
print(f"tolerance kept: {a.report.met}, parts and handles kept: {a.report.topology_kept}")
print(
    f"numbers: {a.size.numbers}, in the mesh {a.input_numbers}: {a.size.numbers / a.input_numbers:.1%}"
)

# %%
# The mesh, the surface of the caps, and the caps in colours: each vertex has the colour of the
# cap with the largest weight there.

surface = a.mesh()
view, up = (0, 0.45, -1), (0, 1, 0)
rholm.render(
    [
        rholm.Panel(knot, "mesh"),
        rholm.Panel(surface, "from the caps"),
        rholm.Panel(a.colored(surface), "the caps"),
    ],
    (1400, 440),
    view=view,
    up=up,
)

# %%
# Distances to the mesh, in parts of the diagonal: of all degrees, and of caps that are cut off at degree 4.
# They are largest where caps meet; their rms is within what was asked for.

print(f"rms {a.errors.rms / a.diagonal:.5f}, largest {a.errors.max / a.diagonal:.4f}")
panels = []
for shown, label in (
    (surface, f"degrees up to {a.degree}"),
    (a.mesh(degree=4), "degree 4 at most"),
):
    error = rholm.meshes.distances_to_surface(shown.vertices, knot) / a.diagonal
    panels.append(rholm.Panel(shown, label, scalars=error))
rholm.render(
    panels,
    (1000, 420),
    scale=(0, 0.01),
    scale_label="distance, parts of the diagonal",
    view=view,
    up=up,
)
