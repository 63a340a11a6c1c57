"""Sums of harmonics at scattered directions, on rings and grids, and back."""

from __future__ import annotations

from typing import Literal

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import FloatArray, float_rows, floats, numeric
from ._arrays import directions as unit_rows
from ._coefficients import Normalization, array_of, core_of
from ._errors import InvalidInputError
from ._expansion import CoefficientsLike
from ._run import Progress, caller

#: Where the rings of a grid are; see `synthesize_grid`.
GridKind = Literal["gauss-legendre", "equiangular", "equiangular-with-poles"]


def evaluate(
    coefficients: CoefficientsLike,
    directions: npt.ArrayLike,
    *,
    engine: Literal["fast", "direct"] = "fast",
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
    engine: Literal["fast", "direct"] = "fast",
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
    normalization: Normalization = "orthonormal",
    csphase: int = 1,
    engine: Literal["fast", "direct"] = "fast",
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
        g_j, contracted with the gradient of ``Y(x/|x|)`` in space.
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
    normalization: Normalization = "4pi",
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
