"""Names of the previous version: they work in this one, and warn with the new place."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple

from . import _core, clouds, figures, files, harmonics, meshes
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
        r, r.bounds, r.tiles, r.vertices, r.faces, r.coefficients, r.stored, r.warnings
    )


#: Names of the previous version: the place of the replacement, and the object with the old name.
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


def module_of(name: str) -> ModuleType | None:
    """Returns the module that has a name which was in ``rholm`` itself, if any."""
    modules = (clouds, figures, files, harmonics, meshes)
    return next((module for module in modules if name in module.__all__), None)


def old_thing(name: str) -> object:
    """Returns the object that had a name in the previous version, and warns.

    Parameters
    ----------
    name : str
        Name. Any other name raises AttributeError.
    """
    if name in _RENAMED:
        new, thing = _RENAMED[name]
    else:
        module = module_of(name)
        if module is None:
            raise AttributeError(f"module 'rholm' has no attribute {name!r}")
        new, thing = f"{module.__name__}.{name}", getattr(module, name)
    renamed(f"rholm.{name}", new)
    return thing
