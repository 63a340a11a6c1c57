"""Test shapes with known properties."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import public
from ._arrays import triple
from ._convert import MeshLike, as_mesh
from ._errors import InvalidInputError
from ._shapes import Mesh


@public
def icosphere(subdivisions: int) -> Mesh:
    """Returns the unit icosahedron with each edge halved `subdivisions` times, on the unit sphere.

    Parameters
    ----------
    subdivisions : int
        Number of subdivisions, 0 ... 12, for 20 * 4^n faces.

    Examples
    --------
    >>> len(rholm.icosphere(2).faces)
    320
    """
    return Mesh._of(_core.icosphere(subdivisions))


@public
def latitude_longitude_sphere(n_theta: int, n_phi: int) -> Mesh:
    """Returns a unit sphere of rings, with one vertex at each pole.

    Parameters
    ----------
    n_theta : int
        Number of rings, at colatitudes pi (i + 1/2) / n_theta.
    n_phi : int
        Number of vertices on each ring, at least 3.

    Examples
    --------
    >>> len(rholm.meshes.latitude_longitude_sphere(4, 6).vertices)
    26
    """
    return Mesh._of(_core.latitude_longitude_sphere(n_theta, n_phi))


@public
def ellipsoid(semi_axes: npt.ArrayLike, subdivisions: int) -> Mesh:
    """Returns an ellipsoid: an icosphere with stretched axes.

    Parameters
    ----------
    semi_axes : array_like, (3,)
        Semi-axes along x, y and z.
    subdivisions : int
        Subdivisions of the icosphere.

    Examples
    --------
    >>> rholm.ellipsoid((3, 2, 1), 3).bounds.max
    array([3., 2., 1.])
    """
    return Mesh._of(_core.ellipsoid(triple(semi_axes, "semi_axes"), subdivisions))


@public
def box(size: npt.ArrayLike, n: int = 1) -> Mesh:
    """Returns a box centred at the origin.

    Parameters
    ----------
    size : array_like, (3,)
        Lengths of its edges.
    n : int
        Divisions of an edge: each side is a grid of n x n squares of two faces.

    Examples
    --------
    >>> rholm.box((1, 2, 3)).volume
    6.0
    """
    return Mesh._of(_core.box(triple(size, "size"), n))


@public
def torus(ring_radius: float, tube_radius: float, n_ring: int, n_tube: int) -> Mesh:
    """Returns a torus about the z axis.

    Parameters
    ----------
    ring_radius, tube_radius : float
        Radius of the centre line, and of the tube around it.
    n_ring, n_tube : int
        Numbers of vertices along each.

    Examples
    --------
    >>> rholm.torus(2, 0.7, 40, 20).inspect().genus
    1
    """
    return Mesh._of(_core.torus(ring_radius, tube_radius, n_ring, n_tube))


@public
def bumpy_sphere(subdivisions: int, amplitude: float = 0.2, seed: int = 1) -> Mesh:
    """Returns a star-shaped test body: 1 + amplitude times a smooth sum of waves, on an icosphere.

    Parameters
    ----------
    subdivisions : int
        Subdivisions of the icosphere.
    amplitude : float
        Amplitude of the waves, 0 ... 1.
    seed : int
        Seed that chooses the waves.

    Examples
    --------
    >>> rholm.bumpy_sphere(3, amplitude=0.3, seed=7)
    <rholm.Mesh: 642 vertices, 1280 faces>
    """
    return Mesh._of(_core.bumpy_sphere(subdivisions, amplitude, seed))


def directions_for(
    degree: int,
    subdivisions: int | None,
    grid: tuple[int, int] | None,
    like: MeshLike | None,
    center: npt.NDArray[np.float64],
) -> _core.Mesh:
    """Returns the directions for a surface of a degree, from at most one of the three arguments."""
    if (subdivisions is not None) + (grid is not None) + (like is not None) > 1:
        raise InvalidInputError("subdivisions, grid and like exclude one another: give one of them")
    if grid is not None:
        return _core.latitude_longitude_sphere(*grid)
    if like is not None:
        return _core.directions_of(as_mesh(like)._core, triple(center, "center"))
    return _core.icosphere(subdivisions_for(degree) if subdivisions is None else subdivisions)


def subdivisions_for(degree: int) -> int:
    """Returns the subdivisions of an icosphere with two vertices per coefficient, 4 ... 7, as in
    the program.
    """
    n = 4
    while n < 7 and 10 * 4**n + 2 < 2 * (degree + 1) ** 2:
        n += 1
    return n
