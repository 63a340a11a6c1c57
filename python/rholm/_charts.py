"""The separate steps of `expand`: centre, chart, transform, errors, and random points."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import FloatArray, triple
from ._coefficients import Function, array_of
from ._encode import as_expansion, center_options, transform_options
from ._expansion import Expansion
from ._options import given_of, options_of, takes
from ._run import Progress, caller
from ._shapes import Mesh, MeshLike, outward_mesh

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._encode import TransformKeywords
    from ._keywords import MonteCarloKeywords


def _chart_core(chart: Any) -> _core.StarChart:
    if not isinstance(chart, StarChart):
        raise TypeError(f"a StarChart is needed, not {type(chart).__name__}; make_star_chart() makes one")
    return chart._core


class StarChart:
    """A mesh relative to a centre: the input of `analyze` and `monte_carlo`."""

    __slots__ = ("_core",)

    def __init__(self, core: _core.StarChart) -> None:
        self._core = core

    @property
    def mesh(self) -> Mesh:
        """Welded, closed, outward mesh with vertices relative to the centre."""
        return Mesh._of(self._core.mesh)

    @property
    def report(self) -> _core.StarReport:
        """The centre, and the visibility of the surface from it."""
        return self._core.report


def make_star_chart(
    mesh: MeshLike,
    center: Any = "auto",
    *,
    rays: int = 100_000,
    signed: bool = False,
    threads: int = 0,
    progress: Progress = None,
) -> StarChart:
    """Finds the centre, checks visibility, and moves the centre to the origin.

    Parameters
    ----------
    mesh : mesh-like
        Closed mesh; corrected as in `expand`.
    center, rays, signed, threads, progress
        As in `expand`.
    """
    wanted = _core.ChartOptions(center=center_options(center, rays=rays), signed=signed)
    with caller(threads, progress) as how:
        return StarChart(_core.make_star_chart(outward_mesh(mesh)._core, wanted, how))


def find_center(
    mesh: MeshLike, center: Any = "auto", *, rays: int = 100_000, threads: int = 0, progress: Progress = None
) -> _core.StarReport:
    """Finds the centre and checks how much of the surface is seen from it.

    Parameters
    ----------
    mesh : mesh-like
        Closed mesh; corrected as in `expand`.
    center, rays, threads, progress
        As in `expand`.
    """
    wanted = center_options(center, rays=rays)
    with caller(threads, progress) as how:
        return _core.find_center(outward_mesh(mesh)._core, wanted, how)


def check_star(
    mesh: MeshLike, center: npt.ArrayLike, *, rays: int = 100_000, threads: int = 0, progress: Progress = None
) -> _core.StarReport:
    """Checks whether a surface is star-shaped from a point.

    Parameters
    ----------
    mesh : mesh-like
        Closed mesh; corrected as in `expand`.
    center : array_like, (3,)
        The point.
    rays, threads, progress
        As in `expand`.
    """
    at = triple(center, "center")
    with caller(threads, progress) as how:
        return _core.check_star(outward_mesh(mesh)._core, at, rays, how)


class Analyzed(NamedTuple):
    """Result of `analyze`."""

    expansion: Expansion
    """The coefficients."""
    analysis: _core.Analysis
    """How they were found."""
    tolerance: _core.ToleranceReport | None
    """How a tolerance was kept."""


@takes(_core.AnalyzeOptions, _core.Tolerance)
def analyze(
    chart: StarChart,
    degree: int | None = None,
    *,
    tolerance: float | None = None,
    measure: Literal["radius", "distance"] | None = None,
    threads: int = 0,
    progress: Progress = None,
    **options: Unpack[TransformKeywords],
) -> Analyzed:
    """Computes the coefficients of a chart by the chosen method: a step of `expand`.

    Parameters
    ----------
    chart : StarChart
        Chart from `make_star_chart`.
    degree, tolerance, measure, threads, progress
        As in `expand`.
    {options}
    """
    parts = given_of(_core.AnalyzeOptions, _core.Tolerance, given={**options}, function="analyze")
    wanted, allowed = transform_options(degree, tolerance, measure, *parts)
    report = None
    with caller(threads, progress) as how:
        if allowed is None:
            analysis = _core.analyze(_chart_core(chart), wanted, how)
        else:
            analysis, report = _core.analyze_to_tolerance(_chart_core(chart), allowed, wanted, how)
    return Analyzed(Expansion._of(analysis.expansion), analysis, report)


def radius_norm_squared(chart: StarChart) -> float:
    """Returns the integral of r^2 over directions of a star-shaped surface, in closed form.

    Parameters
    ----------
    chart : StarChart
        Chart from `make_star_chart`.
    """
    return _core.radius_norm_squared(_chart_core(chart))


def gauge_norm_squared(chart: StarChart) -> float:
    """Returns the integral of 1/r^2 over directions, in closed form.

    Parameters
    ----------
    chart : StarChart
        Chart from `make_star_chart`.
    """
    return _core.gauge_norm_squared(_chart_core(chart))


def tail_strength(chart: StarChart, function: Function = "radius") -> float:
    """Returns S: the energy per degree is about S / (pi l^4) beyond the mesh's resolution.

    Parameters
    ----------
    chart : StarChart
        Chart from `make_star_chart`.
    function : {"radius", "gauge"}
        The function that is expanded.
    """
    return _core.tail_strength(_chart_core(chart), function)


def vertex_error_strength(chart: StarChart, function: Function = "radius") -> float:
    """Returns the largest truncation error at vertices, times 2 pi (L + 1).

    Parameters
    ----------
    chart : StarChart
        Chart from `make_star_chart`.
    function : {"radius", "gauge"}
        The function that is expanded.
    """
    return _core.vertex_error_strength(_chart_core(chart), function)


def vertex_error_strengths(mesh: MeshLike, center: npt.ArrayLike) -> _core.ErrorStrengths:
    """Returns the largest truncation errors at vertices, times 2 pi (L + 1), of radius, gauge and
    distance.

    Parameters
    ----------
    mesh : mesh-like
        Closed mesh.
    center : array_like, (3,)
        Centre of the expansion.
    """
    return _core.vertex_error_strengths(outward_mesh(mesh)._core, triple(center, "center"))


def truncation_errors(
    mesh: MeshLike,
    expansion: Expansion,
    *,
    precision: float | None = None,
    predict: bool = True,
    threads: int = 0,
    progress: Progress = None,
) -> _core.TruncationErrors:
    """Computes the distance of the surface of an expansion from its mesh.

    Parameters
    ----------
    mesh : mesh-like
        Closed mesh, star-shaped about the expansion's centre; corrected as in `expand`.
    expansion : Expansion
        Expansion of the mesh's radius or gauge.
    precision : float, optional
        Precision of the coefficients; by default `Expansion.precision`, or 1e-8 if that is unknown.
    predict : bool
        True: also predicts the largest errors in closed form.
    threads, progress
        See `rholm.caller`.
    """
    with caller(threads, progress) as how:
        return _core.truncation_errors(
            outward_mesh(mesh)._core, as_expansion(expansion)._core, precision, predict, how
        )


class MonteCarlo(NamedTuple):
    """Result of `monte_carlo`."""

    expansion: Expansion
    """The mean."""
    deviation: FloatArray
    """Of each coefficient, (2, L+1, L+1) in pyshtools' default convention: 3 of it hold the error
    in about 99.7 % of all seeds."""
    report: _core.MonteCarlo
    """How many samples, and how exact."""


@takes(_core.MonteCarloOptions)
def monte_carlo(
    chart: StarChart,
    degree: int = 64,
    *,
    threads: int = 0,
    progress: Progress = None,
    **options: Unpack[MonteCarloKeywords],
) -> MonteCarlo:
    """Computes coefficients from random points, as in the paper, with a reliable deviation.

    Parameters
    ----------
    chart : StarChart
        Chart from `make_star_chart`.
    degree : int
        Highest degree L.
    {options}
    threads, progress
        See `rholm.caller`.
    """
    wanted = options_of(_core.MonteCarloOptions, {**options}, "monte_carlo", degree=degree)
    with caller(threads, progress) as how:
        found = _core.monte_carlo(_chart_core(chart), wanted, how)
    return MonteCarlo(Expansion._of(found.expansion), np.abs(array_of(found.deviation)), found)
