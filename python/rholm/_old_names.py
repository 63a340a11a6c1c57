"""Names of the previous version: they work in this one, and warn with the new place."""

from __future__ import annotations

import importlib
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

from . import _core
from ._charts import ChartExpansion, expand_chart
from ._convert import MeshLike, PointsLike
from ._expand import expand
from ._reconstruct import foresee_tiles, reconstruct
from ._run import caller, renamed


def _encode(shape: MeshLike, **options: Any) -> _core.Expanded | None:
    return expand(shape, **options).expanded


class BrickForecast(NamedTuple):
    """Result of `foresee_bricks`, a name of the previous version."""

    points: int
    bricks: int
    memory: int
    stored: int
    written: int


class BrickReconstruction(NamedTuple):
    """Result of `reconstruct_bricks`, a name of the previous version."""

    report: _core.ReconstructReport
    bounds: _core.Bounds
    bricks: int
    vertices: int
    triangles: int
    coefficients: int
    stored: int
    warnings: list[str]


def _old_forecast(f: _core.TileForecast) -> BrickForecast:
    return BrickForecast(f.points, f.tiles, f.memory, f.stored, f.written)


def _foresee_bricks(points: int, points_per_brick: int = 1 << 20) -> BrickForecast:
    return _old_forecast(foresee_tiles(points, points_per_brick))


def _reconstruct_bricks(
    points: PointsLike,
    mesh_path: str | os.PathLike[str],
    *,
    points_per_brick: int = 1 << 20,
    foreseen: Callable[[BrickForecast], Any] | None = None,
    **options: Any,
) -> BrickReconstruction:
    told = None if foreseen is None else lambda forecast: foreseen(_old_forecast(forecast))
    if options.get("work_dir") is not None:
        Path(options["work_dir"]).mkdir(exist_ok=True)
    r = reconstruct(points, output=mesh_path, tile_points=points_per_brick, foreseen=told, **options).report
    return BrickReconstruction(
        r, r.bounds, r.tiles, r.vertices, r.triangles, r.coefficients, r.stored, r.warnings
    )


#: Names that were in ``rholm`` itself and are only in a module now.
_MOVED = {
    "clouds": """
        AlignedScans CleanReport Cleaned OrientReport Oriented PointsLike ReconstructReport
        Reconstruction ScanAlignment TileForecast align_scans as_points clean foresee_tiles
    """,
    "figures": """
        Picture Studio encode_png patch_picture set_cap_colors set_degree_colors spectrum_svg
        view_data write_png
    """,
    "files": """
        BatchTable CoefficientsFile FileFormat ShapeFile attributes_left_out coefficients_format_of
        coefficients_formats is_atlas_file is_model_file looks_like_coefficients map_mesh
        parse_coefficients parse_shape read_any_coefficients read_atlas read_coefficients read_model
        shape_formats write_atlas write_coefficients write_file write_model write_shape
    """,
    "harmonics": """
        MAX_DEGREE NO_CAP AlignedRotation Alignment AtlasErrors AtlasSize Cap ChartExpansion
        CoefficientsLike CompressReport ErrorStrengths Expanded FastReport GravityField MonteCarlo
        Overshoot PatchAtlas Placement PrincipalAxes Rotation RotationLike StarChart StarReport
        SurfaceMeasures SurfaceRules ToleranceReport Transform TruncationErrors adjoint analyze_grid
        angle_between as_atlas as_expansion as_rotation axis_angle_of check_star check_unit compose
        descriptor_distance directions_of distance dominant_caps euler_angles_of evaluate
        evaluate_rings evaluate_with_gradient exact_degree expand_chart filter find_center
        from_convention gauge_norm_squared gauss_legendre grid_colatitudes highest_degree inertia
        inverse make_star_chart matrix_of measure metres_of mirror monte_carlo n_coefficients
        overshoot patch_atlas power_spectrum principal_axes radius_norm_squared recentered
        require_star_shaped require_surface rms_beyond rotate rotation_of scaled seen_center
        sharpened size_of smallest_grid synthesize synthesize_grid tail_strength to_convention
        truncation_errors vertex_error_strength vertex_error_strengths volume_centroid
    """,
    "meshes": """
        Bounds Comparison Distances Inspection MeshLike RegionLike RepairReport Repaired
        Simplification SmoothEditor TransferEditor TransferReport TransferSource Welded
        analyze_patch analyze_source analyze_transfer apply area_normals as_mesh bounds
        closing_tolerance distances_to_surface enclosed_volume flip largest_component
        latitude_longitude_sphere longest_wavelength pair_edges region_weights surface_area update
        validate vertex_colors weld
    """,
}
_PLACES = {name: module for module, names in _MOVED.items() for name in names.split()}

#: Other names of the previous version: the place of the replacement, and the object with the old name.
_RENAMED: dict[str, tuple[str, object]] = {
    "Analysis": ("rholm.harmonics.Transform", _core.Transform),
    "Analyzed": ("rholm.harmonics.ChartExpansion", ChartExpansion),
    "BrickForecast": ("rholm.clouds.TileForecast", BrickForecast),
    "BrickReconstruction": ("rholm.clouds.Reconstruction", BrickReconstruction),
    "Encoded": ("rholm.harmonics.Expanded", _core.Expanded),
    "analyze": ("rholm.harmonics.expand_chart()", expand_chart),
    "caller": ("threads= and progress= of each function", caller),
    "encode": ("rholm.expand(...).expanded", _encode),
    "foresee_bricks": ("rholm.clouds.foresee_tiles()", _foresee_bricks),
    "reconstruct_bricks": ("rholm.reconstruct(output=..., tile_points=...)", _reconstruct_bricks),
}


def old_thing(name: str) -> object:
    """Returns the object that had a name in the previous version, and warns.

    Parameters
    ----------
    name : str
        Name. Any other name raises AttributeError.
    """
    if name in _RENAMED:
        new, thing = _RENAMED[name]
    elif name in _PLACES:
        new = f"rholm.{_PLACES[name]}.{name}"
        thing = getattr(importlib.import_module(f".{_PLACES[name]}", __package__), name)
    else:
        raise AttributeError(f"module 'rholm' has no attribute {name!r}")
    renamed(f"rholm.{name}", new)
    return thing
