"""Coefficients as arrays: conventions, filters, sums, grids, rotations."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import FloatArray, float_rows, floats
from ._arrays import directions as unit_rows
from ._errors import InvalidInputError
from ._interop import _package, coefficients_of_pyshtools
from ._run import Progress, caller

if TYPE_CHECKING:
    from ._expansion import Expansion

#: What the mean square of each harmonic over the sphere is: 1 for "4pi" (geodesy, pyshtools'
#: default), 1/(4 pi) for "orthonormal", 1/(2l+1) for "schmidt".
Normalization = Literal["4pi", "orthonormal", "schmidt"]
#: How a low-pass filter falls; see `low_pass`.
Window = Literal["ideal", "lanczos", "lanczos2", "gaussian", "heat", "exponential", "plateau"]
#: Where the rings of a grid are; see `synthesize_grid`.
GridKind = Literal["gauss-legendre", "equiangular", "equiangular-with-poles"]
#: What stands for coefficients: an `Expansion`, pyshtools.SHCoeffs, or an array (2, L+1, L+1) in
#: pyshtools' default convention: 4 pi-normalised, without Condon-Shortley phase.
CoefficientsLike = Union["Expansion", npt.ArrayLike, Any]


def core_of(coefficients: CoefficientsLike) -> _core.Coefficients:
    """Coefficients in the library's own convention."""
    from ._expansion import Expansion

    if isinstance(coefficients, _core.Coefficients):
        return coefficients
    if isinstance(coefficients, Expansion):
        return coefficients._core.coefficients
    if _package(coefficients) == "pyshtools":
        return from_convention(*coefficients_of_pyshtools(coefficients))
    return from_convention(coefficients)


def array_of(core: _core.Coefficients, normalization: str = "4pi", csphase: int = 1) -> FloatArray:
    """Coefficients of the library as an array (2, L+1, L+1) of a convention."""
    return np.array(_core.to_convention(core, normalization, csphase).values)


def from_convention(
    values: npt.ArrayLike, normalization: str = "4pi", csphase: int = 1
) -> _core.Coefficients:
    """Coefficients in the library's own convention: orthonormal, without Condon-Shortley phase.

    Parameters
    ----------
    values : array_like, (2, L+1, L+1)
        Cosine plane, sine plane. What stands above the diagonal is not looked at.
    normalization : {"4pi", "orthonormal", "schmidt"}
        Of the array.
    csphase : {1, -1}
        -1 if its harmonics have the factor (-1)^m.
    """
    array = np.asarray(values)
    if array.dtype.kind not in "fiu":
        raise TypeError(f"coefficients: real numbers are needed, not an array of {array.dtype}")
    if array.ndim != 3 or array.shape[0] != 2:
        raise InvalidInputError(f"coefficients: an array (2, L+1, L+1) is needed, not {array.shape}")
    rows = np.ascontiguousarray(array, dtype=np.float64)
    if not np.isfinite(rows).all():
        raise InvalidInputError("coefficients: a number is not finite")
    return _core.from_convention(rows, normalization, csphase)


def to_convention(coefficients: CoefficientsLike, normalization: str = "4pi", csphase: int = 1) -> FloatArray:
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


def power_spectrum(coefficients: CoefficientsLike) -> FloatArray:
    """Energy per degree, l = 0 ... L: its sum is the integral of f^2 over the sphere.

    Parameters
    ----------
    coefficients : coefficients-like
        pyshtools' ``spectrum()`` of the same function is this divided by 4 pi.
    """
    return _core.power_spectrum(core_of(coefficients))


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


# Filters


def low_pass(
    cutoff: int, degree: int, window: Window = "lanczos", *, order: int = 4, time: float | None = None
) -> FloatArray:
    """Gains of a low-pass filter for the degrees 0 ... `degree`, (degree + 1,).

    Parameters
    ----------
    cutoff : int
        L: degrees above it go.
    degree : int
        The last degree of the gains.
    window : {"ideal", "lanczos", "lanczos2", "gaussian", "heat", "exponential", "plateau"}
        How gains fall from 1 at degree 0. Sharper is closer to the shape and rings more at edges:
        see `overshoot`.
    order : int
        p of "exponential", 1 ... 64.
    time : float, optional
        t of "heat"; by default the gain at L is 1/2.
    """
    return _core.low_pass(cutoff, degree, window, order, time)


