"""Names of the previous version, which warn and work in this one."""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

from . import _core
from ._charts import ChartExpansion, expand_chart
from ._expand import expand
from ._reconstruct import foresee_tiles, reconstruct
from ._shapes import MeshLike, PointsLike


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


#: Names of the previous version, with their replacements.
_OLD_NAMES: dict[str, tuple[str, object]] = {
    "Analysis": ("Transform", _core.Transform),
    "Analyzed": ("ChartExpansion", ChartExpansion),
    "BrickForecast": ("TileForecast", BrickForecast),
    "BrickReconstruction": ("Reconstruction", BrickReconstruction),
    "Encoded": ("Expanded", _core.Expanded),
    "analyze": ("expand_chart()", expand_chart),
    "encode": ("expand(...).expanded", _encode),
    "foresee_bricks": ("foresee_tiles()", _foresee_bricks),
    "reconstruct_bricks": ("reconstruct(output=..., tile_points=...)", _reconstruct_bricks),
}


def old_thing(name: str) -> object:
    """Returns the object that had a name in the previous version, and warns.

    Parameters
    ----------
    name : str
        Name. Any other name raises AttributeError.
    """
    if name not in _OLD_NAMES:
        raise AttributeError(f"module 'rholm' has no attribute {name!r}")
    new, thing = _OLD_NAMES[name]
    text = f"rholm.{name} is rholm.{new} now; the next version has no other name for it"
    warnings.warn(text, DeprecationWarning, stacklevel=3)
    return thing
