"""
Descriptors of a population
===========================

The energy per degree does not change when a shape turns. Sixty bodies of three kinds, each turned
at random, are told apart by eleven numbers each.
"""

import numpy as np
import rholm
from matplotlib import pyplot as plt

# %%
# Round ones, long ones, and lumpy ones.

ball = rholm.icosphere(4)
kinds = {
    "round": (0.06, (1, 1, 1)),
    "long": (0.12, (1.5, 0.9, 0.8)),
    "lumpy": (0.28, (1, 1, 1)),
}


def body(kind: str, seed: int) -> rholm.Mesh:
    """One of a kind, turned at random."""
    random = np.random.default_rng(seed)
    amplitude, size = kinds[kind]
    vertices = (
        rholm.bumpy_sphere(4, amplitude, seed).vertices
        * size
        * random.uniform(0.95, 1.05, 3)
    )
    return rholm.Mesh(
        rholm.harmonics.rotate(
            vertices, rholm.harmonics.as_rotation(random.normal(size=4))
        ),
        ball.faces,
    )


bodies = [
    (kind, body(kind, 100 * k + i)) for k, kind in enumerate(kinds) for i in range(20)
]
shown = [
    rholm.Panel(bodies[20 * k + i][1], kind)
    for k, kind in enumerate(kinds)
    for i in range(2)
]
rholm.render(shown, (1500, 330))

# %%
# The descriptor: rms height of the waves of each degree from 2 on, in mean radii, about the centroid. Means
# of each kind, and a standard deviation to both sides.

models = [
    rholm.expand(mesh, degree=12, center="volume", errors=False) for _, mesh in bodies
]
features = np.array([np.log(np.sqrt(s.spectrum()[2:]) / s.mean_radius) for s in models])
labels = np.array([kind for kind, _ in bodies])

degrees = np.arange(2, 13)
figure, ax = plt.subplots()
for kind in kinds:
    mean, spread = (
        features[labels == kind].mean(axis=0),
        features[labels == kind].std(axis=0),
    )
    ax.semilogy(degrees, np.exp(mean), "o-", label=kind)
    ax.fill_between(degrees, np.exp(mean - spread), np.exp(mean + spread), alpha=0.2)
ax.set(xlabel="degree l", ylabel="rms height / mean radius")
ax.legend()
plt.show()

# %%
# Their first two principal components, and the share of bodies whose nearest neighbour is of their own kind.

centred = features - features.mean(axis=0)
_, _, axes = np.linalg.svd(centred, full_matrices=False)
places = centred @ axes[:2].T
far = np.linalg.norm(centred[:, None] - centred[None], axis=2) + 1e9 * np.eye(len(centred))
print(f"nearest of the same kind: {np.mean(labels[far.argmin(axis=1)] == labels):.0%}")

figure, ax = plt.subplots(figsize=(6, 4.2))
for kind in kinds:
    ax.scatter(*places[labels == kind].T, label=kind, s=26)
ax.set(xlabel="first component", ylabel="second component")
ax.legend()
plt.show()

# %%
# The descriptor has limits: a body and its mirror image have the same energies, and a long body and a flat
# one have nearly the same. Aligned coefficients tell them apart: `rholm.align`.
