"""Inspection and improvement of meshes: edges, welding, repair, simplification."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy.typing as npt

from . import _core
from ._arrays import FloatArray, IndexArray, float_rows
from ._options import options_of, takes
from ._run import Progress, caller
from ._shapes import Mesh, MeshLike, as_mesh

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._keywords import RepairKeywords


class Welded(NamedTuple):
    """Result of `weld`."""

    mesh: Mesh
    """With the vertices that stay."""
    merged_vertices: int
    """Vertices that became one with another."""
    collapsed_triangles: int
    """Triangles of which two corners became one."""


def weld(mesh: MeshLike, tolerance: float = 0.0) -> Welded:
    """Merges vertices that coincide.

    Parameters
    ----------
    mesh : mesh-like
        The mesh.
    tolerance : float
        Largest distance of merged vertices, in the mesh's unit; 0 merges identical vertices.
    """
    core, merged, collapsed = _core.weld(as_mesh(mesh)._core, tolerance)
    return Welded(Mesh._of(core), merged, collapsed)


def pair_edges(mesh: MeshLike) -> IndexArray:
    """Returns all edges of a closed, consistently oriented mesh, each once.

    Parameters
    ----------
    mesh : mesh-like
        The welded mesh.

    Returns
    -------
    edges : uint32, (E, 4)
        Vertices a and b, the face with a -> b, and the face with b -> a.
    """
    return _core.pair_edges(as_mesh(mesh)._core)


def bounds(points: npt.ArrayLike) -> _core.Bounds:
    """Returns the bounding box of points.

    Parameters
    ----------
    points : array_like, (N, 3)
        The points.
    """
    return _core.bounds(float_rows(points))


def inspect(mesh: MeshLike) -> _core.Inspection:
    """Returns properties of a mesh: closed, manifold, oriented, genus, area, volume, and defects.

    Parameters
    ----------
    mesh : mesh-like
        The mesh. Counts are of the given mesh: use `weld` first to close seams.
    """
    return as_mesh(mesh).inspect()


def closing_tolerance(mesh: MeshLike) -> float | None:
    """Returns the tolerance at which welding joins the borders of an open mesh, or None.

    Parameters
    ----------
    mesh : mesh-like
        The exactly welded mesh.
    """
    return _core.closing_tolerance(as_mesh(mesh)._core)


def largest_component(mesh: MeshLike) -> Mesh:
    """Returns the part of the largest area.

    Parameters
    ----------
    mesh : mesh-like
        The mesh. Parts are connected through edges: use `weld` first to close seams.
    """
    return Mesh._of(_core.largest_component(as_mesh(mesh)._core))


def flip(mesh: MeshLike) -> Mesh:
    """Returns the mesh with every face reversed; normals among the attributes change sign.

    Parameters
    ----------
    mesh : mesh-like
        The mesh, which does not change.
    """
    return Mesh._of(_core.flip(as_mesh(mesh)._core))


def area_normals(mesh: MeshLike) -> FloatArray:
    """Returns at each vertex the sum of its faces' normals, each as long as twice the face's area,
    (N, 3).

    Parameters
    ----------
    mesh : mesh-like
        The mesh.
    """
    return _core.area_normals(as_mesh(mesh)._core)


def surface_area(mesh: MeshLike) -> float:
    """Returns the sum of the areas of the faces.

    Parameters
    ----------
    mesh : mesh-like
        The mesh.
    """
    return as_mesh(mesh).area


def enclosed_volume(mesh: MeshLike) -> float:
    """Returns the signed volume of a closed mesh: positive if faces are counter-clockwise from
    outside.

    Parameters
    ----------
    mesh : mesh-like
        Closed, consistently oriented mesh.
    """
    return as_mesh(mesh).volume


class Repaired(NamedTuple):
    """Result of `repair`."""

    mesh: Mesh
    """Closed parts face outwards, cavities inwards."""
    report: _core.RepairReport
    """What was wrong, and what still is."""


@takes(_core.RepairOptions)
def repair(
    mesh: MeshLike, *, threads: int = 0, progress: Progress = None, **options: Unpack[RepairKeywords]
) -> Repaired:
    """Welds, drops duplicate and degenerate faces, separates sheets, orients, and closes small
    holes.

    Parameters
    ----------
    mesh : mesh-like
        The mesh. Its vertices keep their order and attributes; new ones come last.
    {options}
    threads, progress
        See `rholm.caller`.
    """
    wanted = options_of(_core.RepairOptions, {**options}, "repair")
    with caller(threads, progress) as how:
        core, report = _core.repair(as_mesh(mesh)._core, wanted, how)
    return Repaired(Mesh._of(core), report)


class Simplification(NamedTuple):
    """Result of `simplify`."""

    mesh: Mesh
    """Its vertices are some of the given ones, with their attributes, in their order."""
    error: float
    """The largest that was allowed, as max_error counts it."""


def simplify(
    mesh: MeshLike,
    *,
    triangles: int | None = None,
    share: float | None = None,
    max_error: float | None = None,
    threads: int = 0,
    progress: Progress = None,
) -> Simplification:
    """Reduces the number of faces of a surface, by edges that collapse to one of their ends.

    Parameters
    ----------
    mesh : mesh-like
        The mesh. Its topology is kept: closed, manifold, genus.
    triangles : int, optional
        Largest number of faces in the result.
    share : float, optional
        Largest share of the given faces in the result, 0 ... 1.
    max_error : float, optional
        Largest distance of a removed vertex's place in the result from the planes of its faces, in
        the mesh's unit.
    threads, progress
        See `rholm.caller`.

    References
    ----------
    M. Garland, P. Heckbert, Surface simplification using quadric error metrics, 1997.
    """
    options = _core.SimplifyOptions(triangles=triangles, share=share, max_error=max_error)
    with caller(threads, progress) as how:
        core, error = _core.simplify(as_mesh(mesh)._core, options, how)
    return Simplification(Mesh._of(core), error)
