"""Surfaces of models, their measures, and distances between surfaces."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

import numpy.typing as npt

from . import _core
from ._arguments import public
from ._arrays import FloatArray, float_rows, triple
from ._atlas import Atlas
from ._convert import MeshLike, as_mesh, as_shape
from ._expand import as_expansion
from ._expansion import Expansion
from ._model_files import load
from ._options import options_of, takes
from ._run import Progress, caller
from ._shapes import Mesh

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._keywords import CompareKeywords


@public
def distances_to_surface(
    points: npt.ArrayLike, mesh: MeshLike, *, threads: int = 0, progress: Progress = None
) -> FloatArray:
    """Returns the distance from each point to its exact closest point on a surface, (N,).

    Parameters
    ----------
    points : array_like, (N, 3)
        The points.
    mesh : mesh-like
        The surface.
    threads, progress
        See ``help(rholm)``.

    Examples
    --------
    >>> rholm.meshes.distances_to_surface([[0, 0, 2]], rholm.box((2, 2, 2)))
    array([1.])
    """
    with caller(threads, progress) as how:
        return _core.distances_to_surface(float_rows(points), as_mesh(mesh)._core, how)


@public
def measure(expansion: Expansion, *, threads: int = 0) -> _core.SurfaceMeasures:
    """Returns volume, area and centroid of the solid bounded by a surface.

    Parameters
    ----------
    expansion : Expansion
        Expansion of a surface.
    threads : int
        Number of threads; see ``help(rholm)``.

    Examples
    --------
    >>> s = rholm.expand(rholm.icosphere(4), degree=4)
    >>> round(rholm.harmonics.measure(s).area / (4 * np.pi), 1)
    1.0
    """
    return as_expansion(expansion).measure(threads=threads)


@public
def inertia(expansion: Expansion, *, threads: int = 0) -> FloatArray:
    """Returns the tensor of inertia of the solid of density 1 about its centroid.

    Parameters
    ----------
    expansion : Expansion
        Expansion of a surface.
    threads : int
        Number of threads; see ``help(rholm)``.

    Returns
    -------
    tensor : float64, (3, 3)
        Integral of ``|x|^2 1 - x x^T`` over the solid, with x from the centroid, in the fifth power
        of the unit; exact for a radius. ``numpy.linalg.eigh`` returns the moments, ascending, and
        the axes as columns, the longest first.

    Raises
    ------
    UnsupportedError
        For coefficients that do not represent a surface.
    InvalidInputError
        For a series without volume.

    Examples
    --------
    >>> s = rholm.expand(rholm.icosphere(4), degree=4)
    >>> (rholm.harmonics.inertia(s) / (8 / 15 * np.pi)).round(1) + 0.0
    array([[1., 0., 0.],
           [0., 1., 0.],
           [0., 0., 1.]])
    """
    return as_expansion(expansion).inertia(threads=threads)


@public
def directions_of(mesh: MeshLike, center: npt.ArrayLike) -> Mesh:
    """Returns the directions of a mesh's vertices from a centre, with its connectivity.

    Parameters
    ----------
    mesh : mesh-like
        The mesh. No vertex may lie on the centre.
    center : array_like, (3,)
        The centre.

    Examples
    --------
    >>> around = rholm.harmonics.directions_of(rholm.box((1, 2, 3)), (0, 0, 0))
    >>> bool(np.allclose(np.linalg.norm(around.vertices, axis=1), 1))
    True
    """
    return Mesh._of(_core.directions_of(as_mesh(mesh)._core, triple(center, "center")))


def surface_of(shape: Any, threads: int = 0, progress: Progress = None, points: bool = False) -> Any:
    """Returns the surface of a mesh, an expansion or an atlas, and also points if `points` is True."""
    if isinstance(shape, (str, os.PathLike)) and _core.is_model_file(os.fspath(shape)):
        shape = load(shape)
    if isinstance(shape, (Expansion, Atlas)):
        return shape.mesh(threads=threads, progress=progress)
    return as_shape(shape) if points else as_mesh(shape)


@public
@takes(_core.CompareOptions)
def compare(
    a: MeshLike | Expansion | Atlas,
    b: MeshLike | Expansion | Atlas,
    *,
    threads: int = 0,
    progress: Progress = None,
    **options: Unpack[CompareKeywords],
) -> _core.Comparison:
    """Computes the two-sided distance between surfaces, by exact closest points of random samples.

    Parameters
    ----------
    a, b : mesh-like, Expansion, Atlas or Reconstruction
        Two surfaces.
    {options}
    threads, progress
        See ``help(rholm)``.

    Examples
    --------
    >>> ball = rholm.icosphere(4)
    >>> larger = rholm.Mesh(1.1 * ball.vertices, ball.faces)
    >>> round(rholm.compare(ball, larger, samples=1000).hausdorff, 2)
    0.1
    """
    wanted = options_of(_core.CompareOptions, {**options}, "compare")
    first, second = (surface_of(s, threads, progress) for s in (a, b))
    with caller(threads, progress) as how:
        return _core.compare(first._core, second._core, wanted, how)


@public
def synthesize(model: Any, **options: Any) -> Mesh:
    """Returns the surface of an expansion or an atlas.

    Parameters
    ----------
    model : Expansion or Atlas
        The model.
    **options
        Arguments of `Expansion.mesh` or `Atlas.mesh`.

    Examples
    --------
    >>> s = rholm.expand(rholm.icosphere(3), degree=4)
    >>> rholm.harmonics.synthesize(s, subdivisions=2)
    <rholm.Mesh: 162 vertices, 320 faces, attributes nx, ny, nz>
    """
    if isinstance(model, Atlas):
        return model.mesh(**options)
    return as_expansion(model).mesh(**options)


@public
def require_star_shaped(expansion: Expansion, what: str) -> None:
    """Raises UnsupportedError for a signed sum, whose graph is not the surface of the body.

    Parameters
    ----------
    expansion : Expansion
        The expansion to check.
    what : str
        Name of the requested quantity in the message: "the volume".

    Raises
    ------
    UnsupportedError
        If `Expansion.signed_sum` is true.

    Examples
    --------
    >>> rholm.harmonics.require_star_shaped(
    ...     rholm.expand(rholm.icosphere(3), degree=4), "the volume"
    ... )
    """
    _core.require_star_shaped(as_expansion(expansion)._core, what)


@public
def require_surface(expansion: Expansion) -> None:
    """Raises UnsupportedError if the coefficients are declared to be something other than a
    surface.

    The function checks `Expansion.function`, which is "other" for a gravity field. It does not
    check numbers: the radius may be negative somewhere, and the volume may be missing.

    Parameters
    ----------
    expansion : Expansion
        The expansion to check.

    Raises
    ------
    UnsupportedError
        If its function is "other".

    Examples
    --------
    >>> rholm.harmonics.require_surface(rholm.expand(rholm.icosphere(3), degree=4))
    """
    as_expansion(expansion)._require_surface()