def high_pass(
    cutoff: int, degree: int, window: Window = "lanczos", *, order: int = 4, time: float | None = None
) -> FloatArray:
    """Gains that keep the degrees from `cutoff` on: 1 - low_pass(cutoff - 1).

    Parameters
    ----------
    cutoff : int
        At least 1.
    degree, window, order, time
        As in `low_pass`.
    """
    return _core.high_pass(cutoff, degree, window, order, time)


def band_pass(
    first: int,
    last: int,
    degree: int,
    window: Window = "lanczos",
    *,
    order: int = 4,
    time: float | None = None,
) -> FloatArray:
    """Gains that keep the degrees from `first` to `last`.

    Parameters
    ----------
    first, last : int
        Of the band.
    degree, window, order, time
        As in `low_pass`.
    """
    return _core.band_pass(first, last, degree, window, order, time)


def sharpened(gains: npt.ArrayLike, amount: float) -> FloatArray:
    """Unsharp masking: 1 + amount (1 - g).

    Parameters
    ----------
    gains : array_like, (n,)
        Of a low-pass filter.
    amount : float
        0 leaves all as it is.
    """
    return _core.sharpened(floats(gains, "gains"), amount)


def overshoot(gains_or_window: npt.ArrayLike | str, degree: int | None = None) -> _core.Overshoot:
    """How far a filtered step leaves 0 ... 1, in parts of its height.

    Parameters
    ----------
    gains_or_window : array_like, (n,), or str
        Gains of a filter, or the name of a window.
    degree : int, optional
        Of that window's cutoff.
    """
    if isinstance(gains_or_window, str):
        if degree is None:
            raise TypeError("overshoot() of a window needs its degree")
        return _core.overshoot(gains_or_window, degree)
    return _core.overshoot(floats(gains_or_window, "gains"))


# Sums at scattered directions, on rings and grids


def evaluate(
    coefficients: CoefficientsLike,
    directions: npt.ArrayLike,
    *,
    engine: str = "fast",
    precision: float = 1e-12,
    threads: int = 0,
    progress: Progress = None,
) -> FloatArray:
    """Values f(u) of a function on the sphere.

    Parameters
    ----------
    coefficients : coefficients-like
        The function.
    directions : array_like, (..., 3)
        Vectors of any length.
    engine : {"fast", "direct"}
        On a grid, O(N + L^3), to a precision; or term by term, O(N L^2), exact to rounding.
    precision : float
        1e-14 ... 1e-1: the l2 norm of all errors relative to that of sums with random signs.
    threads, progress
        See `rholm.caller`.

    Returns
    -------
    values : float64, (...)
    """
    rows, shape = unit_rows(directions)
    with caller(threads, progress) as how:
        return _core.evaluate(core_of(coefficients), rows, engine, precision, how).reshape(shape)


def evaluate_with_gradient(
    coefficients: CoefficientsLike,
    directions: npt.ArrayLike,
    *,
    engine: str = "fast",
    precision: float = 1e-12,
    threads: int = 0,
    progress: Progress = None,
) -> tuple[FloatArray, FloatArray]:
    """Values and surface gradients on the unit sphere.

    Parameters
    ----------
    coefficients, directions, engine, precision, threads, progress
        As in `evaluate`.

    Returns
    -------
    values : float64, (...)
    gradients : float64, (..., 3)
        Tangential at each direction.
    """
    rows, shape = unit_rows(directions)
    with caller(threads, progress) as how:
        values, gradients = _core.evaluate_with_gradient(core_of(coefficients), rows, engine, precision, how)
    return values.reshape(shape), gradients.reshape(*shape, 3)


def adjoint(
    directions: npt.ArrayLike,
    weights: npt.ArrayLike | None = None,
    *,
    degree: int,
    gradients: npt.ArrayLike | None = None,
    hessians: npt.ArrayLike | None = None,
    normalization: str = "orthonormal",
    csphase: int = 1,
    engine: str = "fast",
    precision: float = 1e-12,
    threads: int = 0,
    progress: Progress = None,
) -> FloatArray:
    """C_lm = sum_j (w_j + g_j . grad + h_j : Hess) Y^c_lm(u_j), S_lm likewise: the transpose of `evaluate`.

    Parameters
    ----------
    directions : array_like, (N, 3)
        u_j, of any length.
    weights : array_like, (N,), optional
        w_j.
    degree : int
        L of the sums.
    gradients : array_like, (N, 3), optional
        g_j, contracted with the gradient of Y(x/|x|) in space.
    hessians : array_like, (N, 6), optional
        h_j, symmetric matrices xx, xy, xz, yy, yz, zz.
    normalization, csphase
        Of the harmonics that are summed. With "orthonormal" this is the transpose of the sums.
    engine, precision, threads, progress
        As in `evaluate`.

    Returns
    -------
    sums : float64, (2, L+1, L+1)
    """
    rows, _ = unit_rows(float_rows(directions, "directions"))
    six = None
    if hessians is not None:
        six = np.ascontiguousarray(hessians, dtype=np.float64)
        if six.ndim != 2 or six.shape[1] != 6:
            raise InvalidInputError(f"hessians: an array (N, 6) is needed, not {six.shape}")
    with caller(threads, progress) as how:
        sums = _core.adjoint(
            degree,
            rows,
            None if weights is None else floats(weights, "weights"),
            None if gradients is None else float_rows(gradients, "gradients"),
            six,
            engine,
            precision,
            how,
        )
    # A sum with harmonics k times as large is k times as large; coefficients go the other way.
    unit = _core.Coefficients(degree)
    unit.values[:] = 1.0
    scale = array_of(unit, normalization, csphase)
    return np.array(sums.values) / np.where(scale == 0, 1.0, scale)


