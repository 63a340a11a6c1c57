"""Meshes and points."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar, cast

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import public
from ._arrays import (
    FloatArray,
    IndexArray,
    attribute_dict,
    attribute_tuples,
    face_rows,
    float_rows,
    numeric,
    read_only,
)
from ._errors import InvalidInputError
from ._interop import cloud_to_pyvista, cloud_to_trimesh, mesh_to_meshio, mesh_to_pyvista, mesh_to_trimesh
from ._run import caller, renamed, warn
from ._shown import Shown

if TYPE_CHECKING:
    import meshio
    import pyvista
    import trimesh


@public
class Mesh(Shown):
    """A mesh of triangular faces that share vertices.

    Parameters
    ----------
    vertices : array_like, (N, 3)
        Coordinates in any unit, copied to float64.
    faces : array_like of integers, (M, 3)
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
    `vertices` and `faces` are arrays over the library's own memory: a mesh that is given to a
    function is not copied.

    Examples
    --------
    >>> corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
    >>> mesh = rholm.Mesh(corners, [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
    >>> mesh.faces.shape, round(mesh.volume, 6)
    ((4, 3), 0.166667)
    """

    __slots__ = ("_core",)

    def __init__(self, vertices: npt.ArrayLike, faces: npt.ArrayLike, attributes: Any = None) -> None:
        rows = float_rows(vertices, "vertices")
        mesh = _core.Mesh(
            rows, np.ascontiguousarray(face_rows(faces)), attribute_tuples(attributes, len(rows))
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
    def faces(self) -> IndexArray:
        """Vertex indices, (M, 3) uint32; read-only, not copied."""
        return self._core.faces

    @property
    def triangles(self) -> IndexArray:
        """Old name of `faces`."""
        renamed("Mesh.triangles", "Mesh.faces")
        return self.faces

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
        return colors_of(self)

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
        """Returns a copy in its own memory, for example a snapshot of a mesh that an editor moves.

        Examples
        --------
        >>> mesh = rholm.icosphere(1)
        >>> mesh.copy() == mesh
        True
        """
        return Mesh._of(_core.copy_mesh(self._core))

    def with_attributes(self, **attributes: npt.ArrayLike) -> Mesh:
        """Returns the mesh with further attributes, which replace attributes of the same name.

        Parameters
        ----------
        **attributes : array_like, (N,) or (N, k)
            Attributes as in the constructor.

        Examples
        --------
        >>> rholm.icosphere(0).with_attributes(quality=np.arange(12))
        <rholm.Mesh: 12 vertices, 20 faces, attributes quality>
        """
        return Mesh(self.vertices, self.faces, {**self.attributes, **attributes})

    def inspect(self) -> _core.Inspection:
        """Returns counts and measures: closed, manifold, oriented, genus, area, volume.

        Examples
        --------
        >>> rholm.box((1, 1, 1)).inspect().closed
        True
        """
        return _core.inspect(self._core)

    def save(self, path: str | os.PathLike[str], format: str | None = None, ascii: bool = False) -> None:
        """Writes a file.

        Parameters
        ----------
        path, format, ascii
            As in `write_shape`.

        Examples
        --------
        >>> rholm.icosphere(1).save("ball.obj")
        >>> rholm.meshes.as_mesh("ball.obj")
        <rholm.Mesh: 42 vertices, 80 faces>
        """
        _save(self._core, path, format, ascii)

    def to_trimesh(self) -> trimesh.Trimesh:
        """Returns a `trimesh.Trimesh` with the same vertices, faces, normals and colours.

        Examples
        --------
        >>> rholm.icosphere(1).to_trimesh().faces.shape
        (80, 3)
        """
        return mesh_to_trimesh(self)

    def to_pyvista(self) -> pyvista.PolyData:
        """Returns a `pyvista.PolyData` with the attributes as point data.

        Examples
        --------
        >>> rholm.icosphere(1).to_pyvista().n_points
        42
        """
        return mesh_to_pyvista(self)

    def to_meshio(self) -> meshio.Mesh:
        """Returns a `meshio.Mesh` with the attributes as point data.

        Examples
        --------
        >>> rholm.icosphere(1).to_meshio().cells[0].type
        'triangle'
        """
        return mesh_to_meshio(self)

    def __repr__(self) -> str:
        names = sorted(self.attributes)
        with_ = f", attributes {', '.join(names)}" if names else ""
        return f"<rholm.Mesh: {len(self.vertices)} vertices, {len(self.faces)} faces{with_}>"

    def __eq__(self, other: object) -> bool:
        return self._core == other._core if isinstance(other, Mesh) else NotImplemented

    __hash__ = None  # type: ignore[assignment]


@public
class PointCloud(Shown):
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

    Examples
    --------
    >>> rholm.PointCloud([[0, 0, 1], [0, 1, 0]], normals=[[0, 0, 1], [0, 1, 0]])
    <rholm.PointCloud: 2 points with normals>
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
        return colors_of(self)

    @property
    def bounds(self) -> _core.Bounds:
        """Bounding box of the points."""
        return _core.bounds(self._core.points)

    def save(self, path: str | os.PathLike[str], format: str | None = None, ascii: bool = False) -> None:
        """Writes a file.

        Parameters
        ----------
        path, format, ascii
            As in `write_shape`.

        Examples
        --------
        >>> rholm.PointCloud([[0, 0, 1], [0, 1, 0]]).save("points.ply")
        >>> rholm.read_shape("points.ply").shape
        <rholm.PointCloud: 2 points>
        """
        _save(self._core, path, format, ascii)

    def to_trimesh(self) -> trimesh.PointCloud:
        """Returns a `trimesh.PointCloud`.

        Examples
        --------
        >>> rholm.PointCloud([[0, 0, 1], [0, 1, 0]]).to_trimesh().vertices.shape
        (2, 3)
        """
        return cloud_to_trimesh(self)

    def to_pyvista(self) -> pyvista.PolyData:
        """Returns a `pyvista.PolyData` of vertices, with normals and attributes as point data.

        Examples
        --------
        >>> rholm.PointCloud([[0, 0, 1], [0, 1, 0]]).to_pyvista().n_points
        2
        """
        return cloud_to_pyvista(self)

    def __len__(self) -> int:
        return len(self._core.points)

    def __repr__(self) -> str:
        normals = " with normals" if self.normals is not None else ""
        return f"<rholm.PointCloud: {len(self)} points{normals}>"

    def __eq__(self, other: object) -> bool:
        return self._core == other._core if isinstance(other, PointCloud) else NotImplemented

    __hash__ = None  # type: ignore[assignment]


def _save(
    core: _core.Mesh | _core.PointCloud, path: str | os.PathLike[str], format: str | None, ascii: bool
) -> None:
    with caller(0, False) as how:
        said = _core.write_shape(core, os.fspath(path), format, ascii, how)
    for text in said:
        warn(f"{os.fspath(path)}: {text}")


def colors_of(shape: Mesh | PointCloud) -> npt.NDArray[np.float32] | None:
    """Returns the attributes red, green and blue, (N, 3) float32 in 0 ... 1, or None."""
    colors = _core.vertex_colors(shape._core)
    return read_only(colors) if len(colors) else None


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


def name_of(shape: Any) -> str:
    """Returns the name of a shape: the name of its file."""
    return Path(shape).name if isinstance(shape, (str, os.PathLike)) else ""
