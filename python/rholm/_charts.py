"""The separate steps of `expand`: centre, chart, transform, errors, and random points."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import public
from ._arrays import FloatArray, triple
from ._coefficients import Function, array_of
from ._convert import MeshLike, outward_mesh
from ._expand import as_expansion, center_options, tolerance_of
from ._expansion import Expansion
from ._options import given_of, options_of, takes
from ._run import Progress, caller
from ._shapes import Mesh

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._expand import ChartExpandKeywords
    from ._keywords import MonteCarloKeywords


def _chart_core(chart: Any) -> _core.StarChart:
    if not isinstance(chart, StarChart):
        raise TypeError(f"a StarChart is needed, not {type(chart).__name__}; make_star_chart() makes one")
    return chart._core


@public
class StarChart:
    """A mesh relative to a centre: the input of `expand_chart` and `monte_carlo`.

    Examples
    --------
    >>> chart = rholm.harmonics.make_star_chart(rholm.bumpy_sphere(2))
    >>> chart.report.star_shaped
    True
    """

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

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, StarChart):
            return NotImplemented
        return self.mesh == other.mesh and self.report == other.report

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        at = ", ".join(f"{x:.6g}" for x in self.report.center)
        return f"<rholm.harmonics.StarChart: {len(self.mesh.faces)} faces, center ({at})>"


@public
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

    Examples
    --------
    >>> chart = rholm.harmonics.make_star_chart(rholm.icosphere(2), center=(0, 0, 0.25))
    >>> float(chart.mesh.vertices[:, 2].min())
    -1.25
    """
    wanted = _core.ChartOptions(center=center_options(center, rays=rays), signed=signed)
    with caller(threads, progress) as how:
        return StarChart(_core.make_star_chart(outward_mesh(mesh)._core, wanted, how))


@public
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

    Examples
    --------
    >>> report = rholm.harmonics.find_center(rholm.box((1, 1, 2)), "centroid")
    >>> [round(abs(float(x)), 6) for x in report.center]
    [0.0, 0.0, 0.0]
    """
    wanted = center_options(center, rays=rays)
    with caller(threads, progress) as how:
        return _core.find_center(outward_mesh(mesh)._core, wanted, how)


@public
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

    Examples
    --------
    >>> rholm.harmonics.check_star(rholm.box((1, 1, 1)), (0, 0, 0)).bad_faces
    0
    """
    at = triple(center, "center")
    with caller(threads, progress) as how:
        return _core.check_star(outward_mesh(mesh)._core, at, rays, how)


class ChartExpansion(NamedTuple):
    """Result of `expand_chart`."""

    expansion: Expansion
    """The coefficients."""
    transform: _core.Transform
    """Report of the transform that computed the coefficients."""
    tolerance: _core.ToleranceReport | None
    """Report on the wanted tolerance."""


@public
@takes(_core.TransformOptions, _core.Tolerance)
def expand_chart(
    chart: StarChart,
    degree: int | None = None,
    *,
    tolerance: float | None = None,
    measure: Literal["radius", "distance"] | None = None,
    threads: int = 0,
    progress: Progress = None,
    **options: Unpack[ChartExpandKeywords],
) -> ChartExpansion:
    """Computes the coefficients of a chart by the chosen method: a step of `expand`.

    Parameters
    ----------
    chart : StarChart
        Chart from `make_star_chart`.
    degree, tolerance, measure, threads, progress
        As in `expand`.
    {options}

    Examples
    --------
    >>> chart = rholm.harmonics.make_star_chart(rholm.bumpy_sphere(2))
    >>> rholm.harmonics.expand_chart(chart, degree=8).expansion.degree
    8
    """
    transform, kept = given_of(
        _core.TransformOptions, _core.Tolerance, given={**options}, function="expand_chart"
    )
    wanted = _core.TransformOptions(degree=degree, **transform)
    allowed = tolerance_of(degree, tolerance, measure, kept)
    report = None
    with caller(threads, progress) as how:
        if allowed is None:
            found = _core.expand_chart(_chart_core(chart), wanted, how)
        else:
            found, report = _core.expand_chart_to_tolerance(_chart_core(chart), allowed, wanted, how)
    return ChartExpansion(Expansion._of(found.expansion), found, report)


