"""Reads files of meshes and points."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import public
from ._arrays import IndexArray
from ._run import Progress, caller, warn
from ._shapes import Mesh, PointCloud, columns_text


class ShapeFile(NamedTuple):
    """Result of `read_shape`."""

    shape: Mesh | PointCloud
    """A `Mesh` if the file has faces, else a `PointCloud`."""
    format: str
    """As its content showed: a name of `rholm.files.shape_formats`."""
    encoding: str
    """"ascii", "binary little endian" or "binary big endian"."""
    warnings: list[str]
    """Content that the reader passed over, with counts."""
    columns: tuple[str, ...]
    """Meanings of the columns of a text table, as in the argument; () for other files."""
    note: str
    """Meanings of the columns as a line for people, with the reason."""
    unsure: bool
    """True if the columns may mean something else; `note` tells what."""
    dropped: int
    """Points left out, as a coordinate is not finite."""


def _shape_file(read: Any) -> ShapeFile:
    shape, form, encoding, warnings, columns, note, unsure, dropped = read
    taken = tuple(columns)
    wrapped = Mesh._of(shape) if isinstance(shape, _core.Mesh) else PointCloud._of(shape, taken)
    return ShapeFile(wrapped, form, encoding, warnings, taken, note, unsure, dropped)


@public
def read_shape(
    path: str | os.PathLike[str],
    *,
    attributes: bool = True,
    columns: str | Sequence[str] | None = None,
    progress: Progress = None,
) -> ShapeFile:
    """Reads a mesh or points in any format of `rholm.files.shape_formats`.

    Parameters
    ----------
    path : path
        File to read. The content decides the format; the name decides only if the content does not.
        Polygons are cut into triangles.
    attributes : bool
        True: reads attributes of vertices or points.
    columns : str or sequence of str, optional
        Meaning of the columns of a text table, as in ``"x,y,z,r,g,b,nx,ny,nz,-"``. Also possible
        are a (alpha), and lat,lon,radius (degrees north and east) for x,y,z. A - skips a column;
        any other word names an attribute. By default the header and the values decide.
    progress
        See ``help(rholm)``.

    Raises
    ------
    IoError
        If the file cannot be read.
    InvalidInputError
        If the file is malformed (with the line or the byte), truncated or empty.
    UnsupportedError
        If the format is unknown.

    Examples
    --------
    >>> rholm.icosphere(1).save("ball.stl")
    >>> rholm.read_shape("ball.stl").shape
    <rholm.Mesh: 240 vertices, 80 faces>
    """
    with caller(0, progress) as how:
        read = _core.read_shape(os.fspath(path), attributes, columns_text(columns), how)
    return _shape_file(read)


@public
def parse_shape(
    data: bytes, name: str = "", *, attributes: bool = True, columns: str | Sequence[str] | None = None
) -> ShapeFile:
    r"""Reads a mesh or points from the bytes of a file.

    Parameters
    ----------
    data : bytes
        Content of the file.
    name : str
        Name for messages. Its extension is used if the content does not identify the format.
    attributes : bool
        True: reads attributes.
    columns : str or sequence of str, optional
        As in `read_shape`.

    Examples
    --------
    >>> rholm.files.parse_shape(b"0 0 0\n1 0 0\n0 1 0\n", "points.xyz").shape
    <rholm.PointCloud: 3 points>
    """
    with caller(0, False) as how:
        read = _core.parse_shape(bytes(data), name, attributes, columns_text(columns), how)
    return _shape_file(read)


@public
def map_mesh(path: str | os.PathLike[str]) -> tuple[npt.NDArray[Any], IndexArray] | None:
    """Maps vertices and faces of a binary PLY file as arrays without a copy; None for other files.

    Data are read only when they are used, so the file may be larger than the memory. `expand` of a
    path maps files in the same way.

    Parameters
    ----------
    path : path
        PLY file of native byte order with vertices, then faces of three corners.

    Returns
    -------
    vertices : float32 or float64, (N, 3)
        Read-only; not checked.
    faces : uint32, (M, 3)
        Read-only; not checked, and not aligned: most functions copy them.

    Examples
    --------
    >>> rholm.icosphere(1).save("ball.ply")
    >>> vertices, faces = rholm.files.map_mesh("ball.ply")
    >>> vertices.shape, faces.shape
    ((42, 3), (80, 3))
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
    name, file = os.fspath(shape), read_shape(shape, columns=columns)
    if file.unsure:
        warn(f"{name}: {file.note}")
    if file.dropped:
        warn(f"{name}: {file.dropped} points with a coordinate that is not finite dropped")
    return file.shape, file.dropped
