"""Keywords of functions, from the lists of the library. scripts/python-stub writes this file."""

from __future__ import annotations

import os
from typing import Any, Literal, TypedDict

import numpy.typing as npt


class SimplifyKeywords(TypedDict, total=False):
    """Where simplify() stops."""

    triangles: int
    share: float
    max_error: float


class ReconstructKeywords(TypedDict, total=False):
    """What is wanted of the surface."""

    step: float
    tolerance: float
    noise: float | None
    holes: Literal["fill", "keep"]
    blend: Literal["smooth", "spline"]
    min_component: float
    keep_outliers: bool
    sensor: npt.ArrayLike | None
    keep_scans: bool
    confidence: bool
    simplify: Any
    tile_points: int
    max_memory: int
    output: str | os.PathLike[str] | None
    model: str | os.PathLike[str] | None
    work_dir: str | os.PathLike[str] | None
    resume: bool
