"""
Centre of mass and gravity
==========================

A surface is expanded again about its centroid. The potential of a homogeneous body of this shape then
follows from powers of the radius, on a grid.
"""

# sphinx_gallery_thumbnail_number = 2
import numpy as np
import rholm
from matplotlib import pyplot as plt

# %%
# A pear-shaped body. The centre from which `rholm.expand` sees it best is not its centre of mass.

ball = rholm.icosphere(6)
z = ball.vertices[:, 2]
stone = rholm.bumpy_sphere(6, 0.18, seed=3)
pear = rholm.Mesh(stone.vertices * (0.8 + 0.3 * z + 0.25 * z**2)[:, None], stone.faces)
s = rholm.expand(pear, degree=48, length_unit="km")
com = s.recenter()
print("centre of the expansion", s.center.round(4))
print("centroid of the solid  ", s.centroid.round(4))
print(f"largest distance of the two surfaces {rholm.compare(s, com).hausdorff:.2e} km")

# %%
# Coefficients of the potential, 4 pi-normalised, up to degree 12:
# C_lm = 4 pi / (V R^l (2l+1) (l+3)) (r^(l+3))_lm. About the centre of mass degree 1 vanishes.


def stokes(s: rholm.Expansion, degree: int, reference: float) -> np.ndarray:
    """Returns the coefficients of the potential of the body at constant density."""
    n = 4 * s.degree
    r = rholm.harmonics.synthesize_grid(s, "gauss-legendre", n, 2 * n)
    result = np.zeros((2, degree + 1, degree + 1))
    for l in range(degree + 1):
        power = rholm.harmonics.analyze_grid(r ** (l + 3), "gauss-legendre", degree=degree)
        result[:, l] = (
            4 * np.pi / (s.volume * reference**l * (2 * l + 1) * (l + 3)) * power[:, l]
        )
    return result


reference = float(com(ball.vertices).max())
fields = {
    "best view": stokes(s, 12, reference),
    "centre of mass": stokes(com, 12, reference),
}
figure, ax = plt.subplots()
for name, field in fields.items():
    power = rholm.harmonics.power_spectrum(field, "power")
    ax.semilogy(
        np.arange(1, 13), np.maximum(power[1:], 1e-14), "o-", label=f"about the {name}"
    )
ax.set(xlabel="degree l", ylabel="power of the potential", xticks=range(1, 13))
ax.legend()
plt.show()

# %%
# The potential on the sphere around the body, in parts of the mean, without its mean; the same on the
# map that geodesists draw, and the body below.

values = rholm.harmonics.evaluate(fields["centre of mass"], ball.vertices) - 1
sphere = rholm.Mesh(reference * ball.vertices + com.center, ball.faces)
rholm.render(
    [
        rholm.Panel(com, "the body"),
        rholm.Panel(sphere, "potential around it", scalars=values),
    ],
    (1000, 480),
    scale_label="potential / mean - 1",
)

# %%
grid = (
    rholm.harmonics.synthesize_grid(fields["centre of mass"], "equiangular", 180, 360) - 1
)
figure, ax = plt.subplots()
top = np.abs(grid).max()
image = ax.imshow(grid, extent=(0, 360, -90, 90), cmap="RdBu_r", vmin=-top, vmax=top)
ax.set(xlabel="longitude, degrees", ylabel="latitude, degrees")
figure.colorbar(image, label="potential / mean - 1", shrink=0.7)
ax.grid(False)
plt.show()
