"""Coefficients as arrays: conventions, spectra, units."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import FloatArray, numeric
from ._errors import InvalidInputError
from ._interop import _package, coefficients_of_pyshtools

if TYPE_CHECKING:
    from ._expansion import CoefficientsLike, Expansion

#: What the mean square of each harmonic over the sphere is: 1 for "4pi" (geodesy, pyshtools'
#: default), 1/(4 pi) for "orthonormal", 1/(2l+1) for "schmidt".
Normalization = Literal["4pi", "orthonormal", "schmidt"]

#: What is expanded: r, 1/r, or no surface: a gravity field.
Function = Literal["radius", "gauge", "other"]

#: See `power_spectrum`.
SpectrumKind = Literal["energy", "power"]
SpectrumUnit = Literal["per_l", "per_lm", "per_dlogl"]


def core_of(coefficients: CoefficientsLike) -> _core.Coefficients:
    """Coefficients in the library's own convention."""
    from ._expansion import Expansion

    if isinstance(coefficients, _core.Coefficients):
        return coefficients
    if isinstance(coefficients, Expansion):
        return coefficients._core.coefficients
    if _package(coefficients) == "pyshtools":
        convention: Any
        values, *convention = coefficients_of_pyshtools(coefficients)
        return from_convention(values, *convention)
    return from_convention(coefficients)


def array_of(core: _core.Coefficients, normalization: Normalization = "4pi", csphase: int = 1) -> FloatArray:
    """Coefficients of the library as an array (2, L+1, L+1) of a convention."""
    return np.array(_core.to_convention(core, normalization, csphase).values)


def from_convention(
    values: npt.ArrayLike, normalization: Normalization = "4pi", csphase: int = 1
) -> _core.Coefficients:
    """Coefficients in the library's own convention: orthonormal, without Condon-Shortley phase.

    Parameters
    ----------
    values : array_like, (2, L+1, L+1)
        Cosine plane, sine plane. Entries that are no coefficients, with m > l and sines of order 0,
        must be 0 but for rounding, 6e-14 of the largest entry.
    normalization : {"4pi", "orthonormal", "schmidt"}
        Of the array.
    csphase : {1, -1}
        -1 if its harmonics have the factor (-1)^m.
    """
    array = numeric(values, "coefficients")
    if array.ndim != 3 or array.shape[0] != 2:
        raise InvalidInputError(f"coefficients: an array (2, L+1, L+1) is needed, not {array.shape}")
    rows = np.ascontiguousarray(array, dtype=np.float64)
    if not np.isfinite(rows).all():
        raise InvalidInputError("coefficients: a number is not finite")
    return _core.from_convention(rows, normalization, csphase)


def to_convention(
    coefficients: CoefficientsLike, normalization: Normalization = "4pi", csphase: int = 1
) -> FloatArray:
    """Coefficients as an array (2, L+1, L+1) of a convention.

    Parameters
    ----------
    coefficients : coefficients-like
        An array is taken to be in pyshtools' default convention.
    normalization : {"4pi", "orthonormal", "schmidt"}
        What the mean square of each harmonic is: 1, 1/(4 pi), 1/(2l+1).
    csphase : {1, -1}
        -1: harmonics with the Condon-Shortley factor (-1)^m.
    """
    return array_of(core_of(coefficients), normalization, csphase)


def rms_beyond(expansion: Expansion) -> FloatArray:
    """What is left out when a series ends at each of its degrees; see `Expansion.rms_beyond`.

    Parameters
    ----------
    expansion : Expansion
        Of any function.
    """
    return expansion.rms_beyond()


def power_spectrum(
    coefficients: CoefficientsLike,
    kind: SpectrumKind = "energy",
    unit: SpectrumUnit = "per_l",
    base: float = 10.0,
) -> FloatArray:
    """Energy, or power, by degree, l = 0 ... L, (L+1,).

    Parameters
    ----------
    coefficients : coefficients-like
        The function.
    kind : {"energy", "power"}
        "energy": its sum is the integral of f^2 over the sphere; "power": the mean square, 4 pi less,
        as pyshtools' ``spectrum()`` has it by default.
    unit : {"per_l", "per_lm", "per_dlogl"}
        Of each degree; of each of its 2l+1 coefficients, on average; or of a band of degrees: l
        ln(base) times that of the degree, so that d log_base(l) of it is the band's. As in pyshtools.
    base : float
        Of the logarithm in "per_dlogl", above 1.

    Raises
    ------
    InvalidInputError
        For another kind, unit or base.
    """
    if kind not in ("power", "energy"):
        raise InvalidInputError(f"kind is 'power' or 'energy', not {kind!r}")
    if unit not in ("per_l", "per_lm", "per_dlogl"):
        raise InvalidInputError(f"unit is 'per_l', 'per_lm' or 'per_dlogl', not {unit!r}")
    if not (base > 1 and np.isfinite(base)):
        raise InvalidInputError(f"base is {base}; it must be above 1")
    values = _core.power_spectrum(core_of(coefficients))
    if kind == "power":
        values /= 4 * np.pi
    degrees = np.arange(len(values))
    if unit == "per_lm":
        values /= 2 * degrees + 1
    elif unit == "per_dlogl":
        values *= degrees * np.log(base)
    return values


def distance(a: CoefficientsLike, b: CoefficientsLike) -> float:
    """Root mean square of a - b over the sphere; missing degrees are zero.

    Parameters
    ----------
    a, b : coefficients-like
        Two functions.
    """
    return _core.distance(core_of(a), core_of(b))


def descriptor_distance(a: CoefficientsLike, b: CoefficientsLike) -> float:
    """Distance of the norms per degree: at most the distance after any rotation.

    Parameters
    ----------
    a, b : coefficients-like
        Two functions.

    References
    ----------
    M. Kazhdan, T. Funkhouser, S. Rusinkiewicz, Rotation invariant spherical harmonic representation
    of 3D shape descriptors, 2003.
    """
    return _core.descriptor_distance(core_of(a), core_of(b))


def principal_axes(coefficients: CoefficientsLike, function: Function = "radius") -> _core.PrincipalAxes:
    """The axes of the quadratic form that the coefficients of degree 2 are, longest first.

    They diagonalise Q of ``f_2(u) = u^T Q u``, f_2 the part of degree 2: of a radius those of its
    ellipsoid-like part. They depend on the centre of the expansion and on no degree but 2 (their
    signs on degree 3), so that they are not the axes of inertia, which `inertia` has.

    Parameters
    ----------
    coefficients : coefficients-like
        The function.
    function : {"radius", "gauge", "other"}
        For a gauge, 1/r, the form's sign is turned.

    Returns
    -------
    axes : PrincipalAxes
        Unit vectors, values in the unit of the coefficients (their sum is 0), and the rotation that
        turns them to x, y, z.
    """
    return _core.principal_axes(core_of(coefficients), function)


def metres_of(unit: str) -> float | None:
    """How many metres a unit has: "m" and its decimal parts and multiples, "in", "ft", "au", ...

    Parameters
    ----------
    unit : str
        "mm" and "Mm" differ. None is returned for any other text.
    """
    return _core.metres_of(unit)


def check_unit(unit: str) -> None:
    """Raises InvalidInputError unless a text can name a unit of lengths in every format.

    Parameters
    ----------
    unit : str
        One line of at most 256 bytes without blanks at its ends.
    """
    _core.check_unit(unit)
