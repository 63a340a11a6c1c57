"""
New grains from a spectrum
==========================

Grains of one sample differ, but share a spectrum. New ones have random coefficients with the energies
of a grain that was measured; its roughness can be turned up and down, degree by degree.
"""

import numpy as np
import rholm
from matplotlib import pyplot as plt

# %%
# The grain that was measured: a stone with facets, made by cutting a ball with random planes.

random = np.random.default_rng(7)
ball = rholm.icosphere(6)
normals = random.normal(size=(26, 3))
normals /= np.linalg.norm(normals, axis=1, keepdims=True)
heights = random.uniform(0.75, 1.0, 26)
with np.errstate(divide="ignore"):
    cuts = np.where(
        ball.vertices @ normals.T > 0.05, heights / (ball.vertices @ normals.T), np.inf
    )
grain = rholm.Mesh(
    ball.vertices * np.minimum(cuts.min(axis=1), 1.15)[:, None] * [1.25, 1, 0.85],
    ball.faces,
)
s = rholm.expand(grain, degree=48, length_unit="mm")

# %%
# Draws with the same energy in every degree.


def alike(s: rholm.Expansion, seed: int, rougher: float = 1.0) -> rholm.Expansion:
    """A grain with the spectrum of s; from degree 5 on heights are multiplied."""
    random = np.random.default_rng(seed)
    c = np.zeros_like(s.coeffs)
    c[0, 0, 0] = s.coeffs[0, 0, 0]
    for l in range(1, s.degree + 1):
        draw = random.normal(size=(2, l + 1))
        draw[1, 0] = 0
        c[:, l, : l + 1] = (
            draw * np.sqrt(s.spectrum()[l] / (draw**2).sum()) * (rougher if l > 4 else 1)
        )
    return rholm.from_array(c, unit=s.unit)


panels = [rholm.Panel(grain, "measured")] + [
    rholm.Panel(alike(s, seed).mesh(6), f"seed {seed}") for seed in range(1, 5)
]
rholm.render(panels, (1700, 400))

# %%
# Rougher and smoother ones of the same form.

panels = [rholm.Panel(alike(s, 2, k).mesh(6), f"heights times {k}") for k in (0, 0.5, 1, 2)]
rholm.render(panels, (1500, 420))

# %%
# Sphericity falls as roughness grows: the surface of a ball of the same volume over the grain's surface.


def sphericity(s: rholm.Expansion) -> float:
    """Of Wadell."""
    return float(np.pi ** (1 / 3) * (6 * s.volume) ** (2 / 3) / s.area)


factors = np.linspace(0, 2.5, 6)
figure, ax = plt.subplots()
for seed in range(1, 5):
    ax.plot(
        factors,
        [sphericity(alike(s, seed, k)) for k in factors],
        "o-",
        label=f"seed {seed}",
    )
ax.axhline(sphericity(s), color="0.4", linestyle=":", label="measured")
ax.set(xlabel="heights of degrees above 4, times", ylabel="sphericity")
ax.legend()
plt.show()
