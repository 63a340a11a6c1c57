"""Sums of harmonics at scattered directions, on rings and on grids, and their transposes."""

from __future__ import annotations

from typing import Literal

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import public
from ._arrays import FloatArray, float_rows, floats, numeric
from ._arrays import directions as unit_rows
from ._coefficients import Normalization, array_of, core_of
from ._errors import InvalidInputError
from ._expansion import CoefficientsLike
from ._run import Progress, caller

#: Places of the rings of a grid; see `synthesize_grid`.
GridKind = Literal["gauss-legendre", "equiangular", "equiangular-with-poles"]


@public
def evaluate(
    coefficients: CoefficientsLike,
    directions: npt.ArrayLike,
    *,
    engine: Literal["fast", "direct"] = "fast",
    precision: float = 1e-12,
    threads: int = 0,
    progress: Progress = None,
) -> FloatArray:
    """Returns values f(u) of a function on the sphere.

    Parameters
    ----------
    coefficients : coefficients-like
        The function.
    directions : array_like, (..., 3)
        Directions, vectors of any length.
    engine : {"fast", "direct"}
        Kind of sums. The choice "fast" uses a grid, O(N + L^3), to a precision. The choice "direct"
        sums term by term, O(N L^2), exact to rounding.
    precision : float
        1e-14 ... 1e-1: l2 norm of all errors, relative to the l2 norm of sums with random signs.
    threads, progress
        See ``help(rholm)``.

    Returns
    -------
    values : float64, (...)

    Examples
    --------
    >>> c = np.zeros((2, 2, 2))
    >>> c[0, 1, 0] = 1
    >>> rholm.harmonics.evaluate(c, [[0, 0, 1], [1, 0, 0]]).round(6) + 0.0
    array([1.732051, 0.      ])
    """
    rows, shape = unit_rows(directions)
    with caller(threads, progress) as how:
        return _core.evaluate(core_of(coefficients), rows, engine, precision, how).reshape(shape)


@public
def evaluate_with_gradient(
    coefficients: CoefficientsLike,
    directions: npt.ArrayLike,
    *,
    engine: Literal["fast", "direct"] = "fast",
    precision: float = 1e-12,
    threads: int = 0,
    progress: Progress = None,
) -> tuple[FloatArray, FloatArray]:
    """Returns values and surface gradients on the unit sphere.

    Parameters
    ----------
    coefficients, directions, engine, precision, threads, progress
        As in `evaluate`.

    Returns
    -------
    values : float64, (...)
    gradients : float64, (..., 3)
        Tangential at each direction.

    Examples
    --------
    >>> c = np.zeros((2, 2, 2))
    >>> c[0, 1, 0] = 1
    >>> values, gradients = rholm.harmonics.evaluate_with_gradient(c, [[1, 0, 0]])
    >>> gradients.round(6) + 0.0
    array([[0.      , 0.      , 1.732051]])
    """
    rows, shape = unit_rows(directions)
    with caller(threads, progress) as how:
        values, gradients = _core.evaluate_with_gradient(core_of(coefficients), rows, engine, precision, how)
    return values.reshape(shape), gradients.reshape(*shape, 3)


@public
def adjoint(
    directions: npt.ArrayLike,
    weights: npt.ArrayLike | None = None,
    *,
    degree: int,
    gradients: npt.ArrayLike | None = None,
    hessians: npt.ArrayLike | None = None,
    normalization: Normalization = "orthonormal",
    csphase: int = 1,
    engine: Literal["fast", "direct"] = "fast",
    precision: float = 1e-12,
    threads: int = 0,
    progress: Progress = None,
) -> FloatArray:
    """Returns C_lm = sum_j (w_j + g_j . grad + h_j : Hess) Y^c_lm(u_j), and S_lm with Y^s_lm: the
    transpose of `evaluate`.

    Parameters
    ----------
    directions : array_like, (N, 3)
        Directions u_j, of any length.
    weights : array_like, (N,), optional
        Weights w_j.
    degree : int
        Highest degree L of the sums.
    gradients : array_like, (N, 3), optional
        Vectors g_j, contracted with the gradient of ``Y(x/|x|)`` in space.
    hessians : array_like, (N, 6), optional
        Symmetric matrices h_j as xx, xy, xz, yy, yz, zz.
    normalization, csphase
        Convention of the harmonics in the sums. With "orthonormal" the result is the transpose of
        `evaluate`.
    engine, precision, threads, progress
        As in `evaluate`.

    Returns
    -------
    sums : float64, (2, L+1, L+1)

    Examples
    --------
    >>> sums = rholm.harmonics.adjoint([[0, 0, 1]], [1.0], degree=1, engine="direct")
    >>> bool(np.isclose(sums[0, 0, 0], np.sqrt(1 / (4 * np.pi))))
    True
    """
    rows, _ = unit_rows(float_rows(directions, "directions"))
    six = None
    if hessians is not None:
        six = np.ascontiguousarray(numeric(hessians, "hessians"), dtype=np.float64)
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
    # Harmonics k times as large give sums k times as large. Coefficients scale inversely.
    unit = _core.Coefficients(degree)
    unit.values[:] = 1.0
    scale = array_of(unit, normalization, csphase)
    return np.array(sums.values) / np.where(scale == 0, 1.0, scale)


@public
def gauss_legendre(n: int) -> tuple[FloatArray, FloatArray]:
    """Returns nodes, descending, and weights of the Gauss-Legendre rule on [-1, 1], (n,) each.

    Parameters
    ----------
    n : int
        Number of nodes, at least 1. The rule is exact for polynomials of degree 2 n - 1.

    Examples
    --------
    >>> nodes, weights = rholm.harmonics.gauss_legendre(2)
    >>> nodes.round(6), weights.round(6)
    (array([ 0.57735, -0.57735]), array([1., 1.]))
    """
    return _core.gauss_legendre(n)


