"""Keywords of functions, from the lists of the library. scripts/python-stub writes this file."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any, Literal, TypedDict

import numpy.typing as npt


class RepairKeywords(TypedDict, total=False):
    """Options of `repair`."""

    weld: float
    max_hole: int


class SimplifyKeywords(TypedDict, total=False):
    """Options of `simplify`: when it stops."""

    faces: int
    share: float
    max_error: float


class SampleKeywords(TypedDict, total=False):
    """Options of `sample_surface`: errors, outliers and places of the samples."""

    noise: float
    normal_noise: float
    outliers: float
    holes: int
    hole_radius: float
    density_ratio: float
    pattern: Literal["random", "slices", "rings", "lines", "grid"]
    pattern_ratio: float
    pattern_axis: npt.ArrayLike
    scans: int
    misalignment: float
    scan_noise: float
    sensor: bool
    normals: bool
    seed: int


class OrientKeywords(TypedDict, total=False):
    """Options of `orient`."""

    neighbors: int
    keep_directions: bool
    center: npt.ArrayLike | None
    sensor: npt.ArrayLike | None
    keep_outliers: bool
    confidence: bool


class AlignKeywords(TypedDict, total=False):
    """Options of `align`."""

    start: Literal["correlation", "principal-axes"]
    bandwidth: int
    refine_degree: int
    margin: float
    mirror: bool
    unknown_a: float
    unknown_b: float


class TransformKeywords(TypedDict, total=False):
    """Options of the transform from a chart to coefficients."""

    method: Literal["edge", "gauge", "curl", "area"]
    engine: Literal["fast", "direct"]
    precision: float


class ToleranceKeywords(TypedDict, total=False):
    """Largest allowed error of a model."""

    unit: Literal["absolute", "diagonal", "radius"]
    norm: Literal["rms", "max"]
    max_degree: int


class CenterKeywords(TypedDict, total=False):
    """Options of the centre."""

    rays: int


class ChartKeywords(TypedDict, total=False):
    """Options of a chart: the centre, and surfaces that are not star-shaped."""

    signed: bool


class ExpandKeywords(TypedDict, total=False):
    """Options of `expand`: degree, precision and errors."""

    method: Literal["edge", "gauge", "curl", "area"]
    engine: Literal["fast", "direct"]
    precision: float
    errors: bool
    weld: float


class MonteCarloKeywords(TypedDict, total=False):
    """Options of `monte_carlo`."""

    places: Literal["edge", "triangle"]
    seed: int
    samples: int | None
    deviation: float
    most_samples: int


class CompareKeywords(TypedDict, total=False):
    """Options of `compare`."""

    samples: int
    seed: int
    threshold: float


class CompressKeywords(TypedDict, total=False):
    """Options of `compress`: limits of the size and the error of an atlas."""

    samples: int
    max_degree: int
    seed: int
    max_numbers: int


class AtlasSynthesisKeywords(TypedDict, total=False):
    """Options for extracting the surface of an atlas."""

    step: float
    degree: int | None
    simplify: Any
    max_memory: int


class PatchAtlasKeywords(TypedDict, total=False):
    """Options of `patch_atlas`: the paper's parameters."""

    extension: Literal["zero", "sphere"]
    min_cosine: float
    overlap: float


class ReconstructKeywords(TypedDict, total=False):
    """Options of `reconstruct`: resolution, cleaning and holes of the surface."""

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


class PatchKeywords(TypedDict, total=False):
    """Options of `smooth`: the detail to remove from a region."""

    transition: float | None
    fitting: Literal["mean", "robust", "around"]
    repair: bool


class TransferKeywords(TypedDict, total=False):
    """Options of `transfer`: the detail to take, and its size on the target."""

    from_degree: int
    scale: float
    refine: bool
    transition: float | None


class TransferUpdateKeywords(TypedDict, total=False):
    """Options of `transfer` that can be updated quickly."""

    height: float
    angle: float | None
    repeat: bool
    remove_own: bool
    mode: Literal["displacement", "coefficients"]


class RenderKeywords(TypedDict, total=False):
    """Options of `render`: size, point of view, light and colours."""

    perspective: bool
    fit_each: bool
    view: npt.ArrayLike
    up: npt.ArrayLike
    samples: int
    occlusion_rays: int
    fine: bool
    scale_bar: bool
    scale_label: str


class ReportKeywords(TypedDict, total=False):
    """Options of `report_html`: texts of the page, and size of its pictures."""

    title: str
    shape_name: str
    notes: Sequence[str]
    tolerance: float | None
    picture_size: int
