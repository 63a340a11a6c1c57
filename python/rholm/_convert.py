"""Converts shapes of users to meshes and points, and writes them."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any, Protocol, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import form, public
from ._arrays import Rows, plain_array
from ._errors import InvalidInputError
from ._interop import foreign_has_faces, foreign_mesh, foreign_points
from ._shape_files import read_shape, shape_of_path
from ._shapes import Mesh, PointCloud, colors_of


class HasFaces(Protocol):
    """A mesh with arrays of vertices and faces, as trimesh has it."""

    @property
    def vertices(self) -> Any: ...
    @property
    def faces(self) -> Any: ...


class HasTriangles(Protocol):
    """A mesh with arrays of vertices and triangles, as Open3D has it."""

    @property
    def vertices(self) -> Any: ...
    @property
    def triangles(self) -> Any: ...


class HasPoints(Protocol):
    """Points, or a mesh, with an array of points, as PyVista and meshio have it."""

    @property
    def points(self) -> npt.NDArray[Any]: ...


class HasMesh(Protocol):
    """A result that contains a mesh, for example of `repair`."""

    @property
    def mesh(self) -> Mesh: ...


class HasCloud(Protocol):
    """A result that contains points, for example of `orient`."""

    @property
    def cloud(self) -> PointCloud: ...


class HasShape(Protocol):
    """A result that contains a mesh or points, of `read_shape`."""

    @property
    def shape(self) -> Mesh | PointCloud: ...


#: A mesh is a `Mesh`, (vertices, faces), a path, or a mesh of trimesh, PyVista, meshio or Open3D. A
#: result that contains a mesh is accepted too, for example from `repair`.
MeshLike = Union[
    Mesh, tuple[Any, Any], str, os.PathLike[str], HasFaces, HasTriangles, HasPoints, HasMesh, HasShape
]

#: Points are a `PointCloud`, an array (N, 3) or (N, k), (points, normals), a path, or points of
#: trimesh, PyVista or meshio. A result that contains points is accepted too, for example from
#: `orient`. A mesh stands for its vertices with their normals. A second array of whole numbers
#: holds faces.
PointsLike = Union[
    PointCloud,
    Rows,
    tuple[Any, Any],
    str,
    os.PathLike[str],
    HasFaces,
    HasTriangles,
    HasPoints,
    HasCloud,
    HasMesh,
    HasShape,
]

form(MeshLike, "a mesh, (vertices, faces), or a path")
form(PointsLike, "points, an array (N, 3), or a path")


@public
def as_mesh(shape: MeshLike, attributes: bool = True) -> Mesh:
    """Converts any form of a mesh to a `Mesh`.

    Parameters
    ----------
    shape : Mesh, (vertices, faces), path, trimesh.Trimesh, pyvista.PolyData, meshio.Mesh
        The mesh. Packages are recognised by their types; none is imported.
    attributes : bool
        True: keeps attributes of vertices.

    Raises
    ------
    InvalidInputError
        For an invalid mesh, or a file of points.
    TypeError
        For any other object.

    Examples
    --------
    >>> rholm.meshes.as_mesh(([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]))
    <rholm.Mesh: 3 vertices, 1 faces>
    """
    shape = _within(shape)
    if isinstance(shape, Mesh):
        return shape
    if isinstance(shape, _core.Mesh):
        return Mesh._of(shape)
    if isinstance(shape, (str, os.PathLike)):
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
            "a mesh is a rholm.Mesh, (vertices, faces), a path, or one of trimesh, PyVista or "
            f"meshio, not {type(shape).__name__}"
        )
    vertices, faces, values = arrays
    return Mesh(vertices, faces, values if attributes else None)


def outward_mesh(shape: MeshLike) -> Mesh:
    """Returns a mesh without attributes, prepared as in `expand`: welded, and turned if it is inside out."""
    return Mesh._of(_core.outward(as_mesh(shape, attributes=False)._core))


def as_shape(shape: Any) -> Mesh | PointCloud:
    """Converts any form of a mesh to a `Mesh`, and any form of points to a `PointCloud`."""
    shape = _within(shape)
    if isinstance(shape, (str, os.PathLike)):
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


def _are_faces(values: Any) -> bool:
    """Returns True if the second of two arrays holds indices, False for normals."""
    return plain_array(values, "faces").dtype.kind in "iu"


def _are_points(shape: Any) -> bool:
    if isinstance(shape, (Mesh, _core.Mesh)) or foreign_has_faces(shape) is not None:
        return False
    if _is_pair(shape):
        return not _are_faces(shape[1])
    return hasattr(shape, "__array__") or isinstance(shape, list)


@public
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

    Examples
    --------
    >>> rholm.clouds.as_points(np.eye(3), attributes={"quality": [1, 2, 3]})
    <rholm.PointCloud: 3 points>
    """
    cloud = _points_of(shape, columns)
    if normals is None and attributes is None:
        return cloud
    return PointCloud(
        cloud.points,
        cloud.normals if normals is None else normals,
        cloud.attributes if attributes is None else attributes,
    )


