"""Files of meshes and points."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import IndexArray
from ._run import Progress, caller
from ._shapes import Mesh, MeshLike, PointCloud, as_shape, columns_text, warn


class ShapeFile(NamedTuple):
    """What `read_shape` read."""

    shape: Mesh | PointCloud
    """A `Mesh` if the file has faces, else a `PointCloud`."""
    format: str
    """As its content showed: a name of `rholm.shape_formats`."""
    encoding: str
    """"ascii", "binary little endian" or "binary big endian"."""
    warnings: list[str]
    """What was passed over, with counts."""
    columns: tuple[str, ...]
    """What the columns of a text table were taken for, as the argument has it; () for other files."""
    note: str
    """The same as a line for people, and how it was decided."""
    unsure: bool
    """Whether the columns may mean something else, which `note` says."""
    dropped: int
    """Points left out, as a coordinate is not finite."""


def _shape_file(read: Any) -> ShapeFile:
    shape, form, encoding, warnings, columns, note, unsure, dropped = read
    taken = tuple(columns)
    wrapped = Mesh._of(shape) if isinstance(shape, _core.Mesh) else PointCloud._of(shape, taken)
    return ShapeFile(wrapped, form, encoding, warnings, taken, note, unsure, dropped)


def read_shape(
    path: str | os.PathLike[str],
    *,
    attributes: bool = True,
    columns: str | Sequence[str] | None = None,
    progress: Progress = None,
) -> ShapeFile:
    """Reads a mesh or points in any format of `rholm.shape_formats`.

    Parameters
    ----------
    path : path
        The content decides what the file is, the name only where the content does not. Polygons
        are cut into triangles.
    attributes : bool
        Whether attributes of vertices or points are read.
    columns : str or sequence of str, optional
        What the columns of a text table are, as in ``"x,y,z,r,g,b,nx,ny,nz,-"``: also a (alpha), or
        lat,lon,radius (degrees north and east) for x,y,z; - passes over a column, any other word is
        the name of an attribute. By default the header and the values tell.
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
        read = _core.read_shape(os.fspath(path), attributes, columns_text(columns), how)
    return _shape_file(read)


def parse_shape(
    data: bytes, name: str = "", *, attributes: bool = True, columns: str | Sequence[str] | None = None
) -> ShapeFile:
    """The same for the bytes of a file.

    Parameters
    ----------
    data : bytes
        All of them.
    name : str
        Serves messages, and its extension where the content does not say what it is.
    attributes : bool
        Whether attributes are read.
    columns : str or sequence of str, optional
        As in `read_shape`.
    """
    with caller(0, False) as how:
        read = _core.parse_shape(bytes(data), name, attributes, columns_text(columns), how)
    return _shape_file(read)


def write_shape(
    shape: MeshLike | PointCloud,
    path: str | os.PathLike[str],
    *,
    format: str | None = None,
    ascii: bool = False,
) -> None:
    """Writes a mesh or points to a temporary file that replaces `path` when complete.

    Warns (`UserWarning`) where the format's single precision does more to a shape than to round it.

    Parameters
    ----------
    shape : mesh-like or PointCloud
        What is written; attributes as far as the format has room for them.
    path : path
        Its extension says the format, if `format` does not.
    format : str, optional
        The format: a name of `rholm.shape_formats`.
    ascii : bool
        Text instead of binary where the format has both.

    Raises
    ------
    IoError
        If it cannot be written.
    UnsupportedError
        For a format that cannot hold it.
    """
    core = as_shape(shape)._core
    with caller(0, False) as how:
        said = _core.write_shape(core, os.fspath(path), format, ascii, how)
    for text in said:
        warn(f"{os.fspath(path)}: {text}")


def attributes_left_out(shape: MeshLike | PointCloud, format: str) -> list[str]:
    """Names of the attributes that a format has no room for.

    Parameters
    ----------
    shape : mesh-like or PointCloud
        What would be written.
    format : str
        A name of `rholm.shape_formats`.
    """
    return _core.attributes_left_out(list(as_shape(shape).attributes), format)


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
