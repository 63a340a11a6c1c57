"""Meshes and points."""

from __future__ import annotations

import os
import sys
import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar, Union, cast

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import (
    FloatArray,
    IndexArray,
    attribute_dict,
    attribute_tuples,
    float_rows,
    numeric,
    plain_array,
    read_only,
    triangle_rows,
)
from ._errors import InvalidInputError
from ._interop import foreign_has_faces, foreign_mesh

if TYPE_CHECKING:
    import meshio
    import pyvista
    import trimesh


class Mesh:
    """A mesh of triangles that share vertices.

    Parameters
    ----------
    vertices : array_like, (N, 3)
        Coordinates in any unit, copied to float64.
    triangles : array_like of integers, (M, 3)
        Vertex indices, counter-clockwise seen from outside, copied to uint32.
    attributes : mapping of str to array_like, optional
        Attributes of vertices, (N,) or (N, k) each: ``{"quality": q, "rgb": colors}``. Columns of
        "rgb" become red, green, blue as in PLY files; columns of "normals" become nx, ny, nz.

    Raises
    ------
    InvalidInputError
        For coordinates that are masked or not finite, indices out of range, or attributes of a
        wrong length.

    Notes
    -----
    `vertices` and `triangles` are arrays over the library's own memory: a mesh that is given to a
    function is not copied.
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
        return self._core.vertices

    @property
    def triangles(self) -> IndexArray:
        """Vertex indices, (M, 3) uint32; read-only, not copied."""
        return self._core.triangles

    @property
    def attributes(self) -> dict[str, npt.NDArray[Any]]:
        """Attributes of vertices by name, (N,) each; read-only copies: `with_attributes` sets them."""
        return attribute_dict(self._core.attributes)

    @property
    def normals(self) -> FloatArray:
        """Unit normals of vertices, (N, 3), read-only. They are the attributes nx, ny, nz, or the
        mean normals of the surrounding faces, weighted by area. A vertex without faces has zeros.
        """
        attributes = self.attributes
        if all(name in attributes for name in ("nx", "ny", "nz")):
            rows = np.stack([attributes[name] for name in ("nx", "ny", "nz")], axis=1)
            return read_only(rows.astype(np.float64))
        rows = _core.area_normals(self._core)
        length = np.linalg.norm(rows, axis=1, keepdims=True)
        unit: FloatArray = np.divide(rows, length, out=np.zeros_like(rows), where=length > 0)
        return read_only(unit)

    @property
    def colors(self) -> npt.NDArray[np.float32] | None:
        """Colours of vertices, (N, 3) float32 in 0 ... 1, or None."""
        return vertex_colors(self)

    @property
    def bounds(self) -> _core.Bounds:
        """Bounding box of the vertices."""
        return _core.bounds(self._core.vertices)

    @property
    def area(self) -> float:
        """Total area of the faces, in the squared unit of the vertices."""
        return _core.surface_area(self._core)

    @property
    def volume(self) -> float:
        """Signed volume in the cubed unit, for a closed, consistently oriented mesh."""
        return _core.enclosed_volume(self._core)

    def copy(self) -> Mesh:
        """Returns a copy in its own memory, for example a snapshot of a mesh that an editor moves."""
        return Mesh._of(_core.copy_mesh(self._core))

    def with_attributes(self, **attributes: npt.ArrayLike) -> Mesh:
        """Returns the mesh with further attributes, which replace attributes of the same name.

        Parameters
        ----------
        **attributes : array_like, (N,) or (N, k)
            Attributes as in the constructor.
        """
        return Mesh(self.vertices, self.triangles, {**self.attributes, **attributes})

    def inspect(self) -> _core.Inspection:
        """Returns counts and measures: closed, manifold, oriented, genus, area, volume."""
        return _core.inspect(self._core)

    def save(self, path: str | os.PathLike[str], format: str | None = None, ascii: bool = False) -> None:
        """Writes a file; see `write_shape`."""
        from ._shape_files import write_shape

        write_shape(self, path, format=format, ascii=ascii)

    def render(self, **options: Any) -> Any:
        """Returns a picture; see `rholm.render`."""
        from ._pictures import render

        return render(self, **options)

    def to_trimesh(self) -> trimesh.Trimesh:
        """Returns a `trimesh.Trimesh` with the same vertices, triangles, normals and colours."""
        from ._interop import mesh_to_trimesh

        return mesh_to_trimesh(self)

    def to_pyvista(self) -> pyvista.PolyData:
        """Returns a `pyvista.PolyData` with the attributes as point data."""
        from ._interop import mesh_to_pyvista

        return mesh_to_pyvista(self)

    def to_meshio(self) -> meshio.Mesh:
        """Returns a `meshio.Mesh` with the attributes as point data."""
        from ._interop import mesh_to_meshio

        return mesh_to_meshio(self)

    def __repr__(self) -> str:
        names = sorted(self.attributes)
        with_ = f", attributes {', '.join(names)}" if names else ""
        return f"<rholm.Mesh: {len(self.vertices)} vertices, {len(self.triangles)} triangles{with_}>"

    def __eq__(self, other: object) -> bool:
        return self._core == other._core if isinstance(other, Mesh) else NotImplemented

    __hash__ = None  # type: ignore[assignment]

    def _repr_png_(self) -> bytes | None:
        from ._pictures import notebook_png

        return notebook_png(self)


class PointCloud:
    """Points without faces.

    Parameters
    ----------
    points : array_like, (N, 3) or (N, k)
        Coordinates in any unit, copied to float64. Further columns are normals, colours or
        attributes; their values decide which, as in a text table. `columns` of the result tells
        their meaning.
    normals : array_like, (N, 3), optional
        Normals of any length that point out of the solid.
    attributes : mapping of str to array_like, optional
        Attributes of points, as in `Mesh`.
    columns : str or sequence of str, optional
        Meaning of the columns of `points`, as in `read_shape`.
    """

    __slots__ = ("_columns", "_core")

    def __init__(
        self,
        points: npt.ArrayLike,
        normals: npt.ArrayLike | None = None,
        attributes: Any = None,
        columns: str | Sequence[str] | None = None,
    ) -> None:
        self._columns: tuple[str, ...] = ()
        table = numeric(points, "points")
        if table.ndim == 2 and (table.shape[1] > 3 or columns is not None):
            cloud, taken, note, unsure = _core.points_of_rows(
                np.ascontiguousarray(table, dtype=np.float64).ravel(), table.shape[1], columns_text(columns)
            )
            self._columns = tuple(taken)
            if unsure:
                warn(note)
            if normals is None and attributes is None:
                self._core: _core.PointCloud = cloud
                return
            points = cloud.points
            normals = cloud.normals if normals is None else normals
            attributes = {**attribute_dict(cloud.attributes), **(attributes or {})}
        rows = float_rows(points, "points")
        directions = None if normals is None else float_rows(normals, "normals")
        if directions is not None and len(directions) != len(rows):
            raise InvalidInputError(f"{len(directions)} normals for {len(rows)} points")
        self._core = _core.PointCloud(rows, directions, attribute_tuples(attributes, len(rows)))

    @classmethod
    def _of(cls, cloud: _core.PointCloud, columns: tuple[str, ...] = ()) -> PointCloud:
        self = cls.__new__(cls)
        self._core = cloud
        self._columns = columns
        return self

    @property
    def points(self) -> FloatArray:
        """Coordinates, (N, 3) float64; read-only, not copied."""
        return self._core.points

    @property
    def normals(self) -> FloatArray | None:
        """The given normals, (N, 3) float64, or None; read-only, not copied."""
        return self._core.normals

    @property
    def columns(self) -> tuple[str, ...]:
        """Meaning of the columns of the text table or array; () for other points."""
        return self._columns

    @property
    def attributes(self) -> dict[str, npt.NDArray[Any]]:
        """Attributes of points by name, (N,) each; read-only copies."""
        return attribute_dict(self._core.attributes)

    @property
    def colors(self) -> npt.NDArray[np.float32] | None:
        """Colours of points, (N, 3) float32 in 0 ... 1, or None."""
        return vertex_colors(self)

    @property
    def bounds(self) -> _core.Bounds:
        """Bounding box of the points."""
        return _core.bounds(self._core.points)

    def save(self, path: str | os.PathLike[str], format: str | None = None, ascii: bool = False) -> None:
        """Writes a file; see `write_shape`."""
        from ._shape_files import write_shape

        write_shape(self, path, format=format, ascii=ascii)

    def render(self, **options: Any) -> Any:
        """Returns a picture; see `rholm.render`."""
        from ._pictures import render

        return render(self, **options)

    def to_trimesh(self) -> trimesh.PointCloud:
        """Returns a `trimesh.PointCloud`."""
        from ._interop import cloud_to_trimesh

        return cloud_to_trimesh(self)

    def to_pyvista(self) -> pyvista.PolyData:
        """Returns a `pyvista.PolyData` of vertices, with normals and attributes as point data."""
        from ._interop import cloud_to_pyvista

        return cloud_to_pyvista(self)

    def __len__(self) -> int:
        return len(self._core.points)

    def __repr__(self) -> str:
        normals = " with normals" if self.normals is not None else ""
        return f"<rholm.PointCloud: {len(self)} points{normals}>"

    def __eq__(self, other: object) -> bool:
        return self._core == other._core if isinstance(other, PointCloud) else NotImplemented

    __hash__ = None  # type: ignore[assignment]

    def _repr_png_(self) -> bytes | None:
        from ._pictures import notebook_png

        return notebook_png(self)


#: A mesh is a `Mesh`, (vertices, triangles), a path, or a mesh of trimesh, PyVista or meshio. A
#: result that contains a mesh is accepted too, for example from `repair`.
MeshLike = Union[Mesh, tuple[Any, Any], str, os.PathLike[str], Any]

#: Points are a `PointCloud`, an array (N, 3) or (N, k), (points, normals), a path, or points of
#: trimesh, PyVista or meshio. A result that contains points is accepted too, for example from
#: `orient`. A mesh stands for its vertices with their normals. A second array of whole numbers
#: holds triangles.
PointsLike = Union[PointCloud, npt.ArrayLike, tuple[Any, Any], str, os.PathLike[str], Any]


def as_mesh(shape: MeshLike, attributes: bool = True) -> Mesh:
    """Converts any form of a mesh to a `Mesh`.

    Parameters
    ----------
    shape : Mesh, (vertices, triangles), path, trimesh.Trimesh, pyvista.PolyData, meshio.Mesh
        The mesh. Packages are recognised by their types; none is imported.
    attributes : bool
        True: keeps attributes of vertices.

    Raises
    ------
    InvalidInputError
        For an invalid mesh, or a file of points.
    TypeError
        For any other object.
    """
    shape = _within(shape)
    if isinstance(shape, Mesh):
        return shape
    if isinstance(shape, _core.Mesh):
        return Mesh._of(shape)
    if isinstance(shape, (str, os.PathLike)):
        from ._shape_files import read_shape

        read = read_shape(shape, attributes=attributes).shape
        if isinstance(read, Mesh):
            return read
        raise InvalidInputError(f"{os.fspath(shape)} holds points, not a mesh; reconstruct() makes one")

    arrays = foreign_mesh(shape)
    if arrays is None:
        if isinstance(shape, (tuple, list)) and len(shape) == 2:
            return Mesh(*shape)
        if isinstance(shape, PointCloud):
            raise TypeError("a mesh is needed, not a PointCloud; reconstruct() makes one of points")
        raise TypeError(
            "a mesh is a rholm.Mesh, (vertices, triangles), a path, or one of trimesh, PyVista or "
            f"meshio, not {type(shape).__name__}"
        )
    vertices, triangles, values = arrays
    return Mesh(vertices, triangles, values if attributes else None)


def outward_mesh(shape: MeshLike) -> Mesh:
    """Returns a mesh without attributes, prepared as in `expand`: welded, and turned if it is inside out."""
    return Mesh._of(_core.outward(as_mesh(shape, attributes=False)._core))


def as_shape(shape: Any) -> Mesh | PointCloud:
    """Converts any form of a mesh to a `Mesh`, and any form of points to a `PointCloud`."""
    shape = _within(shape)
    if isinstance(shape, (str, os.PathLike)):
        from ._shape_files import read_shape

        return read_shape(shape).shape
    if isinstance(shape, PointCloud):
        return shape
    if foreign_has_faces(shape) is False or _are_points(shape):
        return _points_of(shape)
    return as_mesh(shape)


def _within(shape: Any) -> Any:
    """Returns the shape in a result that contains one, for example in a result of `repair` or `orient`."""
    if isinstance(shape, tuple):
        for name in ("mesh", "cloud", "shape"):
            inner = getattr(shape, name, None)
            if isinstance(inner, (Mesh, PointCloud)):
                return inner
    return shape


def _is_pair(shape: Any) -> bool:
    """Returns True for a pair of arrays, False for a list of two points."""
    if not isinstance(shape, (tuple, list)) or len(shape) != 2:
        return False
    return isinstance(shape, tuple) or np.ndim(shape[1]) == 2


def _are_triangles(values: Any) -> bool:
    """Returns True if the second of two arrays holds indices, False for normals."""
    return plain_array(values, "triangles").dtype.kind in "iu"


def _are_points(shape: Any) -> bool:
    if isinstance(shape, (Mesh, _core.Mesh)) or foreign_has_faces(shape) is not None:
        return False
    if _is_pair(shape):
        return not _are_triangles(shape[1])
    return hasattr(shape, "__array__") or isinstance(shape, list)


def as_points(
    shape: PointsLike,
    normals: npt.ArrayLike | None = None,
    attributes: Any = None,
    columns: str | Sequence[str] | None = None,
) -> PointCloud:
    """Converts any form of points to a `PointCloud`.

    Parameters
    ----------
    shape : PointCloud, array_like (N, 3), (points, normals), path, points of trimesh, PyVista, meshio
        The points. An array may have more columns, as in `PointCloud`. A mesh stands for its
        vertices, with their normals. A masked number (`numpy.ma`) is unknown: NaN. `clean` and
        `reconstruct` drop such points and count them; other functions drop them with a warning.
    normals : array_like, (N, 3), optional
        Normals that replace the shape's own.
    attributes : mapping of str to array_like, optional
        Attributes that replace the shape's own.
    columns : str or sequence of str, optional
        Meaning of the columns of a text table or array, as in `read_shape`.
    """
    cloud = _points_of(shape, columns)
    if normals is None and attributes is None:
        return cloud
    return PointCloud(
        cloud.points,
        cloud.normals if normals is None else normals,
        cloud.attributes if attributes is None else attributes,
    )


def columns_text(columns: str | Sequence[str] | None) -> str:
    """Returns the meaning of columns in the form that the library takes.

    Parameters
    ----------
    columns : str or sequence of str, optional
        Names separated by commas, or a sequence of names.
    """
    if columns is None or isinstance(columns, str):
        return columns or ""
    return ",".join(columns)


def warn(text: str) -> None:
    """Warns the caller of the package: the warning points to the first frame outside of it.

    Parameters
    ----------
    text : str
        One sentence.
    """
    frame, depth = sys._getframe(1), 2
    while frame.f_back is not None and frame.f_globals.get("__name__", "").startswith("rholm"):
        frame, depth = frame.f_back, depth + 1
    warnings.warn(text, UserWarning, stacklevel=depth)


def shape_of_path(shape: Any, columns: str | Sequence[str] | None = None) -> tuple[Any, int]:
    """Reads the shape of a path; returns any other object unchanged.

    Parameters
    ----------
    shape : path, or anything else
        Path or other object. A warning tells which meanings are unsure, and how many points are
        dropped.
    columns : str or sequence of str, optional
        Meaning of the columns of a text table, as in `read_shape`.

    Returns
    -------
    shape, dropped
        The shape, and the number of points dropped because they are not finite.
    """
    if not isinstance(shape, (str, os.PathLike)):
        return shape, 0
    from ._shape_files import read_shape

    name, file = os.fspath(shape), read_shape(shape, columns=columns)
    if file.unsure:
        warn(f"{name}: {file.note}")
    if file.dropped:
        warn(f"{name}: {file.dropped} points with a coordinate that is not finite dropped")
    return file.shape, file.dropped


def _points_of(shape: Any, columns: str | Sequence[str] | None = None) -> PointCloud:
    shape, _ = shape_of_path(_within(shape), columns)
    if isinstance(shape, PointCloud):
        return shape
    if foreign_has_faces(shape):
        shape = as_mesh(shape)
    if isinstance(shape, Mesh):
        return PointCloud(shape.vertices, shape.normals, shape.attributes)
    from ._interop import foreign_points

    arrays = foreign_points(shape)
    if arrays is not None:
        return PointCloud(*arrays)
    if _is_pair(shape):
        return _points_of(Mesh(*shape)) if _are_triangles(shape[1]) else PointCloud(*shape)
    return PointCloud(shape, columns=columns)


AnyShape = TypeVar("AnyShape", bound=Mesh | PointCloud)


def finite_points(
    shape: AnyShape, *values: npt.NDArray[Any] | None
) -> tuple[AnyShape, list[npt.NDArray[Any] | None]]:
    """Returns a shape without points that are not finite. A warning tells their number.

    Parameters
    ----------
    shape : Mesh or PointCloud
        The shape. A mesh is returned unchanged.
    *values : ndarray, (N, ...), or None
        Values of the points. The second result holds the values of the remaining points.
    """
    if isinstance(shape, Mesh):
        return shape, list(values)
    known = np.asarray(np.isfinite(shape.points).all(axis=1))
    dropped = len(known) - np.count_nonzero(known)
    if not dropped:
        return shape, list(values)
    for rows in values:
        if rows is not None and len(rows) != len(known):
            raise InvalidInputError(f"{len(rows)} values for {len(known)} points")
    warn(f"{dropped} points with a coordinate that is not finite dropped")
    cloud = PointCloud(
        shape.points[known],
        None if shape.normals is None else shape.normals[known],
        {name: rows[known] for name, rows in shape.attributes.items()},
    )
    return cast(AnyShape, cloud), [None if rows is None else rows[known] for rows in values]


def vertex_colors(mesh: MeshLike | PointCloud) -> npt.NDArray[np.float32] | None:
    """Returns the attributes red, green and blue, (N, 3) float32 in 0 ... 1, or None.

    Parameters
    ----------
    mesh : mesh-like or PointCloud
        The shape. Whole numbers count as bytes, others as fractions of 1.
    """
    colors = _core.vertex_colors(as_shape(mesh)._core)
    return read_only(colors) if len(colors) else None


def validate(shape: MeshLike | PointCloud) -> None:
    """Raises InvalidInputError unless coordinates are finite, indices in range, attributes of equal
    length.

    Parameters
    ----------
    shape : mesh-like or PointCloud
        The shape. An empty shape is valid.
    """
    _core.validate(as_shape(shape)._core)


def name_of(shape: Any) -> str:
    """Returns the name of a shape: the name of its file."""
    return Path(shape).name if isinstance(shape, (str, os.PathLike)) else ""