@public
def exact_degree(kind: GridKind, n_theta: int, n_phi: int) -> int:
    """Returns the highest degree to which functions on a grid are analysed exactly.

    Parameters
    ----------
    kind : {"gauss-legendre", "equiangular", "equiangular-with-poles"}
        Places of the rings.
    n_theta, n_phi : int
        Numbers of rings, and of directions on each.

    Examples
    --------
    >>> rholm.harmonics.exact_degree("gauss-legendre", 5, 9)
    4
    """
    return _core.exact_degree(kind, n_theta, n_phi)


@public
def smallest_grid(kind: GridKind, degree: int) -> tuple[int, int]:
    """Returns (n_theta, n_phi) of the smallest grid with that exact degree.

    Parameters
    ----------
    kind : {"gauss-legendre", "equiangular", "equiangular-with-poles"}
        Places of the rings.
    degree : int
        Wanted exact degree.

    Examples
    --------
    >>> rholm.harmonics.smallest_grid("gauss-legendre", 4)
    (5, 10)
    """
    return _core.smallest_grid(kind, degree)


@public
def grid_colatitudes(kind: GridKind, n_theta: int) -> FloatArray:
    """Returns the colatitudes of the rings, in radians, (n_theta,).

    Parameters
    ----------
    kind : {"gauss-legendre", "equiangular", "equiangular-with-poles"}
        The colatitudes are, in this order: arccos of the Gauss-Legendre nodes; (i + 1/2) pi /
        n_theta; i pi / (n_theta - 1).
    n_theta : int
        Number of rings.

    Examples
    --------
    >>> np.degrees(rholm.harmonics.grid_colatitudes("equiangular", 3)).round(6)
    array([ 30.,  90., 150.])
    """
    return _core.grid_colatitudes(kind, n_theta)


@public
def synthesize_grid(
    coefficients: CoefficientsLike,
    kind: GridKind = "gauss-legendre",
    n_theta: int | None = None,
    n_phi: int | None = None,
    *,
    threads: int = 0,
    progress: Progress = None,
) -> FloatArray:
    """Returns values on a grid, rings from north to south, longitudes 2 pi k / n_phi: (n_theta,
    n_phi).

    Parameters
    ----------
    coefficients : coefficients-like
        The function.
    kind : {"gauss-legendre", "equiangular", "equiangular-with-poles"}
        Places of the rings.
    n_theta, n_phi : int, optional
        Numbers of rings and longitudes. By default the smallest grid that `analyze_grid` inverts
        exactly.
    threads, progress
        See ``help(rholm)``.

    Examples
    --------
    >>> s = rholm.expand(rholm.bumpy_sphere(3), degree=4)
    >>> rholm.harmonics.synthesize_grid(s).shape
    (5, 10)
    """
    core = core_of(coefficients)
    smallest = _core.smallest_grid(kind, core.degree)
    shape = (n_theta or smallest[0], n_phi or smallest[1])
    with caller(threads, progress) as how:
        return _core.synthesize_grid(core, kind, *shape, how).reshape(shape)


@public
def analyze_grid(
    values: npt.ArrayLike,
    kind: GridKind = "gauss-legendre",
    degree: int | None = None,
    *,
    normalization: Normalization = "4pi",
    csphase: int = 1,
    threads: int = 0,
    progress: Progress = None,
) -> FloatArray:
    """Returns the coefficients of a function given on a grid, (2, L+1, L+1).

    Parameters
    ----------
    values : array_like, (n_theta, n_phi)
        Values on rings from north to south, longitudes 2 pi k / n_phi.
    kind : {"gauss-legendre", "equiangular", "equiangular-with-poles"}
        Places of the rings. pyshtools' "DH" grids have rings from the pole on, without the last
        one. Use pyshtools for them: `Expansion.to_pyshtools` and ``expand()``.
    degree : int, optional
        Highest degree; by default the exact degree of the grid.
    normalization, csphase
        Convention of the result.
    threads, progress
        See ``help(rholm)``.

    Examples
    --------
    >>> s = rholm.expand(rholm.bumpy_sphere(3), degree=4)
    >>> grid = rholm.harmonics.synthesize_grid(s)
    >>> bool(np.allclose(rholm.harmonics.analyze_grid(grid, degree=4), s.coeffs))
    True
    """
    array = numeric(values, "values")
    if array.ndim != 2:
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


@public
def evaluate_rings(
    coefficients: CoefficientsLike,
    colatitudes: npt.ArrayLike,
    n_phi: int,
    *,
    threads: int = 0,
    progress: Progress = None,
) -> FloatArray:
    """Returns values on rings of any colatitudes, longitudes 2 pi k / n_phi: (n_theta, n_phi).

    Parameters
    ----------
    coefficients : coefficients-like
        The function.
    colatitudes : array_like, (n_theta,)
        Colatitudes in radians.
    n_phi : int
        Number of directions on each ring.
    threads, progress
        See ``help(rholm)``.

    Examples
    --------
    >>> s = rholm.expand(rholm.bumpy_sphere(3), degree=4)
    >>> rholm.harmonics.evaluate_rings(s, [0.5, 1.0], n_phi=8).shape
    (2, 8)
    """
    rings = floats(colatitudes, "colatitudes")
    with caller(threads, progress) as how:
        return _core.evaluate_rings(core_of(coefficients), rings, n_phi, how).reshape(len(rings), n_phi)
