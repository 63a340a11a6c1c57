"""Rotates, mirrors, scales, recentres and aligns expansions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, overload

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import public
from ._arrays import FloatArray, float_row, numeric
from ._coefficients import array_of, core_of
from ._errors import InvalidInputError
from ._expand import as_expansion
from ._expansion import CoefficientsLike, Expansion
from ._options import options_of, takes
from ._rotations import RotationLike, as_rotation
from ._run import Progress, caller, warn

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._keywords import AlignKeywords


@public
def rotate(
    thing: Any,
    rotation: RotationLike,
    about: npt.ArrayLike = (0.0, 0.0, 0.0),
    *,
    threads: int = 0,
    progress: Progress = None,
) -> Any:
    """Returns a rotated expansion, rotated coefficients or rotated points.

    Parameters
    ----------
    thing : Expansion, array_like (2, L+1, L+1), or points (..., 3)
        The object. Arrays of coefficients are in pyshtools' default convention, and so is the
        result.
    rotation : rotation-like
        Rotation that takes the point x to R x; a function f becomes f(R^-1 u).
    about : array_like, (3,)
        Fixed point of the rotation, for an expansion or points.
    threads, progress
        See ``help(rholm)``.

    Examples
    --------
    >>> quarter = rholm.rotation_about((0, 0, 1), np.pi / 2)
    >>> rholm.harmonics.rotate([[1.0, 0, 0]], quarter).round(6) + 0.0
    array([[0., 1., 0.]])
    """
    if isinstance(thing, Expansion):
        return thing.rotate(rotation, about, threads=threads, progress=progress)
    turn = as_rotation(rotation)
    array = numeric(thing, "thing") if not hasattr(thing, "coeffs") else None
    if array is None or (array.ndim == 3 and array.shape[0] == 2 and array.shape[1] == array.shape[2]):
        with caller(threads, progress) as how:
            return array_of(_core.rotate(core_of(thing), turn, how))
    if array.ndim == 0 or array.shape[-1] != 3:
        raise InvalidInputError(
            f"points (..., 3) or coefficients (2, L+1, L+1) are needed, not {array.shape}"
        )
    origin = float_row(about, "about")
    rows = np.ascontiguousarray(array.reshape(-1, 3), dtype=np.float64)
    return (_core.rotate(np.ascontiguousarray(rows - origin), turn) + origin).reshape(array.shape)


@public
def mirror(
    thing: Expansion | CoefficientsLike, axis: Literal["x", "y", "z"], about: npt.ArrayLike = (0.0, 0.0, 0.0)
) -> Any:
    """Returns the mirror image of an expansion, or of coefficients.

    Parameters
    ----------
    thing : Expansion or coefficients-like
        The function. Arrays are in pyshtools' default convention, and so is the result.
    axis : {"x", "y", "z"}
        The coordinate that changes its sign.
    about : array_like, (3,)
        A point of the plane, for an expansion.

    Examples
    --------
    >>> s = rholm.expand(rholm.bumpy_sphere(3), degree=4)
    >>> rholm.harmonics.mirror(rholm.harmonics.mirror(s, "x"), "x") == s
    True
    """
    if isinstance(thing, Expansion):
        return thing.mirror(axis, about)
    return array_of(_core.mirror(core_of(thing), axis))


@public
def scaled(expansion: Expansion, factor: float) -> Expansion:
    """Returns an expansion with all lengths multiplied by a factor.

    Parameters
    ----------
    expansion : Expansion
        Expansion, which does not change.
    factor : float
        Factor, above 0.

    Examples
    --------
    >>> s = rholm.expand(rholm.icosphere(4), degree=4)
    >>> round(rholm.harmonics.scaled(s, 2).volume / s.volume, 6)
    8.0
    """
    return as_expansion(expansion).scale(factor)


@public
def recentered(
    expansion: Expansion, center: npt.ArrayLike, *, threads: int = 0, progress: Progress = None
) -> Expansion:
    """Returns the same surface about another centre.

    Parameters
    ----------
    expansion : Expansion
        Expansion that is star-shaped about both centres.
    center : array_like, (3,)
        New centre.
    threads, progress
        See ``help(rholm)``.

    Examples
    --------
    >>> s = rholm.expand(rholm.icosphere(4), degree=8)
    >>> rholm.harmonics.recentered(s, (0, 0, 0.1)).center.tolist()
    [0.0, 0.0, 0.1]
    """
    return as_expansion(expansion).recenter(center, threads=threads, progress=progress)


@public
def seen_center(expansion: Expansion, wanted: npt.ArrayLike, *, threads: int = 0) -> FloatArray:
    """Returns the wanted centre if `recentered` accepts it, otherwise a point between both centres,
    (3,).

    Parameters
    ----------
    expansion : Expansion
        Expansion that is star-shaped about its own centre.
    wanted : array_like, (3,)
        Point near which the new centre should be.
    threads : int
        Number of threads; see ``help(rholm)``.

    Examples
    --------
    >>> s = rholm.expand(rholm.icosphere(4), degree=8)
    >>> rholm.harmonics.seen_center(s, (0, 0, 0.25)).tolist()
    [0.0, 0.0, 0.25]
    """
    at = tuple(float(x) for x in float_row(wanted, "wanted"))
    with caller(threads, False) as how:
        return _core.seen_center(as_expansion(expansion)._core, at, how)


@public
def volume_centroid(expansion: Expansion, *, threads: int = 0) -> FloatArray:
    """Returns the centroid of the solid within a surface, (3,).

    Parameters
    ----------
    expansion : Expansion
        Expansion of a surface.
    threads : int
        Number of threads; see ``help(rholm)``.

    Examples
    --------
    >>> s = rholm.expand(rholm.icosphere(4), degree=8, center=(0, 0, 0.1))
    >>> rholm.harmonics.volume_centroid(s).round(3) + 0.0
    array([0., 0., 0.])
    """
    with caller(threads, False) as how:
        return _core.volume_centroid(as_expansion(expansion)._core, how)


@overload
def align(
    a: Expansion,
    b: Expansion,
    *,
    centers: Literal["auto", "volume", "own"] = "auto",
    threads: int = 0,
    progress: Progress = None,
    **options: Unpack[AlignKeywords],
) -> _core.Placement: ...
@overload
def align(
    a: CoefficientsLike,
    b: CoefficientsLike,
    *,
    centers: Literal["auto", "volume", "own"] = "auto",
    threads: int = 0,
    progress: Progress = None,
    **options: Unpack[AlignKeywords],
) -> _core.Placement | _core.Alignment: ...
@public
@takes(_core.AlignOptions)
def align(
    a: Expansion | CoefficientsLike,
    b: Expansion | CoefficientsLike,
    *,
    centers: Literal["auto", "volume", "own"] = "auto",
    threads: int = 0,
    progress: Progress = None,
    **options: Unpack[AlignKeywords],
) -> _core.Placement | _core.Alignment:
    """Finds the rotation of largest correlation that turns a onto b.

    Parameters
    ----------
    a, b : Expansion or coefficients-like
        Two surfaces, or two functions on the sphere.
    centers : {"auto", "volume", "own"}
        Points of the surfaces that are brought together first: centroids of the solids, or the
        centres of the expansions. The choice "auto" takes the centroids if both see their whole
        surfaces. Otherwise it takes the expansions' centres, with a warning.
    {options}
    threads, progress
        See ``help(rholm)``.

    Returns
    -------
    placement : Placement
        Placement of two expansions; `placed` moves a by it. The result is an `Alignment` for two
        functions.

    Examples
    --------
    >>> s = rholm.expand(rholm.bumpy_sphere(3, 0.3), degree=8)
    >>> turned = s.rotate(rholm.rotation_about((1, 2, 3), 0.4))
    >>> best = rholm.align(s, turned).alignment.best
    >>> round(rholm.harmonics.axis_angle_of(best.rotation)[1], 6)
    0.4
    """
    wanted = options_of(_core.AlignOptions, {**options}, "align")
    with caller(threads, progress) as how:
        if isinstance(a, Expansion) and isinstance(b, Expansion):
            placement = _core.align(a._core, b._core, centers, wanted, how)
            if placement.why_own:
                warn(f"the expansions' own centres are taken: {placement.why_own}")
            return placement
        return _core.align(core_of(a), core_of(b), wanted, how)


@public
def placed(
    a: Expansion, placement: _core.Placement, *, threads: int = 0, progress: Progress = None
) -> Expansion:
    """Returns the expansion moved by a placement.

    Parameters
    ----------
    a : Expansion
        Expansion that was aligned.
    placement : Placement
        Placement from `align`.
    threads, progress
        See ``help(rholm)``.

    Examples
    --------
    >>> s = rholm.expand(rholm.bumpy_sphere(3, 0.3), degree=8)
    >>> turned = s.rotate(rholm.rotation_about((1, 2, 3), 0.4))
    >>> rholm.harmonics.distance(rholm.placed(s, rholm.align(s, turned)), turned) < 1e-6
    True
    """
    with caller(threads, progress) as how:
        return Expansion._of(_core.placed(as_expansion(a)._core, placement, how))
