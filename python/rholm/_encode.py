"""From a mesh to an expansion, the whole way; from coefficients of others."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Literal

import numpy.typing as npt

from . import _core
from ._arrays import triangle_rows, triple, unwritable, vertex_rows
from ._coefficients import Function, Normalization, core_of, from_convention
from ._errors import InvalidInputError
from ._expansion import Expansion
from ._interop import foreign_mesh
from ._options import given_of, takes
from ._run import Progress, caller
from ._shapes import MeshLike, as_mesh, name_of

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._keywords import AnalyzeKeywords, CenterKeywords, ChartKeywords, EncodeKeywords, ToleranceKeywords

    class TransformKeywords(AnalyzeKeywords, ToleranceKeywords, total=False):
        """How a function is expanded, to what tolerance."""

    class ExpandKeywords(TransformKeywords, CenterKeywords, ChartKeywords, EncodeKeywords, total=False):
        """What is wanted of a model, and what may be done to the mesh."""


def center_options(center: Any, **rays: Any) -> _core.CenterOptions:
    """Of the name of a kind of centre, or a point."""
    if isinstance(center, str):
        options = _core.parse_center(center)
    else:
        options = _core.CenterOptions(center="given", point=triple(center, "center"))
    for name, value in rays.items():
        setattr(options, name, value)
    return options


def transform_options(
    degree: int | None, tolerance: float | None, measure: str | None, analyze: Any, allowed: Any
) -> tuple[_core.AnalyzeOptions, _core.Tolerance | None]:
    """As `expand` and `analyze` take them; the last two are what is given of the classes of options."""
    if degree is not None and tolerance is not None:
        raise InvalidInputError("degree and tolerance exclude one another: give one of them")
    wanted = _core.AnalyzeOptions(degree=degree, **analyze)
    if tolerance is None:
        return wanted, None
    kept = _core.Tolerance(error=tolerance, **allowed)
    kept.measure = measure or ("distance" if kept.unit == "diagonal" else "radius")
    return wanted, kept


@takes(_core.AnalyzeOptions, _core.Tolerance, _core.CenterOptions, _core.ChartOptions, _core.EncodeOptions)
def expand(
    shape: MeshLike,
    degree: int | None = None,
    *,
    tolerance: float | None = None,
    measure: Literal["radius", "distance"] | None = None,
    center: Any = "auto",
    length_unit: str = "",
    threads: int = 0,
    progress: Progress = None,
    **options: Unpack[ExpandKeywords],
) -> Expansion:
    """Spherical-harmonic coefficients of a closed mesh.

    Parameters
    ----------
    shape : mesh-like
        (vertices, triangles), a path, or a mesh of rholm, trimesh, PyVista or meshio. Arrays that
        can be written to are copied first, as other threads may write to them meanwhile. Read-only
        ones of float32 or float64 and of 32-bit integers are used where they lie, and so is a `Mesh`.
        A mesh that is inside out or has doubled vertices is mended.
    degree : int, optional
        L, by default 64.
    tolerance : float, optional
        The smallest degree that keeps this error, instead.
    measure : {"radius", "distance"}, optional
        Of each error: along rays from the centre, or between the surfaces. By default the radius,
        with ``unit="diagonal"`` the distance.
    center : {"auto", "kernel", "slope", "cosine", "none", "centroid", "volume"} or array_like, (3,)
        Where the centre is. "auto", "slope": where the radius has the least slope, on the line
        through "kernel" and the centroid of the solid, well within the points that see the whole
        surface; "kernel": in the middle of these points; "cosine": where the surface is seen least
        aslant; "none": the origin; "centroid": of the surface; "volume": of the solid, or as
        "slope" where not all is seen from there.
    {options}
    length_unit : str
        Of the vertices: "km", "mm", ...
    threads, progress
        See `rholm.caller`.

    Returns
    -------
    s : Expansion
        With ``s.errors`` and ``s.encoded``, what was found out on the way.

    Raises
    ------
    InvalidInputError
        For a mesh that is not closed or not oriented alike, and options out of range.
    NotStarShapedError
        With figures, unless `signed`; `compress` takes any shape.

    Notes
    -----
    Coefficients are those of the piecewise flat surface itself, by integrals over its edges and
    faces, not of samples: see docs/method.md.

    Examples
    --------
    >>> import rholm
    >>> s = rholm.expand(rholm.ellipsoid((3, 2, 1), 5), degree=16)
    >>> s.degree
    16
    >>> round(s.volume / (4 / 3 * 3.14159265 * 6), 2)
    1.0
    """
    kinds = (_core.AnalyzeOptions, _core.Tolerance, _core.CenterOptions, _core.ChartOptions)
    analyze, allowed, rays, signed, rest = given_of(
        *kinds, _core.EncodeOptions, given={**options}, function="expand"
    )
    wanted = _core.EncodeOptions(**rest)
    wanted.analyze, wanted.tolerance = transform_options(degree, tolerance, measure, analyze, allowed)
    wanted.chart = _core.ChartOptions(center=center_options(center, **rays), **signed)
    with caller(threads, progress) as how:
        if isinstance(shape, (str, os.PathLike)):
            encoded, _ = _core.encode_file(os.fspath(shape), wanted, how)
        else:
            encoded = _core.encode(*_mesh_arrays(shape), wanted, how)
    expansion = Expansion._of(encoded.analysis.expansion, encoded, shape, name_of(shape))
    return expansion.with_unit(length_unit) if length_unit else expansion


def _mesh_arrays(shape: Any) -> tuple[Any, Any]:
    """Vertices and triangles where they lie, unless somebody could write to them meanwhile."""
    arrays = foreign_mesh(shape)
    if arrays is None:
        if type(shape) not in (tuple, list) or len(shape) != 2:
            core = as_mesh(shape)._core
            return core.vertices, core.triangles
        arrays = (shape[0], shape[1], {})
    return unwritable(vertex_rows(arrays[0])), unwritable(triangle_rows(arrays[1]))


def encode(shape: MeshLike, **options: Any) -> _core.Encoded:
    """What `expand` finds out on the way from a mesh to an expansion.

    Parameters
    ----------
    shape, **options
        As in `expand`.
    """
    encoded = expand(shape, **options).encoded
    assert encoded is not None
    return encoded


def from_array(
    values: npt.ArrayLike,
    *,
    normalization: Normalization = "4pi",
    csphase: int = 1,
    center: npt.ArrayLike = (0.0, 0.0, 0.0),
    function: Function = "radius",
    unit: str = "",
) -> Expansion:
    """An expansion of an array of coefficients.

    Parameters
    ----------
    values : array_like, (2, L+1, L+1)
        Cosine plane, sine plane.
    normalization, csphase
        Of the array; pyshtools' default if not given.
    center : array_like, (3,)
        Of the surface.
    function : {"radius", "gauge", "other"}
        What the function is.
    unit : str
        Of lengths.
    """
    return Expansion(
        from_convention(values, normalization, csphase), center=center, function=function, unit=unit
    )


def from_pyshtools(
    clm: Any, *, center: npt.ArrayLike = (0.0, 0.0, 0.0), function: Function = "radius"
) -> Expansion:
    """An expansion of a `pyshtools.SHCoeffs` (SHGrid: of its ``expand()``), of any normalization.

    Parameters
    ----------
    clm : pyshtools.SHCoeffs or pyshtools.SHGrid
        Real, or complex of a real function.
    center : array_like, (3,)
        Of the surface.
    function : {"radius", "gauge", "other"}
        What the function is.
    """
    if hasattr(clm, "expand") and not hasattr(clm, "coeffs"):
        clm = clm.expand()
    unit = getattr(clm, "units", None) or ""
    return Expansion(core_of(clm), center=center, function=function, unit=unit)


def as_expansion(thing: Any) -> Expansion:
    """An `Expansion` of one, or of pyshtools.SHCoeffs.

    Parameters
    ----------
    thing : Expansion or pyshtools.SHCoeffs
        Anything else is a TypeError.
    """
    if isinstance(thing, Expansion):
        return thing
    if type(thing).__module__.partition(".")[0] == "pyshtools":
        return from_pyshtools(thing)
    raise TypeError(
        f"an Expansion is needed, not {type(thing).__name__}; expand(), load() and from_array() make one"
    )
