"""Coefficients as arrays: conventions, spectra, units."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, cast

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import public
from ._arrays import FloatArray, numeric
from ._errors import InvalidInputError
from ._interop import _package, coefficients_of_pyshtools

if TYPE_CHECKING:
    from ._expansion import CoefficientsLike, Expansion

#: Mean square of each harmonic over the sphere: 1 for "4pi" (geodesy, pyshtools' default), 1/(4 pi)
#: for "orthonormal", 1/(2l+1) for "schmidt".
Normalization = Literal["4pi", "orthonormal", "schmidt"]

#: The expanded function: r, 1/r, or no surface, for example a gravity field.
Function = Literal["radius", "gauge", "other"]

#: See `power_spectrum`.
SpectrumKind = Literal["energy", "power"]
SpectrumUnit = Literal["per_l", "per_lm", "per_dlogl"]


def core_of(coefficients: CoefficientsLike) -> _core.Coefficients:
    """Returns coefficients in the library's own convention."""
    if isinstance(coefficients, _core.Coefficients):
        return coefficients
    inner = getattr(coefficients, "_core", None)
    if isinstance(inner, _core.Expansion):
        return inner.coefficients
    if _package(coefficients) == "pyshtools":
        convention: Any
        values, *convention = coefficients_of_pyshtools(coefficients)
        return from_convention(values, *convention)
    return from_convention(cast("npt.ArrayLike", coefficients))


def array_of(core: _core.Coefficients, normalization: Normalization = "4pi", csphase: int = 1) -> FloatArray:
    """Returns coefficients of the library as an array (2, L+1, L+1) in a convention."""
    return np.array(_core.to_convention(core, normalization, csphase).values)


@public
def from_convention(
    values: npt.ArrayLike, normalization: Normalization = "4pi", csphase: int = 1
) -> _core.Coefficients:
    """Converts an array to the library's own convention: orthonormal, without Condon-Shortley
    phase.

    Parameters
    ----------
    values : array_like, (2, L+1, L+1)
        Cosine plane, sine plane. Entries with m > l and sines of order 0 must be 0 up to rounding,
        6e-14 of the largest entry.
    normalization : {"4pi", "orthonormal", "schmidt"}
        Normalization of the array.
    csphase : {1, -1}
        Phase of its harmonics: -1 for the factor (-1)^m.

    Examples
    --------
    >>> own = rholm.harmonics.from_convention([[[1.0]], [[0.0]]], "4pi")
    >>> bool(np.isclose(own.values[0, 0, 0], np.sqrt(4 * np.pi)))
    True
    """
    array = numeric(values, "coefficients")
    if array.ndim != 3 or array.shape[0] != 2:
        raise InvalidInputError(f"coefficients: an array (2, L+1, L+1) is needed, not {array.shape}")
    rows = np.ascontiguousarray(array, dtype=np.float64)
    if not np.isfinite(rows).all():
        raise InvalidInputError("coefficients: a number is not finite")
    return _core.from_convention(rows, normalization, csphase)


@public
def to_convention(
    coefficients: CoefficientsLike, normalization: Normalization = "4pi", csphase: int = 1
) -> FloatArray:
    """Returns coefficients as an array (2, L+1, L+1) in a convention.

    Parameters
    ----------
    coefficients : coefficients-like
        The function. An array must be in pyshtools' default convention.
    normalization : {"4pi", "orthonormal", "schmidt"}
        Mean square of each harmonic over the sphere: 1, 1/(4 pi), 1/(2l+1).
    csphase : {1, -1}
        Phase of the harmonics: -1 for the Condon-Shortley factor (-1)^m.

    Examples
    --------
    >>> s = rholm.expand(rholm.icosphere(4), degree=2)
    >>> factor = rholm.harmonics.to_convention(s, "orthonormal")[0, 0, 0] / s.coeffs[0, 0, 0]
    >>> bool(np.isclose(factor, np.sqrt(4 * np.pi)))
    True
    """
    return array_of(core_of(coefficients), normalization, csphase)


@public
def rms_beyond(expansion: Expansion) -> FloatArray:
    """Returns the truncation error at each degree; see `Expansion.rms_beyond`.

    Parameters
    ----------
    expansion : Expansion
        Expansion of any function.

    Examples
    --------
    >>> s = rholm.expand(rholm.bumpy_sphere(3), degree=8)
    >>> error = rholm.harmonics.rms_beyond(s)
    >>> bool(error[8] < error[0])
    True
    """
    return expansion.rms_beyond()


