"""
Levels of detail
================

A series that is cut off at a low degree is a smooth version of the same body. All levels come out of
one expansion, on the same triangles, with the exact normals of their surfaces.
"""

import numpy as np
import rholm

# %%
# A body with craters: a smooth lump, and bowls with a raised rim, many small ones and few large ones.


def cratered(subdivisions: int, n: int = 250, seed: int = 2) -> rholm.Mesh:
    """A lump of radius 1 with n craters."""
    random = np.random.default_rng(seed)
    lump = rholm.bumpy_sphere(subdivisions, 0.3, seed)
    u = rholm.icosphere(subdivisions).vertices
    middles = random.normal(size=(n, 3))
    middles /= np.linalg.norm(middles, axis=1, keepdims=True)
    radii = 0.045 / random.uniform(0.08, 1, n)
    height = np.zeros(len(u))
    for middle, radius in zip(middles, radii, strict=True):
        x = np.arccos(np.clip(u @ middle, -1, 1)) / radius
        bowl = np.where(x < 1, 0.25 * (x**2 - 1), 0)
        height += radius * (bowl + 0.1 * np.exp(-(((x - 1) / 0.25) ** 2)))
    return rholm.Mesh(lump.vertices * (1 + 0.6 * height)[:, None], lump.faces)


body = cratered(7)
s = rholm.expand(body, degree=128)
print(s)
print(f"{len(body.faces)} triangles, volume {s.volume:.4f}")

# %%
# Four degrees, and the mesh itself.

degrees = (4, 16, 48, 128)
panels = [
    rholm.Panel(mesh, f"L = {degree}")
    for degree, mesh in zip(degrees, s.meshes(degrees, 7), strict=True)
]
rholm.render([*panels, rholm.Panel(body, "mesh")], (1600, 380))

# %%
# The spectrum tells the truncation error of a degree before a mesh is made. It is the rms of all higher
# degrees, by Parseval's identity, from the norm of the mesh in closed form.

for degree in degrees:
    beyond = s.norm_squared - s.spectrum("energy")[: degree + 1].sum()
    numbers = (degree + 1) ** 2
    print(f"L = {degree:3}: {numbers:6} numbers, rms {np.sqrt(beyond / (4 * np.pi)):.5f}")
