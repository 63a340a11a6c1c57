"""
One body laid on another
========================

``align`` tries all rotations by Fourier transforms, finishes by Newton's iteration, and reports
whatever is nearly as good: the symmetries of the shape.
"""

import numpy as np
import rholm

# %%
# Two scans of one body: the second is turned, moved, coarser and noisy.

first = rholm.bumpy_sphere(6, 0.35, seed=8)
turn = rholm.rotation_about((1, 2, 0.5), 2.2)
coarse = rholm.bumpy_sphere(4, 0.35, seed=8)
random = np.random.default_rng(1)
noisy = coarse.vertices * (1 + 0.004 * random.normal(size=(len(coarse.vertices), 1)))
shift = np.array([0.4, -0.2, 0.1])
second = rholm.Mesh(rholm.harmonics.rotate(noisy, turn) + shift, coarse.faces)

a, b = (rholm.expand(mesh, degree=24) for mesh in (first, second))
found = rholm.align(b, a)
placed = rholm.placed(b, found)
back = rholm.harmonics.compose(found.alignment.best.rotation, turn)
print(
    f"the turn is undone to {np.degrees(rholm.harmonics.axis_angle_of(back)[1]):.3f} degrees"
)

rholm.render(
    [
        rholm.Panel(first, "first"),
        rholm.Panel(second, "second"),
        rholm.Panel(placed, "second, aligned"),
    ],
    (1200, 400),
)

# %%
# A shape with symmetries: a flower with three leaves on each side. Six rotations lay it on itself;
# they are found with their axes.

ball = rholm.icosphere(6)
x, y, z = ball.vertices.T
radius = 1 + 0.35 * (x**3 - 3 * x * y**2) - 0.45 * z**2
flower = rholm.expand(rholm.Mesh(ball.vertices * radius[:, None], ball.faces), degree=24)
found = rholm.align(flower, flower, margin=1e-4)
best = found.alignment.best
for which in [best, *found.alignment.ambiguities]:
    axis, angle = rholm.harmonics.axis_angle_of(which.rotation)
    print(
        f"{np.degrees(angle):6.1f} degrees about ({axis[0]:5.2f} {axis[1]:5.2f} {axis[2]:5.2f}),"
        f" correlation {which.correlation:.6f}"
    )

# %%
# No rotation lays the mirror image on a body without symmetry.

image = a.mirror("x")
for mirror in (False, True):
    best = rholm.align(image, a, mirror=mirror).alignment.best
    print(f"mirror={mirror}: correlation {best.correlation:.4f}, rms {best.distance:.4f}")

rholm.render(
    [
        rholm.Panel(flower, "six turns lay it on itself"),
        rholm.Panel(a, "none does"),
        rholm.Panel(image, "mirrored"),
    ],
    (1200, 400),
    view=(-0.3, 0.4, -0.8),
)
