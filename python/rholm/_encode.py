"""From a mesh to an expansion, the whole way; from coefficients of others."""

from __future__ import annotations

import os
from typing import Any, Literal

import numpy.typing as npt

from . import _core
from ._arrays import triangle_rows, triple, unwritable, vertex_rows
from ._coefficients import Function, Normalization, core_of, from_convention
from ._errors import InvalidInputError
from ._expansion import Expansion
from ._interop import foreign_mesh
from ._run import Progress, caller
from ._shapes import MeshLike, as_mesh, name_of

Method = Literal["edge", "gauge", "curl", "area"]


Unit = Literal["absolute", "diagonal", "radius"]


def _center_of(center: Any) -> tuple[str, tuple[float, float, float] | None]:
    if isinstance(center, str):
        return center, None
    return "", triple(center, "center")


def tolerance_of(
    error: float, unit: Unit, norm: str, measure: str | None, max_degree: int
) -> _core.Tolerance:
    """As `expand` takes it."""
    if measure is None:
        measure = "distance" if unit == "diagonal" else "radius"
    return _core.Tolerance(error=error, unit=unit, norm=norm, measure=measure, max_degree=max_degree)


def encode_options(
    degree: int | None,
    tolerance: float | None,
    unit: Unit,
    norm: str,
    measure: str | None,
    max_degree: int,
    method: str,
    engine: str,
    precision: float,
    center: Any,
    rays: int,
    signed: bool,
    errors: bool,
    weld: float,
) -> _core.EncodeOptions:
    """As `expand` takes them."""
    if degree is not None and tolerance is not None:
        raise InvalidInputError("degree and tolerance exclude one another: give one of them")
    analyze = _core.AnalyzeOptions(degree=degree, method=method, engine=engine, precision=precision)
    options = _core.EncodeOptions(analyze=analyze, errors=errors, weld_tolerance=weld)
    if tolerance is not None:
        options.tolerance = tolerance_of(tolerance, unit, norm, measure, max_degree)
    name, point = _center_of(center)
    options.set_chart(name, point, rays, signed)
    return options


def expand(
    shape: MeshLike,
    degree: int | None = None,
    *,
    tolerance: float | None = None,
    unit: Unit = "absolute",
    norm: Literal["rms", "max"] = "rms",
    measure: Literal["radius", "distance"] | None = None,
    max_degree: int = 1024,
    method: Method = "edge",
    engine: Literal["fast", "direct"] = "fast",
    precision: float = 1e-8,
    center: Any = "auto",
    rays: int = 100_000,
    signed: bool = False,
    errors: bool = True,
    weld: float = 0.0,
    length_unit: str = "",
    threads: int = 0,
    progress: Progress = None,
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
    unit : {"absolute", "diagonal", "radius"}
        Of the tolerance: the mesh's own, of its bounding box's diagonal, of its mean radius.
    norm : {"rms", "max"}
        Of all errors of the tolerance.
    measure : {"radius", "distance"}, optional
        Of each error: along rays from the centre, or between the surfaces. By default the radius,
        with ``unit="diagonal"`` the distance.
    max_degree : int
        Where the search for a tolerance ends.
    method : {"edge", "gauge", "curl", "area"}
        Which function is expanded (gauge: 1/r, the others r) and by which integrals.
    engine : {"fast", "direct"}
        Of the sums; direct ones are the oracle.
    precision : float
        Wanted error of the coefficients, 1e-14 ... 1e-1: l2 relative to the norm of the function
        without its mean.
    center : {"auto", "kernel", "slope", "cosine", "none", "centroid", "volume"} or array_like, (3,)
        Where the centre is. "auto", "slope": where the radius has the least slope, on the line
        through "kernel" and the centroid of the solid, well within the points that see the whole
        surface; "kernel": in the middle of these points; "cosine": where the surface is seen least
        aslant; "none": the origin; "centroid": of the surface; "volume": of the solid, or as
        "slope" where not all is seen from there.
    rays : int
        Directions tried by the check for a star shape; 0 leaves them out.
    signed : bool
        Whether a surface that is not star-shaped is taken: by the signed sum of its radii, a
        descriptor that does not give back the body. `compress` makes a model that does.
    errors : bool
        Whether truncation errors are measured and predicted.
    weld : float
        Tolerance of welding, in the mesh's unit; 0 joins identical vertices.
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
    options = encode_options(
        degree,
        tolerance,
        unit,
        norm,
        measure,
        max_degree,
        method,
        engine,
        precision,
        center,
        rays,
        signed,
        errors,
        weld,
    )
    with caller(threads, progress) as how:
        if isinstance(shape, (str, os.PathLike)):
            encoded, _ = _core.encode_file(os.fspath(shape), options, how)
        else:
            encoded = _core.encode(*_mesh_arrays(shape), options, how)
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
