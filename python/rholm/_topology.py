"""Inspection and improvement of meshes: edges, welding, repair, simplification."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy.typing as npt

from . import _core
from ._arguments import public
from ._arrays import FloatArray, IndexArray, float_rows
from ._convert import MeshLike, as_mesh
from ._errors import InvalidInputError
from ._options import options_of, takes
from ._run import Progress, caller, renamed
from ._shapes import Mesh

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._keywords import RepairKeywords


class Welded(NamedTuple):
    """Result of `weld`."""

    mesh: Mesh
    """With the vertices that stay."""
    merged_vertices: int
    """Vertices that became one with another."""
    collapsed_faces: int
    """Faces of which two corners became one."""

    @property
    def collapsed_triangles(self) -> int:
        """Old name of `collapsed_faces`."""
        renamed("Welded.collapsed_triangles", "Welded.collapsed_faces")
        return self.collapsed_faces


@public
def weld(mesh: MeshLike, tolerance: float = 0.0) -> Welded:
    """Merges vertices that coincide.

    Parameters
    ----------
    mesh : mesh-like
        The mesh.
    tolerance : float
        Largest distance of merged vertices, in the mesh's unit; 0 merges identical vertices.

    Examples
    --------
    >>> ball = rholm.icosphere(1)
    >>> corners = ball.vertices[ball.faces].reshape(-1, 3)
    >>> soup = rholm.Mesh(corners, np.arange(240).reshape(-1, 3))
    >>> rholm.meshes.weld(soup).mesh
    <rholm.Mesh: 42 vertices, 80 faces>
    """
    core, merged, collapsed = _core.weld(as_mesh(mesh)._core, tolerance)
    return Welded(Mesh._of(core), merged, collapsed)


@public
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

    Examples
    --------
    >>> rholm.meshes.pair_edges(rholm.icosphere(0)).shape
    (30, 4)
    """
    return _core.pair_edges(as_mesh(mesh)._core)


@public
def bounds(points: npt.ArrayLike) -> _core.Bounds:
    """Returns the bounding box of points.

    Parameters
    ----------
    points : array_like, (N, 3)
        The points.

    Examples
    --------
    >>> rholm.meshes.bounds([[0, 0, 0], [1, 2, 2]]).diagonal
    3.0
    """
    return _core.bounds(float_rows(points))


@public
def inspect(mesh: MeshLike) -> _core.Inspection:
    """Returns properties of a mesh: closed, manifold, oriented, genus, area, volume, and defects.

    Parameters
    ----------
    mesh : mesh-like
        The mesh. Counts are of the given mesh: use `weld` first to close seams.

    Examples
    --------
    >>> found = rholm.inspect(rholm.torus(2, 0.7, 40, 20))
    >>> found.closed, found.genus
    (True, 1)
    """
    return as_mesh(mesh).inspect()


@public
def closing_tolerance(mesh: MeshLike) -> float | None:
    """Returns the tolerance at which welding joins the borders of an open mesh, or None.

    Parameters
    ----------
    mesh : mesh-like
        The exactly welded mesh.

    Examples
    --------
    >>> rholm.meshes.closing_tolerance(rholm.icosphere(1)) is None
    True
    """
    return _core.closing_tolerance(as_mesh(mesh)._core)


@public
def largest_component(mesh: MeshLike) -> Mesh:
    """Returns the part of the largest area.

    Parameters
    ----------
    mesh : mesh-like
        The mesh. Parts are connected through edges: use `weld` first to close seams.

    Examples
    --------
    >>> body = rholm.box((1, 1, 1))
    >>> vertices = np.vstack([body.vertices, 3 * body.vertices])
    >>> two = rholm.Mesh(vertices, np.vstack([body.faces, body.faces + len(body.vertices)]))
    >>> rholm.meshes.largest_component(two).volume
    27.0
    """
    return Mesh._of(_core.largest_component(as_mesh(mesh)._core))


@public
def flip(mesh: MeshLike) -> Mesh:
    """Returns the mesh with every face reversed; normals among the attributes change sign.

    Parameters
    ----------
    mesh : mesh-like
        The mesh, which does not change.

    Examples
    --------
    >>> rholm.meshes.flip(rholm.box((1, 1, 1))).volume
    -1.0
    """
    return Mesh._of(_core.flip(as_mesh(mesh)._core))


@public
def area_normals(mesh: MeshLike) -> FloatArray:
    """Returns at each vertex the sum of its faces' normals, each as long as twice the face's area,
    (N, 3).

    Parameters
    ----------
    mesh : mesh-like
        The mesh.

    Examples
    --------
    >>> rholm.meshes.area_normals(rholm.icosphere(0)).shape
    (12, 3)
    """
    return _core.area_normals(as_mesh(mesh)._core)


@public
def surface_area(mesh: MeshLike) -> float:
    """Returns the sum of the areas of the faces.

    Parameters
    ----------
    mesh : mesh-like
        The mesh.

    Examples
    --------
    >>> rholm.meshes.surface_area(rholm.box((1, 1, 2)))
    10.0
    """
    return as_mesh(mesh).area


@public
def enclosed_volume(mesh: MeshLike) -> float:
    """Returns the signed volume of a closed mesh: positive if faces are counter-clockwise from
    outside.

    Parameters
    ----------
    mesh : mesh-like
        Closed, consistently oriented mesh.

    Examples
    --------
    >>> rholm.meshes.enclosed_volume(rholm.box((1, 1, 2)))
    2.0
    """
    return as_mesh(mesh).volume


class Repaired(NamedTuple):
    """Result of `repair`."""

    mesh: Mesh
    """Closed parts face outwards, cavities inwards."""
    report: _core.RepairReport
    """Report: defects that were found, and defects that remain."""


@public
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
        See ``help(rholm)``.

    Examples
    --------
    >>> ball = rholm.icosphere(2)
    >>> holed = rholm.Mesh(ball.vertices, ball.faces[1:])
    >>> rholm.repair(holed).mesh.inspect().closed
    True
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


@public
def simplify(
    mesh: MeshLike,
    *,
    faces: int | None = None,
    share: float | None = None,
    max_error: float | None = None,
    threads: int = 0,
    progress: Progress = None,
    triangles: int | None = None,
) -> Simplification:
    """Reduces the number of faces of a surface, by edges that collapse to one of their ends.

    Parameters
    ----------
    mesh : mesh-like
        The mesh. Its topology is kept: closed, manifold, genus.
    faces : int, optional
        Largest number of faces in the result.
    share : float, optional
        Largest share of the given faces in the result, 0 ... 1.
    max_error : float, optional
        Largest distance of a removed vertex's place in the result from the planes of its faces, in
        the mesh's unit.
    threads, progress
        See ``help(rholm)``.
    triangles : int, optional
        Old name of `faces`.

    References
    ----------
    M. Garland, P. Heckbert, Surface simplification using quadric error metrics, 1997.

    Examples
    --------
    >>> small = rholm.simplify(rholm.torus(2, 0.7, 40, 20), faces=400)
    >>> len(small.mesh.faces) <= 400, small.mesh.inspect().genus
    (True, 1)
    """
    if triangles is not None:
        renamed("simplify(triangles=)", "simplify(faces=)")
        faces = triangles
    if faces is not None and not 0 <= faces < 2**63:
        raise InvalidInputError(f"simplify(): faces is {faces}, which is out of range")
    options = _core.SimplifyOptions(faces=faces, share=share, max_error=max_error)
    with caller(threads, progress) as how:
        core, error = _core.simplify(as_mesh(mesh)._core, options, how)
    return Simplification(Mesh._of(core), error)
