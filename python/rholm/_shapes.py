"""Meshes and points: what they are, where they come from, what they become."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import (
    FloatArray,
    IndexArray,
    attribute_dict,
    attribute_tuples,
    float_row,
    float_rows,
    triangle_rows,
)
from ._errors import InvalidInputError
from ._run import Progress, caller

if TYPE_CHECKING:
    import meshio
    import pyvista
    import trimesh

#: What stands for a mesh: a `Mesh`, (vertices, triangles), a path, or a mesh of trimesh, PyVista or
#: meshio.
MeshLike = Union["Mesh", tuple[Any, Any], str, "os.PathLike[str]", Any]
#: What stands for points: a `PointCloud`, an array (N, 3), (points, normals), a path, or points of
#: trimesh, PyVista or meshio.
PointsLike = Union["PointCloud", npt.ArrayLike, tuple[Any, Any], str, "os.PathLike[str]", Any]


class Mesh:
    """Triangles that share vertices.

    Parameters
    ----------
    vertices : array_like, (N, 3)
        In any unit. Copied to float64.
    triangles : array_like of integers, (M, 3)
        Vertex indices, counter-clockwise seen from outside. Copied to uint32.
    attributes : mapping of str to array_like, optional
        Of vertices, (N,) or (N, k) each: ``{"quality": q, "rgb": colors}``. Columns of "rgb" become
        red, green, blue as in PLY files; those of "normals" nx, ny, nz.

    Raises
    ------
    InvalidInputError
        For coordinates that are not finite, indices out of range, attributes of other lengths.

    Notes
    -----
    `vertices` and `triangles` are arrays over the library's own memory: nothing is copied when the
    mesh is given to a function.
    """

    __slots__ = ("_core",)

    def __init__(self, vertices: npt.ArrayLike, triangles: npt.ArrayLike, attributes: Any = None) -> None:
        rows = float_rows(vertices, "vertices")
        mesh = _core.Mesh(
            rows, np.ascontiguousarray(triangle_rows(triangles)), attribute_tuples(attributes, len(rows))
        )
        _core.validate(mesh)
        self._core = mesh

    @classmethod
    def _of(cls, mesh: _core.Mesh) -> Mesh:
        self = cls.__new__(cls)
        self._core = mesh
        return self

    @property
    def vertices(self) -> FloatArray:
        """Coordinates, (N, 3) float64; read-only, not copied."""
        return _read_only(self._core.vertices)

    @property
    def triangles(self) -> IndexArray:
        """Vertex indices, (M, 3) uint32; read-only, not copied."""
        return _read_only(self._core.triangles)

    @property
    def attributes(self) -> dict[str, npt.NDArray[Any]]:
        """Attributes of vertices by name, (N,) each; a copy."""
        return attribute_dict(self._core.attributes)

    @property
    def normals(self) -> FloatArray:
        """Unit normals of vertices, (N, 3): the attributes nx, ny, nz, or those of the triangles
        around each, weighted by area. Zero where a vertex has no triangle.
        """
        attributes = self.attributes
        if all(name in attributes for name in ("nx", "ny", "nz")):
            rows = np.stack([attributes[name] for name in ("nx", "ny", "nz")], axis=1)
            return rows.astype(np.float64)
        rows = _core.area_normals(self._core)
        length = np.linalg.norm(rows, axis=1, keepdims=True)
        unit: FloatArray = np.divide(rows, length, out=np.zeros_like(rows), where=length > 0)
        return unit

    @property
    def colors(self) -> npt.NDArray[np.float32] | None:
        """Colours of vertices, (N, 3) float32 in 0 ... 1, or None."""
        return vertex_colors(self)

    @property
    def bounds(self) -> _core.Bounds:
        """The box around the vertices."""
        return _core.bounds(self._core.vertices)

    @property
    def area(self) -> float:
        """Of all triangles, in the squared unit of the vertices."""
        return _core.surface_area(self._core)

    @property
    def volume(self) -> float:
        """Signed, in the cubed unit: of a closed mesh that is oriented alike."""
        return _core.enclosed_volume(self._core)

    def with_attributes(self, **attributes: npt.ArrayLike) -> Mesh:
        """The same mesh with these attributes beside its own, or in their place.

        Parameters
        ----------
        **attributes : array_like, (N,) or (N, k)
            As in the constructor.
        """
        return Mesh(self.vertices, self.triangles, {**self.attributes, **attributes})

    def inspect(self) -> _core.Inspection:
        """Counts and measures: closed, manifold, oriented, genus, area, volume."""
        return _core.inspect(self._core)

    def save(self, path: str | os.PathLike[str], format: str | None = None, ascii: bool = False) -> None:
        """Writes a file; see `write_shape`."""
        write_shape(self, path, format=format, ascii=ascii)

    def render(self, **options: Any) -> Any:
        """A picture; see `rholm.render`."""
        from ._pictures import render

        return render(self, **options)

    def to_trimesh(self) -> trimesh.Trimesh:
        """A `trimesh.Trimesh` with the vertices, triangles, normals and colours, as they are."""
        from ._interop import mesh_to_trimesh

        return mesh_to_trimesh(self)

    def to_pyvista(self) -> pyvista.PolyData:
        """A `pyvista.PolyData` with the attributes as point data."""
        from ._interop import mesh_to_pyvista

        return mesh_to_pyvista(self)

    def to_meshio(self) -> meshio.Mesh:
        """A `meshio.Mesh` with the attributes as point data."""
        from ._interop import mesh_to_meshio

        return mesh_to_meshio(self)

    def __repr__(self) -> str:
        names = sorted(self.attributes)
        with_ = f", attributes {', '.join(names)}" if names else ""
        return f"<rholm.Mesh: {len(self.vertices)} vertices, {len(self.triangles)} triangles{with_}>"

    def __reduce__(self) -> Any:
        return (_mesh_of, (np.array(self.vertices), np.array(self.triangles), self._core.attributes))

    def _repr_png_(self) -> bytes | None:
        from ._pictures import notebook_png

        return notebook_png(self)


def _mesh_of(vertices: FloatArray, triangles: IndexArray, attributes: Any) -> Mesh:
    return Mesh._of(_core.Mesh(vertices, triangles, attributes))


class PointCloud:
    """Points without faces.

    Parameters
    ----------
    points : array_like, (N, 3)
        In any unit. Copied to float64.
    normals : array_like, (N, 3), optional
        Of any length; they point out of the solid.
    attributes : mapping of str to array_like, optional
        Of points, as in `Mesh`.
    """

    __slots__ = ("_core",)

    def __init__(
        self, points: npt.ArrayLike, normals: npt.ArrayLike | None = None, attributes: Any = None
    ) -> None:
        rows = float_rows(points, "points")
        directions = None if normals is None else float_rows(normals, "normals")
        if directions is not None and len(directions) != len(rows):
            raise InvalidInputError(f"{len(directions)} normals for {len(rows)} points")
        self._core = _core.PointCloud(rows, directions, attribute_tuples(attributes, len(rows)))

    @classmethod
    def _of(cls, cloud: _core.PointCloud) -> PointCloud:
        self = cls.__new__(cls)
        self._core = cloud
        return self

    @property
    def points(self) -> FloatArray:
        """Coordinates, (N, 3) float64; read-only, not copied."""
        return _read_only(self._core.points)

    @property
    def normals(self) -> FloatArray | None:
        """Normals as they were given, (N, 3) float64, or None; read-only, not copied."""
        normals = self._core.normals
        return None if normals is None else _read_only(normals)

    @property
    def attributes(self) -> dict[str, npt.NDArray[Any]]:
        """Attributes of points by name, (N,) each; a copy."""
        return attribute_dict(self._core.attributes)

    @property
    def bounds(self) -> _core.Bounds:
        """The box around the points."""
        return _core.bounds(self._core.points)

    def save(self, path: str | os.PathLike[str], format: str | None = None, ascii: bool = False) -> None:
        """Writes a file; see `write_shape`."""
        write_shape(self, path, format=format, ascii=ascii)

    def to_trimesh(self) -> trimesh.PointCloud:
        """A `trimesh.PointCloud`."""
        from ._interop import cloud_to_trimesh

        return cloud_to_trimesh(self)

    def to_pyvista(self) -> pyvista.PolyData:
        """A `pyvista.PolyData` of vertices, with normals and attributes as point data."""
        from ._interop import cloud_to_pyvista

        return cloud_to_pyvista(self)

    def __len__(self) -> int:
        return len(self._core.points)

    def __repr__(self) -> str:
        normals = " with normals" if self.normals is not None else ""
        return f"<rholm.PointCloud: {len(self)} points{normals}>"

    def __reduce__(self) -> Any:
        normals = None if self.normals is None else np.array(self.normals)
        return (_cloud_of, (np.array(self.points), normals, self._core.attributes))


def _cloud_of(points: FloatArray, normals: FloatArray | None, attributes: Any) -> PointCloud:
    return PointCloud._of(_core.PointCloud(points, normals, attributes))


def _read_only(array: npt.NDArray[Any]) -> npt.NDArray[Any]:
    array.flags.writeable = False
    return array


def as_mesh(shape: MeshLike, attributes: bool = True) -> Mesh:
    """A `Mesh` of whatever stands for one.

    Parameters
    ----------
    shape : Mesh, (vertices, triangles), path, trimesh.Trimesh, pyvista.PolyData, meshio.Mesh
        Packages are recognised by their types; none is imported.
    attributes : bool
        Whether those of vertices are taken along.

    Raises
    ------
    InvalidInputError
        For a mesh that is not valid, a file of points.
    TypeError
        For what is none of these.
    """
    if isinstance(shape, Mesh):
        return shape
    if isinstance(shape, _core.Mesh):
        return Mesh._of(shape)
    if isinstance(shape, (str, os.PathLike)):
        read = read_shape(shape, attributes=attributes).shape
        if isinstance(read, Mesh):
            return read
        raise InvalidInputError(f"{os.fspath(shape)} holds points, not a mesh; reconstruct() makes one")
    from ._interop import foreign_mesh

    arrays = foreign_mesh(shape)
    if arrays is None:
        if isinstance(shape, (tuple, list)) and len(shape) == 2:
            return Mesh(*shape)
        raise TypeError(
            "a mesh is a rholm.Mesh, (vertices, triangles), a path, or one of trimesh, PyVista or "
            f"meshio, not {type(shape).__name__}"
        )
    vertices, triangles, values = arrays
    return Mesh(vertices, triangles, values if attributes else None)


def as_points(shape: PointsLike, normals: npt.ArrayLike | None = None, attributes: Any = None) -> PointCloud:
    """A `PointCloud` of whatever stands for one.

    Parameters
    ----------
    shape : PointCloud, array_like (N, 3), (points, normals), path, points of trimesh, PyVista, meshio
        A mesh is its vertices, with their normals.
    normals : array_like, (N, 3), optional
        In the place of the shape's own.
    attributes : mapping of str to array_like, optional
        In the place of the shape's own.
    """
    cloud = _points_of(shape)
    if normals is None and attributes is None:
        return cloud
    return PointCloud(
        cloud.points,
        cloud.normals if normals is None else normals,
        cloud.attributes if attributes is None else attributes,
    )


def _points_of(shape: Any) -> PointCloud:
    if isinstance(shape, PointCloud):
        return shape
    if isinstance(shape, (str, os.PathLike)):
        shape = read_shape(shape).shape
        if isinstance(shape, PointCloud):
            return shape
    if isinstance(shape, Mesh):
        return PointCloud(shape.vertices, shape.normals, shape.attributes)
    from ._interop import foreign_points

    arrays = foreign_points(shape)
    if arrays is not None:
        return PointCloud(*arrays)
    if isinstance(shape, tuple) and len(shape) == 2:
        return PointCloud(*shape)
    return PointCloud(shape)


def vertex_colors(mesh: MeshLike) -> npt.NDArray[np.float32] | None:
    """The attributes red, green and blue, (N, 3) float32 in 0 ... 1, or None.

    Parameters
    ----------
    mesh : mesh-like
        Whole numbers are bytes, others parts of 1.
    """
    colors = _core.vertex_colors(as_mesh(mesh)._core)
    return colors if len(colors) else None


class ShapeFile(NamedTuple):
    """What `read_shape` read."""

    shape: Mesh | PointCloud
    """A `Mesh` if the file has faces, else a `PointCloud`."""
    format: str
    """As its content showed: "ply", "obj", "off", "stl", "xyz"."""
    encoding: str
    """"ascii", "binary little endian" or "binary big endian"."""
    warnings: list[str]
    """What was passed over, with counts."""


def _wrapped(shape: Any) -> Mesh | PointCloud:
    return Mesh._of(shape) if isinstance(shape, _core.Mesh) else PointCloud._of(shape)


def read_shape(
    path: str | os.PathLike[str], *, attributes: bool = True, progress: Progress = None
) -> ShapeFile:
    """Reads a mesh or points: PLY, OBJ, OFF, STL, XYZ, PWN, TXT.

    Parameters
    ----------
    path : path
        The content decides what the file is, the name only where the content does not. Polygons
        are cut into triangles.
    attributes : bool
        Whether attributes of vertices or points are read.
    progress
        See `rholm.caller`.

    Raises
    ------
    IoError
        If the file cannot be read.
    InvalidInputError
        If it is malformed (with the line or the byte), truncated or empty.
    UnsupportedError
        If its format is not known.
    """
    with caller(0, progress) as how:
        shape, *rest = _core.read_shape(os.fspath(path), attributes, how)
    return ShapeFile(_wrapped(shape), *rest)


def parse_shape(data: bytes, name: str = "", *, attributes: bool = True) -> ShapeFile:
    """The same for the bytes of a file.

    Parameters
    ----------
    data : bytes
        All of them.
    name : str
        Serves messages, and its extension where the content does not say what it is.
    attributes : bool
        Whether attributes are read.
    """
    with caller(0, False) as how:
        shape, *rest = _core.parse_shape(bytes(data), name, attributes, how)
    return ShapeFile(_wrapped(shape), *rest)


def write_shape(
    shape: MeshLike | PointCloud,
    path: str | os.PathLike[str],
    *,
    format: str | None = None,
    ascii: bool = False,
) -> None:
    """Writes a mesh or points to a temporary file that replaces `path` when complete.

    Parameters
    ----------
    shape : mesh-like or PointCloud
        What is written; attributes as far as the format has room for them.
    path : path
        Its extension says the format, if `format` does not.
    format : {"ply", "obj", "off", "stl", "xyz"}, optional
        The format.
    ascii : bool
        PLY and STL as text instead of binary.

    Raises
    ------
    IoError
        If it cannot be written.
    UnsupportedError
        For a format that cannot hold it.
    """
    core = shape._core if isinstance(shape, PointCloud) else as_mesh(shape)._core
    with caller(0, False) as how:
        _core.write_shape(core, os.fspath(path), format, ascii, how)


def attributes_left_out(shape: Mesh | PointCloud, format: str) -> list[str]:
    """Names of the attributes that a format has no room for.

    Parameters
    ----------
    shape : Mesh or PointCloud
        What would be written.
    format : {"ply", "obj", "off", "stl", "xyz"}
        In which.
    """
    return _core.attributes_left_out(list(shape.attributes), format)


def map_mesh(path: str | os.PathLike[str]) -> tuple[npt.NDArray[Any], IndexArray] | None:
    """Vertices and triangles of a binary PLY file where they lie in it; None for other files.

    Nothing is read before it is used, so the file may be larger than the memory. `expand` of a path
    does this by itself.

    Parameters
    ----------
    path : path
        A PLY file of native byte order with vertices and then triangles.

    Returns
    -------
    vertices : float32 or float64, (N, 3)
        Read-only; not checked.
    triangles : uint32, (M, 3)
        Read-only; not checked, and not aligned: most functions copy them.
    """
    with caller(0, False) as how:
        mapped = _core.map_mesh(os.fspath(path), how)
    if mapped is None:
        return None

    def rows(data: npt.NDArray[np.uint8], layout: tuple[int, int, str]) -> npt.NDArray[Any]:
        n, stride, dtype = layout
        item = np.dtype(dtype).itemsize
        lying: npt.NDArray[Any] = np.ndarray((n, 3), dtype, data.data, 0, (stride, item))
        return lying

    return (
        rows(mapped.vertex_bytes, mapped.vertex_layout),
        rows(mapped.triangle_bytes, mapped.triangle_layout),
    )


def validate(shape: MeshLike | PointCloud) -> None:
    """Raises InvalidInputError unless coordinates are finite, indices in range, attributes as many.

    Parameters
    ----------
    shape : mesh-like or PointCloud
        An empty one is valid.
    """
    _core.validate(shape._core if isinstance(shape, PointCloud) else as_mesh(shape)._core)


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


def repair(
    mesh: MeshLike, *, weld: float = 0.0, max_hole: int = 100, threads: int = 0, progress: Progress = None
) -> Repaired:
    """Welds, drops duplicate and degenerate faces, separates sheets, orients, closes small holes.

    Parameters
    ----------
    mesh : mesh-like
        The mesh; its vertices keep their order and attributes, new ones come last.
    weld : float
        Tolerance of welding, in the mesh's unit; 0 joins identical vertices.
    max_hole : int
        Holes with at most so many edges are closed, 0 ... 500.
    threads, progress
        See `rholm.caller`.
    """
    with caller(threads, progress) as how:
        core, report = _core.repair(as_mesh(mesh)._core, weld, max_hole, how)
    return Repaired(Mesh._of(core), report)


def simplify_options(simplify: Any, n_triangles: int | None = None) -> _core.SimplifyOptions | None:
    """Where to stop: None, "auto", a number of triangles (from 1 on), or a dict of options."""
    if simplify is None or simplify is False:
        return None
    if simplify is True or simplify == "auto":
        return _core.SimplifyOptions()
    if isinstance(simplify, dict):
        return _core.SimplifyOptions(**simplify)
    if isinstance(simplify, (int, np.integer)):
        return _core.SimplifyOptions(triangles=int(simplify))
    raise TypeError(f"simplify is None, 'auto', a number of triangles or a dict, not {simplify!r}")


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


def icosphere(subdivisions: int) -> Mesh:
    """The unit icosahedron with each edge halved `subdivisions` times, on the unit sphere.

    Parameters
    ----------
    subdivisions : int
        0 ... 12: 20 * 4^n triangles.
    """
    return Mesh._of(_core.icosphere(subdivisions))


def latitude_longitude_sphere(n_theta: int, n_phi: int) -> Mesh:
    """A unit sphere of rings, with one vertex on each pole.

    Parameters
    ----------
    n_theta : int
        Rings at colatitudes pi (i + 1/2) / n_theta.
    n_phi : int
        Directions on each, at least 3.
    """
    return Mesh._of(_core.latitude_longitude_sphere(n_theta, n_phi))


def ellipsoid(semi_axes: npt.ArrayLike, subdivisions: int) -> Mesh:
    """An ellipsoid: an icosphere with its axes stretched.

    Parameters
    ----------
    semi_axes : array_like, (3,)
        Along x, y and z.
    subdivisions : int
        Of the icosphere.
    """
    return Mesh._of(_core.ellipsoid(_triple(semi_axes, "semi_axes"), subdivisions))


def box(size: npt.ArrayLike, n: int = 1) -> Mesh:
    """A box centred at the origin.

    Parameters
    ----------
    size : array_like, (3,)
        Lengths of its edges.
    n : int
        Each face is a grid of n x n squares of two triangles.
    """
    return Mesh._of(_core.box(_triple(size, "size"), n))


def torus(ring_radius: float, tube_radius: float, n_ring: int, n_tube: int) -> Mesh:
    """A torus about the z axis.

    Parameters
    ----------
    ring_radius, tube_radius : float
        Of the centre line, and of the tube around it.
    n_ring, n_tube : int
        Vertices along each.
    """
    return Mesh._of(_core.torus(ring_radius, tube_radius, n_ring, n_tube))


def bumpy_sphere(subdivisions: int, amplitude: float = 0.2, seed: int = 1) -> Mesh:
    """A star-shaped test body: 1 + amplitude times a smooth sum of waves, on an icosphere.

    Parameters
    ----------
    subdivisions : int
        Of the icosphere.
    amplitude : float
        0 ... 1.
    seed : int
        Chooses the waves.
    """
    return Mesh._of(_core.bumpy_sphere(subdivisions, amplitude, seed))


def _triple(values: Any, what: str) -> tuple[float, float, float]:
    x, y, z = float_row(values, what)
    return float(x), float(y), float(z)


def sample_surface(
    mesh: MeshLike,
    points: int = 100_000,
    *,
    noise: float = 0.0,
    normal_noise: float = 0.0,
    outliers: float = 0.0,
    holes: int = 0,
    hole_radius: float = 0.0,
    density_ratio: float = 1.0,
    normals: bool = True,
    seed: int = 1,
    threads: int = 0,
    progress: Progress = None,
) -> PointCloud:
    """Independent random points on a surface, uniform by area.

    Parameters
    ----------
    mesh : mesh-like
        The surface. Lengths below are fractions of the diagonal of its bounding box.
    points : int
        How many.
    noise : float
        Standard deviation of a Gaussian displacement along each of x, y and z.
    normal_noise : float
        Standard deviation of the angle that normals are turned by, degrees.
    outliers : float
        Share of the points that is replaced by points anywhere in the box.
    holes : int
        Balls about random points of the surface, in which points are removed.
    hole_radius : float
        Of these.
    density_ratio : float
        The density falls along the longest axis to the inverse of this.
    normals : bool
        Whether points have them.
    seed : int
        Of all random numbers.
    threads, progress
        See `rholm.caller`.
    """
    options = _core.SampleOptions(
        points=points,
        noise=noise,
        normal_noise=normal_noise,
        outliers=outliers,
        holes=holes,
        hole_radius=hole_radius,
        density_ratio=density_ratio,
        normals=normals,
        seed=seed,
    )
    with caller(threads, progress) as how:
        return PointCloud._of(_core.sample_surface(as_mesh(mesh)._core, options, how))


class Cleaned(NamedTuple):
    """What `clean` made."""

    cloud: PointCloud
    """The points that stay."""
    report: _core.CleanReport
    """What was dropped."""


def clean(points: PointsLike) -> Cleaned:
    """Drops points that are not finite, and merges those at one place.

    Parameters
    ----------
    points : points-like
        Stay as they are.
    """
    with caller(0, False) as how:
        cloud, report = _core.clean(as_points(points)._core, how)
    return Cleaned(PointCloud._of(cloud), report)


class Oriented(NamedTuple):
    """What `orient` made."""

    cloud: PointCloud
    """The points with unit normals that point out of the solid."""
    report: _core.OrientReport
    """What was done, and how sure it is."""


def orient(
    points: PointsLike,
    normals: npt.ArrayLike | None = None,
    *,
    neighbors: int = 0,
    keep_directions: bool = False,
    center: npt.ArrayLike | None = None,
    sensor: npt.ArrayLike | None = None,
    threads: int = 0,
    progress: Progress = None,
) -> Oriented:
    """Gives points unit normals that point out of the solid they bound.

    Parameters
    ----------
    points : points-like
        The points.
    normals : array_like, (N, 3), optional
        With `keep_directions`, of which only the signs are chosen.
    neighbors : int
        Points of a fit, 3 ... 1000; 0: chosen from the data.
    keep_directions : bool
        Keeps the directions of the normals there are.
    center : array_like, (3,), optional
        The surface is seen from here from inside.
    sensor : array_like, (3,), optional
        It has been measured from here.
    threads, progress
        See `rholm.caller`.

    References
    ----------
    H. Hoppe et al., Surface reconstruction from unorganized points, 1992.
    """
    options = _core.OrientOptions(
        neighbors=neighbors,
        keep_directions=keep_directions,
        center=None if center is None else _triple(center, "center"),
        sensor=None if sensor is None else _triple(sensor, "sensor"),
    )
    with caller(threads, progress) as how:
        cloud, report = _core.orient(as_points(points, normals)._core, options, how)
    return Oriented(PointCloud._of(cloud), report)


def distances_to_surface(
    points: npt.ArrayLike, mesh: MeshLike, *, threads: int = 0, progress: Progress = None
) -> FloatArray:
    """Distance from each point to its exact closest point on a surface, (N,).

    Parameters
    ----------
    points : array_like, (N, 3)
        The points.
    mesh : mesh-like
        The surface.
    threads, progress
        See `rholm.caller`.
    """
    with caller(threads, progress) as how:
        return _core.distances_to_surface(float_rows(points), as_mesh(mesh)._core, how)


def name_of(shape: Any) -> str:
    """What a shape is called: the name of its file."""
    return Path(shape).name if isinstance(shape, (str, os.PathLike)) else ""
