"""What a mesh is, and what makes it better: edges, welding, repair, fewer triangles."""

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
    """What `weld` made."""

    mesh: Mesh
    """With the vertices that stay."""
    merged_vertices: int
    """Vertices that became one with another."""
    collapsed_triangles: int
    """Triangles of which two corners became one."""


def weld(mesh: MeshLike, tolerance: float = 0.0) -> Welded:
    """Makes vertices that coincide one.

    Parameters
    ----------
    mesh : mesh-like
        The mesh.
    tolerance : float
        0 joins identical vertices; else all whose distance is at most this, in the mesh's unit.
    """
    core, merged, collapsed = _core.weld(as_mesh(mesh)._core, tolerance)
    return Welded(Mesh._of(core), merged, collapsed)


def pair_edges(mesh: MeshLike) -> IndexArray:
    """All edges of a closed, consistently oriented mesh, each once.

    Parameters
    ----------
    mesh : mesh-like
        The mesh, welded.

    Returns
    -------
    edges : uint32, (E, 4)
        Vertices a and b, the triangle with a -> b, that with b -> a.
    """
    return _core.pair_edges(as_mesh(mesh)._core)


def bounds(points: npt.ArrayLike) -> _core.Bounds:
    """The box around points.

    Parameters
    ----------
    points : array_like, (N, 3)
        The points.
    """
    return _core.bounds(float_rows(points))


def inspect(mesh: MeshLike) -> _core.Inspection:
    """What a mesh is: closed, manifold, oriented, genus, area, volume, and what is wrong with it.

    Parameters
    ----------
    mesh : mesh-like
        Counts are those of the mesh given: `weld` first to close seams.
    """
    return as_mesh(mesh).inspect()


def closing_tolerance(mesh: MeshLike) -> float | None:
    """The tolerance at which welding joins the borders of an open mesh, or None.

    Parameters
    ----------
    mesh : mesh-like
        Welded exactly.
    """
    return _core.closing_tolerance(as_mesh(mesh)._core)


def largest_component(mesh: MeshLike) -> Mesh:
    """The part of the largest area.

    Parameters
    ----------
    mesh : mesh-like
        Parts are connected through edges: `weld` first to close seams.
    """
    return Mesh._of(_core.largest_component(as_mesh(mesh)._core))


def flip(mesh: MeshLike) -> Mesh:
    """The mesh with every triangle reversed; normals among the attributes change sign.

    Parameters
    ----------
    mesh : mesh-like
        Stays as it is.
    """
    return Mesh._of(_core.flip(as_mesh(mesh)._core))


def area_normals(mesh: MeshLike) -> FloatArray:
    """At each vertex the sum of its triangles' normals, each twice its area long, (N, 3).

    Parameters
    ----------
    mesh : mesh-like
        The mesh.
    """
    return _core.area_normals(as_mesh(mesh)._core)


def surface_area(mesh: MeshLike) -> float:
    """Sum of the areas of the triangles.

    Parameters
    ----------
    mesh : mesh-like
        The mesh.
    """
    return as_mesh(mesh).area


def enclosed_volume(mesh: MeshLike) -> float:
    """Signed volume of a closed mesh: positive if triangles are counter-clockwise from outside.

    Parameters
    ----------
    mesh : mesh-like
        Closed and oriented alike.
    """
    return as_mesh(mesh).volume


class Repaired(NamedTuple):
    """What `repair` made."""

    mesh: Mesh
    """Closed parts face outwards, cavities inwards."""
    report: _core.RepairReport
    """What was wrong, and what still is."""


@takes(_core.RepairOptions)
def repair(
    mesh: MeshLike, *, threads: int = 0, progress: Progress = None, **options: Unpack[RepairKeywords]
) -> Repaired:
    """Welds, drops duplicate and degenerate faces, separates sheets, orients, closes small holes.

    Parameters
    ----------
    mesh : mesh-like
        The mesh; its vertices keep their order and attributes, new ones come last.
    {options}
    threads, progress
        See `rholm.caller`.
    """
    wanted = options_of(_core.RepairOptions, {**options}, "repair")
    with caller(threads, progress) as how:
        core, report = _core.repair(as_mesh(mesh)._core, wanted, how)
    return Repaired(Mesh._of(core), report)


class Simplification(NamedTuple):
    """What `simplify` made."""

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
    """Fewer triangles for the same surface, by edges that shrink to one of their ends.

    Parameters
    ----------
    mesh : mesh-like
        The mesh. A surface stays what it is: closed, manifold, of the same genus.
    triangles : int, optional
        No more than these are left.
    share : float, optional
        No more than this share of the given triangles is left, 0 ... 1.
    max_error : float, optional
        No vertex would be farther than this from the planes it stands for, in the mesh's unit.
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
