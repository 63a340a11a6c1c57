"""The accessor ``dataset.rholm`` of PyVista's meshes, which PyVista finds by its entry point."""

from __future__ import annotations

from typing import Any

import pyvista

from .clouds import reconstruct
from .harmonics import Atlas, Expansion, compress, expand
from .meshes import Comparison, compare, repair, smooth


@pyvista.register_dataset_accessor("rholm", pyvista.PolyData)
class RholmAccessor:
    """Functions of rholm for a `pyvista.PolyData`.

    Examples
    --------
    >>> import pyvista  # doctest: +SKIP
    >>> pyvista.Sphere().rholm.expand(degree=8).degree  # doctest: +SKIP
    8
    """

    def __init__(self, dataset: pyvista.DataSet) -> None:
        self._dataset = dataset

    def expand(self, degree: int | None = None, **options: Any) -> Expansion:
        """Computes an expansion; see `rholm.expand`."""
        return expand(self._dataset, degree, **options)

    def compress(self, tolerance: float, **options: Any) -> Atlas:
        """Computes an atlas; see `rholm.compress`."""
        return compress(self._dataset, tolerance, **options)

    def smooth(self, region: Any, wavelength: float, **options: Any) -> pyvista.PolyData:
        """Smooths a region; see `rholm.smooth`."""
        return smooth(self._dataset, region, wavelength, **options).to_pyvista()

    def reconstruct(self, **options: Any) -> pyvista.PolyData:
        """Reconstructs a surface; see `rholm.reconstruct`."""
        return reconstruct(self._dataset, **options).mesh.to_pyvista()

    def repair(self, **options: Any) -> pyvista.PolyData:
        """Repairs the mesh; see `rholm.repair`."""
        return repair(self._dataset, **options).mesh.to_pyvista()

    def compare(self, other: Any, **options: Any) -> Comparison:
        """Compares two surfaces; see `rholm.compare`."""
        return compare(self._dataset, other, **options)