@public
def radius_norm_squared(chart: StarChart) -> float:
    """Returns the integral of r^2 over directions of a star-shaped surface, in closed form.

    Parameters
    ----------
    chart : StarChart
        Chart from `make_star_chart`.

    Examples
    --------
    >>> chart = rholm.harmonics.make_star_chart(rholm.icosphere(5))
    >>> round(rholm.harmonics.radius_norm_squared(chart) / (4 * np.pi), 2)
    1.0
    """
    return _core.radius_norm_squared(_chart_core(chart))


@public
def gauge_norm_squared(chart: StarChart) -> float:
    """Returns the integral of 1/r^2 over directions, in closed form.

    Parameters
    ----------
    chart : StarChart
        Chart from `make_star_chart`.

    Examples
    --------
    >>> chart = rholm.harmonics.make_star_chart(rholm.icosphere(5))
    >>> round(rholm.harmonics.gauge_norm_squared(chart) / (4 * np.pi), 2)
    1.0
    """
    return _core.gauge_norm_squared(_chart_core(chart))


@public
def tail_strength(chart: StarChart, function: Function = "radius") -> float:
    """Returns S: the energy per degree is about S / (pi l^4) beyond the mesh's resolution.

    Parameters
    ----------
    chart : StarChart
        Chart from `make_star_chart`.
    function : {"radius", "gauge"}
        The function that is expanded.

    Examples
    --------
    >>> coarse, fine = (rholm.harmonics.make_star_chart(rholm.icosphere(n)) for n in (1, 3))
    >>> rholm.harmonics.tail_strength(coarse) > rholm.harmonics.tail_strength(fine)
    True
    """
    return _core.tail_strength(_chart_core(chart), function)


@public
def vertex_error_strength(chart: StarChart, function: Function = "radius") -> float:
    """Returns the largest truncation error at vertices, times 2 pi (L + 1).

    Parameters
    ----------
    chart : StarChart
        Chart from `make_star_chart`.
    function : {"radius", "gauge"}
        The function that is expanded.

    Examples
    --------
    >>> coarse, fine = (rholm.harmonics.make_star_chart(rholm.icosphere(n)) for n in (1, 3))
    >>> rholm.harmonics.vertex_error_strength(coarse) > rholm.harmonics.vertex_error_strength(fine)
    True
    """
    return _core.vertex_error_strength(_chart_core(chart), function)


@public
def vertex_error_strengths(mesh: MeshLike, center: npt.ArrayLike) -> _core.ErrorStrengths:
    """Returns the largest truncation errors at vertices, times 2 pi (L + 1), of radius, gauge and
    distance.

    Parameters
    ----------
    mesh : mesh-like
        Closed mesh.
    center : array_like, (3,)
        Centre of the expansion.

    Examples
    --------
    >>> rholm.harmonics.vertex_error_strengths(rholm.icosphere(1), (0, 0, 0)).radius > 0
    True
    """
    return _core.vertex_error_strengths(outward_mesh(mesh)._core, triple(center, "center"))


@public
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
        See ``help(rholm)``.

    Examples
    --------
    >>> body = rholm.bumpy_sphere(3)
    >>> s = rholm.expand(body, degree=16)
    >>> coarse = rholm.harmonics.truncation_errors(body, s.truncate(4))
    >>> coarse.rms > s.errors.rms
    True
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
    """Standard deviation of each coefficient, (2, L+1, L+1) in pyshtools' default convention.
    The error is below three of it for about 99.7 % of all seeds."""
    report: _core.MonteCarlo
    """Number of samples, and errors."""

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, MonteCarlo):
            return NotImplemented
        return (
            self.expansion == other.expansion
            and bool(np.array_equal(self.deviation, other.deviation))
            and self.report == other.report
        )

    def __repr__(self) -> str:
        return f"MonteCarlo(expansion={self.expansion!r}, report=MonteCarlo(...))"


@public
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
        See ``help(rholm)``.

    Examples
    --------
    >>> chart = rholm.harmonics.make_star_chart(rholm.icosphere(3))
    >>> found = rholm.harmonics.monte_carlo(chart, degree=2, samples=100)
    >>> found.expansion.degree, found.deviation.shape
    (2, (2, 3, 3))
    """
    wanted = options_of(_core.MonteCarloOptions, {**options}, "monte_carlo", degree=degree)
    with caller(threads, progress) as how:
        found = _core.monte_carlo(_chart_core(chart), wanted, how)
    return MonteCarlo(Expansion._of(found.expansion), np.abs(array_of(found.deviation)), found)
