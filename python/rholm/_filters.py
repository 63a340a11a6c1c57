"""Filters: a factor for each degree."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

import numpy.typing as npt

from . import _core
from ._arguments import public
from ._arrays import FloatArray, floats
from ._coefficients import array_of, core_of
from ._expansion import CoefficientsLike, Expansion
from ._tables import Window

_Function = TypeVar("_Function", bound=Callable[..., Any])


def _with_windows(function: _Function) -> _Function:
    """Replaces <windows> and <parameters> in a docstring by texts from the library's table of windows."""
    rows = _core.windows()
    windows = "{" + ", ".join(f'"{row["name"]}"' for row in rows) + "}"
    owners: dict[str, list[str]] = {}
    parameters: dict[str, dict[str, Any]] = {}
    for row in rows:
        for parameter in row["parameters"]:
            parameters[parameter["name"]] = parameter
            owners.setdefault(parameter["name"], []).append(f'"{row["name"]}"')
    lines = [
        f"{name} : {'int' if one['whole'] else 'float, optional'}\n        {one['symbol']} of "
        f"{' and '.join(owners[name])}, {one['min']:g} ... {one['max']:g}; {one['help']}."
        for name, one in parameters.items()
    ]
    text = (function.__doc__ or "").replace("<windows>", windows)
    function.__doc__ = text.replace("<parameters>", "\n    ".join(lines))
    return function


@public
@_with_windows
def low_pass(
    cutoff: int, degree: int, window: Window = "lanczos", *, order: int = 4, time: float | None = None
) -> FloatArray:
    """Returns the gains of a low-pass filter for the degrees 0 ... `degree`, (degree + 1,).

    Parameters
    ----------
    cutoff : int
        L: degrees above it are removed.
    degree : int
        Last degree of the gains.
    window : <windows>
        How gains fall from 1 at degree 0. A sharper fall keeps more of the shape and rings more at
        edges: see `overshoot`.
    <parameters>

    Examples
    --------
    >>> rholm.low_pass(2, 4, "ideal")
    array([1., 1., 1., 0., 0.])
    """
    return _core.low_pass(cutoff, degree, window, order, time)


@public
def high_pass(
    cutoff: int, degree: int, window: Window = "lanczos", *, order: int = 4, time: float | None = None
) -> FloatArray:
    """Returns gains that keep the degrees from `cutoff` on: 1 - low_pass(cutoff - 1).

    Parameters
    ----------
    cutoff : int
        First degree to keep, at least 1.
    degree, window, order, time
        As in `low_pass`.

    Examples
    --------
    >>> rholm.high_pass(2, 4, "ideal")
    array([0., 0., 1., 1., 1.])
    """
    return _core.high_pass(cutoff, degree, window, order, time)


@public
def band_pass(
    first: int,
    last: int,
    degree: int,
    window: Window = "lanczos",
    *,
    order: int = 4,
    time: float | None = None,
) -> FloatArray:
    """Returns gains that keep the degrees from `first` to `last`.

    Parameters
    ----------
    first, last : int
        First and last degree of the band.
    degree, window, order, time
        As in `low_pass`.

    Examples
    --------
    >>> rholm.band_pass(1, 3, 4, "ideal")
    array([0., 1., 1., 1., 0.])
    """
    return _core.band_pass(first, last, degree, window, order, time)


@public
def sharpened(gains: npt.ArrayLike, amount: float) -> FloatArray:
    """Returns gains for unsharp masking: 1 + amount (1 - g).

    Parameters
    ----------
    gains : array_like, (n,)
        Gains of a low-pass filter.
    amount : float
        Strength; 0 changes nothing.

    Examples
    --------
    >>> rholm.harmonics.sharpened([1, 0.5, 0], 2)
    array([1., 2., 3.])
    """
    return _core.sharpened(floats(gains, "gains"), amount)


@public
def overshoot(gains_or_window: npt.ArrayLike | str, degree: int | None = None) -> _core.Overshoot:
    """Returns the overshoot of a filtered step beyond 0 ... 1, relative to its height.

    Parameters
    ----------
    gains_or_window : array_like, (n,), or str
        Gains of a filter, or the name of a window.
    degree : int, optional
        Cutoff of that window.

    Examples
    --------
    >>> (
    ...     round(rholm.harmonics.overshoot("ideal", 64).above, 2),
    ...     rholm.harmonics.overshoot("heat", 64).above,
    ... )
    (0.09, 0.0)
    """
    if isinstance(gains_or_window, str):
        if degree is None:
            raise TypeError("overshoot() of a window needs its degree")
        return _core.overshoot(gains_or_window, degree)
    return _core.overshoot(floats(gains_or_window, "gains"))


@public
def filter(thing: Expansion | CoefficientsLike, gains: npt.ArrayLike, name: str = "filter") -> Any:
    """Multiplies each degree of an expansion, or of coefficients, by a factor.

    Parameters
    ----------
    thing : Expansion or coefficients-like
        The function. Arrays are in pyshtools' default convention, and so is the result.
    gains : array_like, (n,)
        Gains of the degrees from 0 on.
    name : str
        Name of the filter, which is added to the expansion's method.

    Examples
    --------
    >>> c = np.ones((2, 1, 1)) * [[[2.0]], [[0.0]]]
    >>> float(rholm.harmonics.filter(c, [0.5])[0, 0, 0])
    1.0
    """
    if isinstance(thing, Expansion):
        return thing.filter(gains, name)
    return array_of(_core.filter(core_of(thing), floats(gains, "gains")))