def gauss_legendre(n: int) -> tuple[FloatArray, FloatArray]:
    """Nodes, descending, and weights of the Gauss-Legendre rule on [-1, 1], (n,) each.

    Parameters
    ----------
    n : int
        At least 1: exact for polynomials of degree 2 n - 1.
    """
    return _core.gauss_legendre(n)


def exact_degree(kind: GridKind, n_theta: int, n_phi: int) -> int:
    """The highest degree to which functions on a grid are analysed exactly.

    Parameters
    ----------
    kind : {"gauss-legendre", "equiangular", "equiangular-with-poles"}
        Where the rings are.
    n_theta, n_phi : int
        Rings, and directions on each.
    """
    return _core.exact_degree(kind, n_theta, n_phi)


def smallest_grid(kind: GridKind, degree: int) -> tuple[int, int]:
    """(n_theta, n_phi) of the smallest grid with that exact degree.

    Parameters
    ----------
    kind : {"gauss-legendre", "equiangular", "equiangular-with-poles"}
        Where the rings are.
    degree : int
        Wanted.
    """
    return _core.smallest_grid(kind, degree)


def grid_colatitudes(kind: GridKind, n_theta: int) -> FloatArray:
    """Colatitudes of the rings, radians, (n_theta,).

    Parameters
    ----------
    kind : {"gauss-legendre", "equiangular", "equiangular-with-poles"}
        arccos of the Gauss-Legendre nodes; (i + 1/2) pi / n_theta; i pi / (n_theta - 1).
    n_theta : int
        How many.
    """
    return _core.grid_colatitudes(kind, n_theta)


def synthesize_grid(
    coefficients: CoefficientsLike,
    kind: GridKind = "gauss-legendre",
    n_theta: int | None = None,
    n_phi: int | None = None,
    *,
    threads: int = 0,
    progress: Progress = None,
) -> FloatArray:
    """Values on a grid, rings from north to south, longitudes 2 pi k / n_phi: (n_theta, n_phi).

    Parameters
    ----------
    coefficients : coefficients-like
        The function.
    kind : {"gauss-legendre", "equiangular", "equiangular-with-poles"}
        Where the rings are.
    n_theta, n_phi : int, optional
        By default the smallest grid that `analyze_grid` takes back exactly.
    threads, progress
        See `rholm.caller`.
    """
    core = core_of(coefficients)
    smallest = _core.smallest_grid(kind, core.degree)
    shape = (n_theta or smallest[0], n_phi or smallest[1])
    with caller(threads, progress) as how:
        return _core.synthesize_grid(core, kind, *shape, how).reshape(shape)


def analyze_grid(
    values: npt.ArrayLike,
    kind: GridKind = "gauss-legendre",
    degree: int | None = None,
    *,
    normalization: str = "4pi",
    csphase: int = 1,
    threads: int = 0,
    progress: Progress = None,
) -> FloatArray:
    """Coefficients of a function given on a grid, (2, L+1, L+1).

    Parameters
    ----------
    values : array_like, (n_theta, n_phi)
        Rings from north to south, longitudes 2 pi k / n_phi.
    kind : {"gauss-legendre", "equiangular", "equiangular-with-poles"}
        Where the rings are. pyshtools' "DH" grids are rings from the pole on without the last:
        `Expansion.to_pyshtools` and its own ``expand()`` know them.
    degree : int, optional
        By default the exact degree of the grid.
    normalization, csphase
        Of the result.
    threads, progress
        See `rholm.caller`.
    """
    array = np.asarray(values)
    if array.ndim != 2 or array.dtype.kind not in "fiu":
        raise InvalidInputError(
            f"values: a real array (n_theta, n_phi) is needed, not {array.shape} of {array.dtype}"
        )
    flat = np.ascontiguousarray(array, dtype=np.float64).ravel()
    n_theta, n_phi = array.shape
    if degree is None:
        degree = _core.exact_degree(kind, n_theta, n_phi)
    with caller(threads, progress) as how:
        core = _core.analyze_grid(flat, kind, n_theta, n_phi, degree, how)
    return array_of(core, normalization, csphase)


