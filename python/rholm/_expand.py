"""Makes expansions from meshes, and from coefficients of other packages."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Literal

import numpy.typing as npt

from . import _core
from ._arguments import public
from ._arrays import face_rows, triple, unwritable, vertex_rows
from ._coefficients import Function, Normalization, core_of, from_convention
from ._convert import MeshLike, as_mesh
from ._errors import InvalidInputError
from ._expansion import Expansion
from ._interop import foreign_mesh
from ._options import given_of, takes
from ._run import Progress, caller
from ._shapes import name_of

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._keywords import CenterKeywords, ChartKeywords, ExpandKeywords, ToleranceKeywords, TransformKeywords

    class ChartExpandKeywords(TransformKeywords, ToleranceKeywords, total=False):
        """Method and tolerance of an expansion."""

    class MeshExpandKeywords(ToleranceKeywords, CenterKeywords, ChartKeywords, ExpandKeywords, total=False):
        """Degree or tolerance of a model, and the permitted changes to the mesh."""


def center_options(center: Any, **rays: Any) -> _core.CenterOptions:
    """Returns options for the name of a kind of centre, or for a point."""
    if isinstance(center, str):
        options = _core.parse_center(center)
    else:
        options = _core.CenterOptions(center="given", point=triple(center, "center"))
    for name, value in rays.items():
        setattr(options, name, value)
    return options


def tolerance_of(
    degree: int | None, tolerance: float | None, measure: str | None, allowed: Any
) -> _core.Tolerance | None:
    """Returns the wanted tolerance, or None. `allowed` has the given fields of Tolerance."""
    if degree is not None and tolerance is not None:
        raise InvalidInputError("degree and tolerance exclude one another: give one of them")
    if tolerance is None:
        return None
    kept = _core.Tolerance(error=tolerance, **allowed)
    kept.measure = measure or ("distance" if kept.unit == "diagonal" else "radius")
    return kept


@public
@takes(_core.Tolerance, _core.CenterOptions, _core.ChartOptions, _core.ExpandOptions)
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
    **options: Unpack[MeshExpandKeywords],
) -> Expansion:
    """Computes the spherical-harmonic coefficients of a closed mesh.

    Parameters
    ----------
    shape : mesh-like
        (vertices, faces), a path, or a mesh of rholm, trimesh, PyVista or meshio. Writable
        arrays are copied first, because other threads may write to them. Read-only arrays of
        float32 or float64 and of 32-bit integers are not copied, and neither is a `Mesh`. A mesh
        that is inside out or has duplicate vertices is corrected.
    degree : int, optional
        Highest degree L; by default 64.
    tolerance : float, optional
        Largest allowed error. The smallest degree that keeps it is used.
    measure : {"radius", "distance"}, optional
        How errors are measured: along rays from the centre, or between the surfaces. By default the
        radius; with ``unit="diagonal"`` the distance.
    center : {"auto", "kernel", "slope", "cosine", "none", "centroid", "volume"} or array_like, (3,)
        Choice of the centre. For "auto" and "slope" the radius has the least slope there. This
        point is on the line through "kernel" and the centroid of the solid, well within the points
        that see the whole surface. The choice "kernel" is in the middle of these points. From
        "cosine" the surface is seen least obliquely. The choice "none" is the origin, "centroid" is
        the centroid of the surface. The choice "volume" is the centroid of the solid, or "slope" if
        the centroid does not see the whole surface.
    {options}
    length_unit : str
        Unit of the vertices: "km", "mm", ...
    threads, progress
        See ``help(rholm)``.

    Returns
    -------
    s : Expansion
        Expansion with ``s.errors`` and ``s.expanded``, the report of the computation.

    Raises
    ------
    InvalidInputError
        For a mesh that is not closed or not consistently oriented, and options out of range.
    NotStarShapedError
        With the numbers of the star check, unless `signed`; `compress` accepts any shape.

    Notes
    -----
    The coefficients are integrals over the edges and faces of the piecewise flat surface itself.
    They do not depend on samples: see docs/method.md.

    Examples
    --------
    >>> import rholm
    >>> s = rholm.expand(rholm.ellipsoid((3, 2, 1), 5), degree=16)
    >>> s.degree
    16
    >>> round(s.volume / (4 / 3 * 3.14159265 * 6), 2)
    1.0
    """
    kinds = (_core.Tolerance, _core.CenterOptions, _core.ChartOptions, _core.ExpandOptions)
    allowed, rays, signed, rest = given_of(*kinds, given={**options}, function="expand")
    wanted = _core.ExpandOptions(degree=degree, **rest)
    wanted.tolerance = tolerance_of(degree, tolerance, measure, allowed)
    wanted.chart = _core.ChartOptions(center=center_options(center, **rays), **signed)
    with caller(threads, progress) as how:
        if isinstance(shape, (str, os.PathLike)):
            expanded, _ = _core.expand_file(os.fspath(shape), wanted, how)
        else:
            expanded = _core.expand_mesh(*_mesh_arrays(shape), wanted, how)
    expansion = Expansion._of(expanded.transform.expansion, expanded, shape, name_of(shape))
    return expansion.with_unit(length_unit) if length_unit else expansion


def _mesh_arrays(shape: Any) -> tuple[Any, Any]:
    """Returns vertices and faces, copied only if other threads could write to them."""
    arrays = foreign_mesh(shape)
    if arrays is None:
        if type(shape) not in (tuple, list) or len(shape) != 2:
            core = as_mesh(shape)._core
            return core.vertices, core.faces
        arrays = (shape[0], shape[1], {})
    return unwritable(vertex_rows(arrays[0])), unwritable(face_rows(arrays[1]))


@public
def from_array(
    values: npt.ArrayLike,
    *,
    normalization: Normalization = "4pi",
    csphase: int = 1,
    center: npt.ArrayLike = (0.0, 0.0, 0.0),
    function: Function = "radius",
    unit: str = "",
) -> Expansion:
    """Makes an expansion from an array of coefficients.

    Parameters
    ----------
    values : array_like, (2, L+1, L+1)
        Cosine plane, sine plane.
    normalization, csphase
        Convention of the array; by default pyshtools' default.
    center : array_like, (3,)
        Centre of the surface.
    function : {"radius", "gauge", "other"}
        Meaning of the function.
    unit : str
        Unit of lengths.

    Examples
    --------
    >>> c = np.zeros((2, 3, 3))
    >>> c[0, 0, 0] = 5
    >>> rholm.from_array(c, unit="km").mean_radius
    5.0
    """
    return Expansion(
        from_convention(values, normalization, csphase), center=center, function=function, unit=unit
    )


@public
def from_pyshtools(
    clm: Any, *, center: npt.ArrayLike = (0.0, 0.0, 0.0), function: Function = "radius"
) -> Expansion:
    """Makes an expansion from a `pyshtools.SHCoeffs`, or the ``expand()`` of an SHGrid, of any
    normalization.

    Parameters
    ----------
    clm : pyshtools.SHCoeffs or pyshtools.SHGrid
        Real coefficients, or complex ones of a real function.
    center : array_like, (3,)
        Centre of the surface.
    function : {"radius", "gauge", "other"}
        Meaning of the function.

    Examples
    --------
    >>> s = rholm.expand(rholm.bumpy_sphere(3), degree=4)
    >>> rholm.from_pyshtools(s.to_pyshtools(), center=s.center).degree
    4
    """
    if hasattr(clm, "expand") and not hasattr(clm, "coeffs"):
        clm = clm.expand()
    unit = getattr(clm, "units", None) or ""
    return Expansion(core_of(clm), center=center, function=function, unit=unit)


@public
def as_expansion(thing: Any) -> Expansion:
    """Returns an `Expansion` unchanged, or makes one from pyshtools.SHCoeffs.

    Parameters
    ----------
    thing : Expansion or pyshtools.SHCoeffs
        Any other object raises TypeError.

    Examples
    --------
    >>> s = rholm.from_array(np.zeros((2, 3, 3)))
    >>> rholm.harmonics.as_expansion(s) is s
    True
    """
    if isinstance(thing, Expansion):
        return thing
    if type(thing).__module__.partition(".")[0] == "pyshtools":
        return from_pyshtools(thing)
    raise TypeError(
        f"an Expansion is needed, not {type(thing).__name__}; expand(), load() and from_array() make one"
    )
