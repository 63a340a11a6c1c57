"""Rotations and conversions between their forms."""

from __future__ import annotations

from typing import Any, Protocol, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import form, public
from ._arrays import FloatArray, Rows, numeric, triple
from ._errors import InvalidInputError

Rotation = _core.Rotation


class HasMatrix(Protocol):
    """A rotation of SciPy."""

    def as_matrix(self) -> Any: ...


#: A rotation: a `Rotation`, a matrix (3, 3), scipy's Rotation, or a quaternion (w, x, y, z).
RotationLike = Union[_core.Rotation, Rows, HasMatrix]

form(RotationLike, "a rotation: a rholm.harmonics.Rotation, a matrix (3, 3), or a quaternion (w, x, y, z)")


@public
def as_rotation(rotation: RotationLike) -> _core.Rotation:
    """Converts any form of a rotation to a `Rotation`.

    Parameters
    ----------
    rotation : Rotation, array_like (3, 3) or (4,), scipy.spatial.transform.Rotation
        The rotation. Four numbers are a quaternion (w, x, y, z).

    Examples
    --------
    >>> rholm.harmonics.as_rotation(np.eye(3)) == rholm.harmonics.as_rotation((1, 0, 0, 0))
    True
    """
    if isinstance(rotation, _core.Rotation):
        return rotation
    if hasattr(rotation, "as_matrix"):
        rotation = rotation.as_matrix()
    array = numeric(rotation, "rotation").astype(np.float64)
    if array.shape == (4,):
        return _core.Rotation(*(float(v) for v in array))
    if array.shape == (3, 3):
        return _core.rotation_of_matrix(np.ascontiguousarray(array))
    raise InvalidInputError(f"rotation: a matrix (3, 3) or a quaternion (4,) is needed, not {array.shape}")


@public
def rotation_about(axis: npt.ArrayLike, angle: float) -> _core.Rotation:
    """Returns the rotation about an axis.

    Parameters
    ----------
    axis : array_like, (3,)
        Axis of any length but 0.
    angle : float
        Angle in radians, counter-clockwise seen from the tip of the axis.

    Examples
    --------
    >>> turn = rholm.rotation_about((0, 0, 1), np.pi / 2)
    >>> rholm.harmonics.matrix_of(turn).round(6) + 0.0
    array([[ 0., -1.,  0.],
           [ 1.,  0.,  0.],
           [ 0.,  0.,  1.]])
    """
    return _core.rotation_about(triple(axis, "axis"), angle)


@public
def rotation_of(alpha: Any, beta: float | None = None, gamma: float | None = None) -> _core.Rotation:
    """Returns the rotation for Euler angles Rz(alpha) Ry(beta) Rz(gamma), or for a matrix.

    Parameters
    ----------
    alpha : float, or array_like (3, 3)
        Angle about z, applied last, in radians. Alternatively a matrix with R R^T within 1e-4 of 1.
    beta, gamma : float, optional
        Angle about y, and angle about z, applied first. All axes are fixed.

    Examples
    --------
    >>> turn = rholm.harmonics.rotation_of(0.1, 0.2, 0.3)
    >>> [round(angle, 6) for angle in rholm.harmonics.euler_angles_of(turn)]
    [0.1, 0.2, 0.3]
    """
    if beta is None and gamma is None:
        return as_rotation(alpha)
    if beta is None or gamma is None:
        raise TypeError("rotation_of() needs all three angles, or one matrix")
    return _core.rotation_of_euler(float(alpha), beta, gamma)


@public
def axis_angle_of(rotation: RotationLike) -> tuple[FloatArray, float]:
    """Returns the unit axis, (3,), and the angle, 0 ... pi.

    Parameters
    ----------
    rotation : rotation-like
        The rotation. For an angle of 0 the axis is z.

    Examples
    --------
    >>> axis, angle = rholm.harmonics.axis_angle_of(rholm.rotation_about((0, 0, 2), 0.5))
    >>> axis.round(6) + 0.0, round(angle, 6)
    (array([0., 0., 1.]), 0.5)
    """
    return _core.axis_angle_of(as_rotation(rotation))


@public
def euler_angles_of(rotation: RotationLike) -> tuple[float, float, float]:
    """Returns (alpha, beta, gamma) of Rz(alpha) Ry(beta) Rz(gamma), in radians.

    Parameters
    ----------
    rotation : rotation-like
        The rotation. For beta = 0 or pi only the sum or difference of alpha and gamma matters: each
        is given half of it.

    Examples
    --------
    >>> turn = rholm.harmonics.rotation_of(0.1, 0.2, 0.3)
    >>> [round(angle, 6) for angle in rholm.harmonics.euler_angles_of(turn)]
    [0.1, 0.2, 0.3]
    """
    return _core.euler_angles_of(as_rotation(rotation))


@public
def matrix_of(rotation: RotationLike) -> FloatArray:
    """Returns the orthogonal matrix R, (3, 3), that takes the point x to R x.

    Parameters
    ----------
    rotation : rotation-like
        The rotation.

    Examples
    --------
    >>> rholm.harmonics.matrix_of((1, 0, 0, 0))
    array([[1., 0., 0.],
           [0., 1., 0.],
           [0., 0., 1.]])
    """
    return _core.matrix_of(as_rotation(rotation))


@public
def compose(second: RotationLike, first: RotationLike) -> _core.Rotation:
    """Returns the rotation that applies `first`, then `second`.

    Parameters
    ----------
    second, first : rotation-like
        Two rotations.

    Examples
    --------
    >>> turn = rholm.rotation_about((0, 0, 1), 0.2)
    >>> round(rholm.harmonics.axis_angle_of(rholm.harmonics.compose(turn, turn))[1], 6)
    0.4
    """
    return _core.compose(as_rotation(second), as_rotation(first))


@public
def inverse(rotation: RotationLike) -> _core.Rotation:
    """Returns the inverse rotation.

    Parameters
    ----------
    rotation : rotation-like
        The rotation.

    Examples
    --------
    >>> turn = rholm.rotation_about((0, 0, 1), 0.2)
    >>> back = rholm.harmonics.compose(rholm.harmonics.inverse(turn), turn)
    >>> round(rholm.harmonics.angle_between(back, np.eye(3)), 6)
    0.0
    """
    return _core.inverse(as_rotation(rotation))


@public
def angle_between(a: RotationLike, b: RotationLike) -> float:
    """Returns the angle of the rotation that takes one to the other, 0 ... pi.

    Parameters
    ----------
    a, b : rotation-like
        Two rotations.

    Examples
    --------
    >>> a, b = (rholm.rotation_about((0, 0, 1), angle) for angle in (0.2, 0.5))
    >>> round(rholm.harmonics.angle_between(a, b), 6)
    0.3
    """
    return _core.angle_between(as_rotation(a), as_rotation(b))