def _points_of(shape: Any, columns: str | Sequence[str] | None = None) -> PointCloud:
    shape, _ = shape_of_path(_within(shape), columns)
    if isinstance(shape, PointCloud):
        return shape
    if foreign_has_faces(shape):
        shape = as_mesh(shape)
    if isinstance(shape, Mesh):
        return PointCloud(shape.vertices, shape.normals, shape.attributes)
    arrays = foreign_points(shape)
    if arrays is not None:
        return PointCloud(*arrays)
    if _is_pair(shape):
        return _points_of(Mesh(*shape)) if _are_faces(shape[1]) else PointCloud(*shape)
    return PointCloud(shape, columns=columns)


@public
def vertex_colors(mesh: MeshLike | PointCloud) -> npt.NDArray[np.float32] | None:
    """Returns the attributes red, green and blue, (N, 3) float32 in 0 ... 1, or None.

    Parameters
    ----------
    mesh : mesh-like or PointCloud
        The shape. Whole numbers count as bytes, others as fractions of 1.

    Examples
    --------
    >>> gold = rholm.icosphere(0).with_attributes(rgb=np.full((12, 3), (255, 204, 0), np.uint8))
    >>> rholm.meshes.vertex_colors(gold)[0]
    array([1. , 0.8, 0. ], dtype=float32)
    """
    return colors_of(as_shape(mesh))


@public
def validate(shape: MeshLike | PointCloud) -> None:
    """Raises InvalidInputError unless coordinates are finite, indices in range, attributes of equal
    length.

    Parameters
    ----------
    shape : mesh-like or PointCloud
        The shape. An empty shape is valid.

    Examples
    --------
    >>> rholm.meshes.validate(rholm.icosphere(1))
    """
    _core.validate(as_shape(shape)._core)


@public
def write_shape(
    shape: MeshLike | PointCloud,
    path: str | os.PathLike[str],
    *,
    format: str | None = None,
    ascii: bool = False,
) -> None:
    """Writes a mesh or points to a temporary file that replaces `path` when complete.

    Warns (`UserWarning`) if the format's single precision changes a shape by more than rounding.

    Parameters
    ----------
    shape : mesh-like or PointCloud
        Shape to write. Attributes are written if the format has room for them.
    path : path
        File to write. Its extension chooses the format, unless `format` is given.
    format : str, optional
        Name of the format, from `rholm.files.shape_formats`.
    ascii : bool
        True: writes text if the format has text and binary files.

    Raises
    ------
    IoError
        If the file cannot be written.
    UnsupportedError
        For a format that cannot hold the shape.

    Examples
    --------
    >>> rholm.files.write_shape(rholm.icosphere(1), "ball.ply", ascii=True)
    >>> rholm.read_shape("ball.ply").encoding
    'ascii'
    """
    as_shape(shape).save(path, format, ascii)


@public
def attributes_left_out(shape: MeshLike | PointCloud, format: str) -> list[str]:
    """Returns the names of the attributes that a format has no room for.

    Parameters
    ----------
    shape : mesh-like or PointCloud
        Shape that would be written.
    format : str
        Name of the format, from `rholm.files.shape_formats`.

    Examples
    --------
    >>> marked = rholm.icosphere(0).with_attributes(quality=np.arange(12))
    >>> (
    ...     rholm.files.attributes_left_out(marked, "stl"),
    ...     rholm.files.attributes_left_out(marked, "ply"),
    ... )
    (['quality'], [])
    """
    return _core.attributes_left_out(list(as_shape(shape).attributes), format)