@public
def power_spectrum(
    coefficients: CoefficientsLike,
    kind: SpectrumKind = "energy",
    unit: SpectrumUnit = "per_l",
    base: float = 10.0,
) -> FloatArray:
    """Returns energy or power per degree, l = 0 ... L, (L+1,).

    Parameters
    ----------
    coefficients : coefficients-like
        The function.
    kind : {"energy", "power"}
        For "energy" the sum over l is the integral of f^2 over the sphere. For "power" the sum is
        the mean square of f, smaller by 4 pi. This is the default of pyshtools' ``spectrum()``.
    unit : {"per_l", "per_lm", "per_dlogl"}
        By degree, by coefficient (the mean over the 2l+1 coefficients of the degree), or for a band
        of degrees. The last one is l ln(base) times the degree's value, a density in log_base(l),
        as in pyshtools.
    base : float
        Base of the logarithm in "per_dlogl", above 1.

    Raises
    ------
    InvalidInputError
        For another kind, unit or base.

    Examples
    --------
    >>> s = rholm.expand(rholm.bumpy_sphere(3), degree=8)
    >>> energy = rholm.harmonics.power_spectrum(s)
    >>> bool(np.isclose(energy.sum() / (4 * np.pi), (s.coeffs**2).sum()))
    True
    """
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


@public
def distance(a: CoefficientsLike, b: CoefficientsLike) -> float:
    """Returns the root mean square of a - b over the sphere; missing degrees are zero.

    Parameters
    ----------
    a, b : coefficients-like
        Two functions.

    Examples
    --------
    >>> c = np.zeros((2, 3, 3))
    >>> c[0, 2, 0] = 0.5
    >>> round(rholm.harmonics.distance(c, np.zeros((2, 1, 1))), 6)
    0.5
    """
    return _core.distance(core_of(a), core_of(b))


@public
def descriptor_distance(a: CoefficientsLike, b: CoefficientsLike) -> float:
    """Returns the distance of the norms per degree, a lower bound of the distance after any
    rotation.

    Parameters
    ----------
    a, b : coefficients-like
        Two functions.

    References
    ----------
    M. Kazhdan, T. Funkhouser, S. Rusinkiewicz, Rotation invariant spherical harmonic representation
    of 3D shape descriptors, 2003.

    Examples
    --------
    >>> s = rholm.expand(rholm.bumpy_sphere(3), degree=8)
    >>> turned = s.rotate(rholm.rotation_about((1, 2, 3), 0.4))
    >>> rholm.harmonics.descriptor_distance(s, turned) < 1e-12
    True
    """
    return _core.descriptor_distance(core_of(a), core_of(b))


@public
def principal_axes(coefficients: CoefficientsLike, function: Function = "radius") -> _core.PrincipalAxes:
    """Returns the principal axes of the quadratic form of degree 2, longest first.

    They diagonalise Q of ``f_2(u) = u^T Q u``, where f_2 is the part of degree 2. For a radius they
    are the axes of its ellipsoid-like part. They depend on the centre of the expansion and on
    degree 2 only (their signs on degree 3). The axes of inertia are others: see `inertia`.

    Parameters
    ----------
    coefficients : coefficients-like
        The function.
    function : {"radius", "gauge", "other"}
        Meaning of the function. For a gauge, 1/r, the form's sign is reversed.

    Returns
    -------
    axes : PrincipalAxes
        Unit vectors, values in the unit of the coefficients (their sum is 0), and the rotation that
        turns the axes to x, y, z.

    Examples
    --------
    >>> s = rholm.expand(rholm.ellipsoid((1, 2, 3), 4), degree=8)
    >>> np.abs(rholm.harmonics.principal_axes(s).axes[0]).round(6)
    array([0., 0., 1.])
    """
    return _core.principal_axes(core_of(coefficients), function)


@public
def metres_of(unit: str) -> float | None:
    """Returns the length of a unit in metres: "m" with decimal prefixes, "in", "ft", "au", ...

    Parameters
    ----------
    unit : str
        Name of the unit; "mm" and "Mm" differ. The result is None for any other text.

    Examples
    --------
    >>> rholm.harmonics.metres_of("km"), rholm.harmonics.metres_of("stone")
    (1000.0, None)
    """
    return _core.metres_of(unit)


@public
def check_unit(unit: str) -> None:
    """Raises InvalidInputError unless a text can name a unit of lengths in every format.

    Parameters
    ----------
    unit : str
        One line of at most 256 bytes without blanks at its ends.

    Examples
    --------
    >>> rholm.harmonics.check_unit("km")
    """
    _core.check_unit(unit)
