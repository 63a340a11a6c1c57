"""Keywords of functions, from the lists of the library. scripts/python-stub writes this file."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any, Literal, TypedDict

import numpy.typing as npt


class RepairKeywords(TypedDict, total=False):
    """Steps of the repair of a mesh."""

    weld: float
    max_hole: int


class SimplifyKeywords(TypedDict, total=False):
    """Where simplify() stops."""

    triangles: int
    share: float
    max_error: float


class SampleKeywords(TypedDict, total=False):
    """Errors, outliers and places of the samples of a surface."""

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
    """How normals are found and which side is outside."""

    neighbors: int
    keep_directions: bool
    center: npt.ArrayLike | None
    sensor: npt.ArrayLike | None
    keep_outliers: bool
    confidence: bool


class AlignKeywords(TypedDict, total=False):
    """How a rotation is sought."""

    start: Literal["correlation", "principal-axes"]
    bandwidth: int
    refine_degree: int
    margin: float
    mirror: bool
    unknown_a: float
    unknown_b: float


class TransformKeywords(TypedDict, total=False):
    """Function to expand, and method."""

    method: Literal["edge", "gauge", "curl", "area"]
    engine: Literal["fast", "direct"]
    precision: float


class ToleranceKeywords(TypedDict, total=False):
    """The largest error that is allowed."""

    unit: Literal["absolute", "diagonal", "radius"]
    norm: Literal["rms", "max"]
    max_degree: int


class CenterKeywords(TypedDict, total=False):
    """Where the centre is sought."""

    rays: int


class ChartKeywords(TypedDict, total=False):
    """Rules for the centre, and for surfaces that are not star-shaped."""

    signed: bool


class ExpandKeywords(TypedDict, total=False):
    """Degree, precision and error figures of an expansion."""

    method: Literal["edge", "gauge", "curl", "area"]
    engine: Literal["fast", "direct"]
    precision: float
    errors: bool
    weld: float


class MonteCarloKeywords(TypedDict, total=False):
    """How much is wanted, and when to stop."""

    places: Literal["edge", "triangle"]
    seed: int
    samples: int | None
    deviation: float
    most_samples: int


class CompareKeywords(TypedDict, total=False):
    """Where distances are measured."""

    samples: int
    seed: int
    threshold: float


class CompressKeywords(TypedDict, total=False):
    """Limits of the size and the error of an atlas."""

    samples: int
    max_degree: int
    seed: int
    max_numbers: int


class AtlasSynthesisKeywords(TypedDict, total=False):
    """How a surface is extracted."""

    step: float
    degree: int | None
    simplify: Any
    max_memory: int


class PatchAtlasKeywords(TypedDict, total=False):
    """The paper's parameters."""

    extension: Literal["zero", "sphere"]
    min_cosine: float
    overlap: float


class ReconstructKeywords(TypedDict, total=False):
    """Resolution, cleaning and holes of the surface."""

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
    """Detail to remove from a region."""

    transition: float | None
    fitting: Literal["mean", "robust", "around"]
    repair: bool


class TransferKeywords(TypedDict, total=False):
    """Detail to take, and its size on the target."""

    from_degree: int
    scale: float
    refine: bool
    transition: float | None


class TransferUpdateKeywords(TypedDict, total=False):
    """Values that sliders change."""

    height: float
    angle: float | None
    repeat: bool
    remove_own: bool
    mode: Literal["displacement", "coefficients"]


class RenderKeywords(TypedDict, total=False):
    """Size, point of view, light and colours."""

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
    """Texts of a page beside its figures."""

    title: str
    shape_name: str
    notes: Sequence[str]
    tolerance: float | None
    picture_size: int
