"""
The spectrum and its tail
=========================

The energy per degree says at which wavelengths a shape has its detail. A mesh has flat faces,
which add a tail to the spectrum: beyond the mesh's resolution the energy falls as S / (pi l^4). S is
known in closed form from the angles at the edges. The tail shows from which degree on the spectrum
describes the mesh and no longer the shape.
"""

import rholm
from matplotlib import pyplot as plt

# %%
# One smooth body as meshes of 320, 1 280 and 20 480 triangles.

meshes = {20 * 4**n: rholm.bumpy_sphere(n, 0.3, seed=6) for n in (2, 3, 5)}
rholm.render(
    [rholm.Panel(mesh, f"{n} triangles", smooth=False) for n, mesh in meshes.items()],
    (1200, 400),
)

# %%
# The series of all three agree where the shape is, and leave it one after the other where their faces
# show. The dotted lines are predicted from the edges, not fitted.

figure, ax = plt.subplots()
for n, mesh in meshes.items():
    s = rholm.expand(mesh, degree=256, center="none")
    s.plot_spectrum(ax, label=f"{n} triangles", linewidth=1.2)
ax.set_ylim(1e-11, 3)
handles, labels = ax.get_legend_handles_labels()
ax.legend(handles[0::2] + handles[-1:], labels[0::2] + labels[-1:])
plt.show()

# %%
# This limits the degree to choose: where the spectrum has reached its tail, more degrees describe the
# faces, not the body.
