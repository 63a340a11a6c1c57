"""Points: samples of surfaces, cleaning, aligning of scans, normals, and surfaces from points."""

from __future__ import annotations

from ._convert import PointsLike, as_points
from ._core import CleanReport, OrientReport, ReconstructReport, ScanAlignment, TileForecast
from ._points import AlignedScans, Cleaned, Oriented, align_scans, clean, orient, sample_surface
from ._reconstruct import Reconstruction, foresee_tiles, reconstruct
from ._shapes import PointCloud

__all__ = [
    "AlignedScans",
    "CleanReport",
    "Cleaned",
    "OrientReport",
    "Oriented",
    "PointCloud",
    "PointsLike",
    "ReconstructReport",
    "Reconstruction",
    "ScanAlignment",
    "TileForecast",
    "align_scans",
    "as_points",
    "clean",
    "foresee_tiles",
    "orient",
    "reconstruct",
    "sample_surface",
]