def evaluate_rings(
    coefficients: CoefficientsLike,
    colatitudes: npt.ArrayLike,
    n_phi: int,
    *,
    threads: int = 0,
    progress: Progress = None,
) -> FloatArray:
    """Values on rings of any colatitudes, longitudes 2 pi k / n_phi: (n_theta, n_phi).

    Parameters
    ----------
    coefficients : coefficients-like
        The function.
    colatitudes : array_like, (n_theta,)
        Radians.
    n_phi : int
        Directions on each.
    threads, progress
        See `rholm.caller`.
    """
    rings = floats(colatitudes, "colatitudes")
    with caller(threads, progress) as how:
        return _core.evaluate_rings(core_of(coefficients), rings, n_phi, how).reshape(len(rings), n_phi)


# Rotations

Rotation = _core.Rotation
#: What stands for a rotation: a `Rotation`, a matrix (3, 3), scipy's Rotation, or a quaternion
#: (w, x, y, z).
RotationLike = Union[_core.Rotation, npt.ArrayLike, Any]


def as_rotation(rotation: RotationLike) -> _core.Rotation:
    """A `Rotation` of whatever stands for one.

    Parameters
    ----------
    rotation : Rotation, array_like (3, 3) or (4,), scipy.spatial.transform.Rotation
        Four numbers are a quaternion (w, x, y, z).
    """
    if isinstance(rotation, _core.Rotation):
        return rotation
    if hasattr(rotation, "as_matrix"):
        rotation = rotation.as_matrix()
    array = np.asarray(rotation, dtype=np.float64)
    if array.shape == (4,):
        return _core.Rotation(*(float(v) for v in array))
    if array.shape == (3, 3):
        return _core.rotation_of_matrix(np.ascontiguousarray(array))
    raise InvalidInputError(f"rotation: a matrix (3, 3) or a quaternion (4,) is needed, not {array.shape}")


def rotation_about(axis: npt.ArrayLike, angle: float) -> _core.Rotation:
    """A turn about an axis.

    Parameters
    ----------
    axis : array_like, (3,)
        Of any length but 0.
    angle : float
        Radians, counter-clockwise seen from the tip of the axis.
    """
    from ._shapes import _triple

    return _core.rotation_about(_triple(axis, "axis"), angle)


def rotation_of(alpha: Any, beta: float | None = None, gamma: float | None = None) -> _core.Rotation:
    """The rotation of Euler angles Rz(alpha) Ry(beta) Rz(gamma), or of a matrix.

    Parameters
    ----------
    alpha : float, or array_like (3, 3)
        Radians, about z, last; or a matrix whose R R^T is 1 within 1e-4.
    beta, gamma : float, optional
        About y; about z, first. All about the fixed axes.
    """
    if beta is None and gamma is None:
        return as_rotation(alpha)
    if beta is None or gamma is None:
        raise TypeError("rotation_of() needs all three angles, or one matrix")
    return _core.rotation_of_euler(float(alpha), beta, gamma)


def axis_angle_of(rotation: RotationLike) -> tuple[FloatArray, float]:
    """Unit axis, (3,), and angle, 0 ... pi.

    Parameters
    ----------
    rotation : rotation-like
        For an angle of 0 the axis is z.
    """
    return _core.axis_angle_of(as_rotation(rotation))


def euler_angles_of(rotation: RotationLike) -> tuple[float, float, float]:
    """(alpha, beta, gamma) of Rz(alpha) Ry(beta) Rz(gamma), radians.

    Parameters
    ----------
    rotation : rotation-like
        For beta = 0 or pi alpha and gamma are given half of their sum or difference each.
    """
    return _core.euler_angles_of(as_rotation(rotation))


def matrix_of(rotation: RotationLike) -> FloatArray:
    """The orthogonal matrix R, (3, 3): the point x becomes R x.

    Parameters
    ----------
    rotation : rotation-like
        The rotation.
    """
    return _core.matrix_of(as_rotation(rotation))


