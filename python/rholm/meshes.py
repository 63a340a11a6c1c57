"""Meshes: primitives, checks, repair, comparison, smoothing of regions and transfer of detail."""

from __future__ import annotations

from ._convert import MeshLike, as_mesh, validate, vertex_colors
from ._core import Bounds, Comparison, Distances, Inspection, RepairReport, TransferReport
from ._edit import RegionLike, SmoothEditor, analyze_patch, longest_wavelength, region_weights, smooth
from ._primitives import box, bumpy_sphere, ellipsoid, icosphere, latitude_longitude_sphere, torus
from ._shapes import Mesh
from ._surfaces import compare, distances_to_surface
from ._topology import (
    Repaired,
    Simplification,
    Welded,
    area_normals,
    bounds,
    closing_tolerance,
    enclosed_volume,
    flip,
    inspect,
    largest_component,
    pair_edges,
    repair,
    simplify,
    surface_area,
    weld,
)
from ._transfer import (
    TransferEditor,
    TransferSource,
    analyze_source,
    analyze_transfer,
    apply,
    transfer,
    update,
)

__all__ = [
    "Bounds",
    "Comparison",
    "Distances",
    "Inspection",
    "Mesh",
    "MeshLike",
    "RegionLike",
    "RepairReport",
    "Repaired",
    "Simplification",
    "SmoothEditor",
    "TransferEditor",
    "TransferReport",
    "TransferSource",
    "Welded",
    "analyze_patch",
    "analyze_source",
    "analyze_transfer",
    "apply",
    "area_normals",
    "as_mesh",
    "bounds",
    "box",
    "bumpy_sphere",
    "closing_tolerance",
    "compare",
    "distances_to_surface",
    "ellipsoid",
    "enclosed_volume",
    "flip",
    "icosphere",
    "inspect",
    "largest_component",
    "latitude_longitude_sphere",
    "longest_wavelength",
    "pair_edges",
    "region_weights",
    "repair",
    "simplify",
    "smooth",
    "surface_area",
    "torus",
    "transfer",
    "update",
    "validate",
    "vertex_colors",
    "weld",
]