def compose(second: RotationLike, first: RotationLike) -> _core.Rotation:
    """`second` after `first`.

    Parameters
    ----------
    second, first : rotation-like
        Two rotations.
    """
    return _core.compose(as_rotation(second), as_rotation(first))


def inverse(rotation: RotationLike) -> _core.Rotation:
    """Back again.

    Parameters
    ----------
    rotation : rotation-like
        The rotation.
    """
    return _core.inverse(as_rotation(rotation))


def angle_between(a: RotationLike, b: RotationLike) -> float:
    """The angle of the rotation that takes one to the other, 0 ... pi.

    Parameters
    ----------
    a, b : rotation-like
        Two rotations.
    """
    return _core.angle_between(as_rotation(a), as_rotation(b))


# Alignment


def principal_axes(coefficients: CoefficientsLike, function: str = "radius") -> _core.PrincipalAxes:
    """The axes of the quadratic form of degree 2: of a radius those of its ellipsoid-like part.

    Parameters
    ----------
    coefficients : coefficients-like
        The function.
    function : {"radius", "gauge", "other"}
        For a gauge, 1/r, the form's sign is turned.
    """
    return _core.principal_axes(core_of(coefficients), function)


def align_options(
    start: str,
    bandwidth: int,
    refine_degree: int,
    margin: float,
    allow_mirror: bool,
    unknown: Sequence[float],
) -> _core.AlignOptions:
    """As `rholm.align` takes them."""
    return _core.AlignOptions(
        start=start,
        bandwidth=bandwidth,
        refine_degree=refine_degree,
        margin=margin,
        allow_mirror=allow_mirror,
        unknown_a=unknown[0],
        unknown_b=unknown[1],
    )


# Files


class CoefficientsFile(NamedTuple):
    """What was read of a file of coefficients."""

    expansion: Expansion
    """The function, in the library's own convention."""
    format: str
    """"shtools", "icgem", "json", "npy"; "shtools" for a model file."""
    normalization: str
    """In which the numbers stood."""
    csphase: int
    """In which the numbers stood."""
    assumed: list[str]
    """What the file did not say."""
    product: str
    """What the file says it is of, if that is no shape."""
    passed_over: list[str]
    """What it says and what is not used."""


def _file_of(read: tuple[Any, ...]) -> CoefficientsFile:
    from ._expansion import Expansion

    expansion, *rest = read
    return CoefficientsFile(Expansion._of(expansion), *rest)


def read_coefficients(
    path: str | os.PathLike[str], *, normalization: str = "4pi", csphase: int = 1, override_file: bool = False
) -> CoefficientsFile:
    """Reads coefficients of text (SHTOOLS, ICGEM), JSON or NumPy files.

    Parameters
    ----------
    path : path
        The content decides the format.
    normalization, csphase
        Of files that say none.
    override_file : bool
        Of all files, whatever they say.
    """
    with caller(0, False) as how:
        return _file_of(_core.read_coefficients(os.fspath(path), normalization, csphase, override_file, how))


def read_any_coefficients(
    path: str | os.PathLike[str], *, normalization: str = "4pi", csphase: int = 1, override_file: bool = False
) -> CoefficientsFile:
    """Reads a model file, or what `read_coefficients` reads.

    Parameters
    ----------
    path, normalization, csphase, override_file
        As in `read_coefficients`.
    """
    with caller(0, False) as how:
        return _file_of(
            _core.read_any_coefficients(os.fspath(path), normalization, csphase, override_file, how)
        )


def parse_coefficients(
    data: bytes, name: str = "", *, normalization: str = "4pi", csphase: int = 1, override_file: bool = False
) -> CoefficientsFile:
    """The same for the bytes of a file.

    Parameters
    ----------
    data : bytes
        All of them.
    name : str
        Serves messages, and its extension where the content does not say what it is.
    normalization, csphase, override_file
        As in `read_coefficients`.
    """
    with caller(0, False) as how:
        return _file_of(
            _core.parse_coefficients(bytes(data), name, normalization, csphase, override_file, how)
        )


def looks_like_coefficients(data: bytes) -> bool:
    """Whether bytes begin like a file of coefficients (not for bare text).

    Parameters
    ----------
    data : bytes
        The beginning of a file.
    """
    return _core.looks_like_coefficients(bytes(data))


def coefficients_format_of(path: str | os.PathLike[str]) -> str | None:
    """The format of an extension: "shtools", "icgem", "json", "npy", or None.

    Parameters
    ----------
    path : path
        Need not exist.
    """
    return _core.coefficients_format_of(os.fspath(path))


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
