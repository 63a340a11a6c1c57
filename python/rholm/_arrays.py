"""Converts arrays of users to the arrays that the library takes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Protocol, Union

import numpy as np
import numpy.typing as npt

from ._errors import InvalidInputError


class SupportsArray(Protocol):
    """An object that NumPy makes an array of, for example a table of pandas."""

    def __array__(self) -> npt.NDArray[Any]: ...


#: An array of rows, or lists of numbers or arrays. Unlike `numpy.typing.ArrayLike` it has no scalars.
Rows = Union[npt.NDArray[Any], Sequence[Any], SupportsArray]

FloatArray = npt.NDArray[np.float64]
IndexArray = npt.NDArray[np.uint32]

#: Types that an attribute can have; values of other types are converted to the nearest one.
ATTRIBUTE_TYPES = ("int8", "uint8", "int16", "uint16", "int32", "uint32", "float32", "float64")


def plain_array(values: Any, what: str) -> npt.NDArray[Any]:
    """Returns an array of the values. A masked number becomes NaN.

    Parameters
    ----------
    values : array_like
        Values, possibly a masked array or a list of masked arrays.
    what : str
        Name of the values in messages.
    """
    if isinstance(values, (list, tuple)) and any(isinstance(v, np.ma.MaskedArray) for v in values):
        values = np.ma.array(values)
    if np.ma.is_masked(values):
        if values.dtype.kind not in "fiub":
            raise TypeError(f"{what}: a masked array of {values.dtype} has no numbers")
        single = values.dtype == np.float32
        return np.asarray(values.astype(np.float32 if single else np.float64).filled(np.nan))
    try:
        return np.asarray(values)
    except ValueError as error:  # NumPy's message is about sequences
        raise InvalidInputError(f"{what}: an array is needed, with rows of one length ({error})") from None


def numeric(values: Any, what: str) -> npt.NDArray[Any]:
    """Returns an array of real numbers, with NaN for masked ones."""
    array = plain_array(values, what)
    if array.dtype.kind not in "fiub":
        raise TypeError(f"{what}: numbers are needed, not an array of {array.dtype}")
    return array


def read_only(array: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """Returns the array, made read-only: it is a copy, so that writing to it would have no effect."""
    array.flags.writeable = False
    return array


def unwritable(array: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """Returns the array if nobody can write to its memory, and otherwise a copy. Another thread
    could write to it while the library reads it.
    """
    owner: Any = array
    while isinstance(owner, np.ndarray):
        if owner.flags.writeable:
            return np.array(array, order="C")
        owner = owner.base
    if owner is None or isinstance(owner, bytes):
        return array
    try:
        frozen = memoryview(owner).readonly
    except TypeError:  # the owner does not tell
        frozen = False
    return array if frozen else np.array(array, order="C")


def float_rows(values: Any, what: str = "points") -> FloatArray:
    """Returns rows of three numbers, float64 in C order; a view of an array that has this form.

    Parameters
    ----------
    values : array_like, (N, 3)
        Numbers of any real type. An empty list has no rows.
    what : str
        Name of the values in messages.
    """
    array = numeric(values, what)
    if array.size == 0 and array.ndim <= 2 and array.shape[-1] in (0, 3):
        array = array.reshape(0, 3)
    if array.ndim != 2 or array.shape[1] != 3:
        raise InvalidInputError(f"{what}: an array (N, 3) is needed, not {array.shape}")
    return np.ascontiguousarray(array, dtype=np.float64)


def float_row(values: Any, what: str = "point") -> FloatArray:
    """Returns one row of three numbers."""
    array = numeric(values, what)
    if array.shape != (3,):
        raise InvalidInputError(f"{what}: three numbers are needed, not {array.shape}")
    return np.ascontiguousarray(array, dtype=np.float64)


def floats(values: Any, what: str = "values") -> FloatArray:
    """Returns a list of float64 numbers; a view of an array that has this form."""
    array = numeric(values, what)
    if array.ndim != 1:
        raise InvalidInputError(f"{what}: an array (N,) is needed, not {array.shape}")
    return np.ascontiguousarray(array, dtype=np.float64)


def vertex_rows(values: Any) -> npt.NDArray[Any]:
    """Returns vertices as float32 or float64 of native byte order, numbers of a row side by side.
    The array is copied only if it does not have this form.
    """
    array = numeric(values, "vertices")
    if array.size == 0:
        return float_rows(array, "vertices")
    if array.ndim != 2 or array.shape[1] != 3:
        raise InvalidInputError(f"vertices: an array (N, 3) is needed, not {array.shape}")
    if array.dtype not in (np.dtype(np.float32), np.dtype(np.float64)):
        array = array.astype(np.float64)
    side_by_side = array.strides[1] == array.itemsize
    whole = array.strides[0] >= 0 and array.strides[0] % array.itemsize == 0
    aligned = array.flags.aligned
    return array if side_by_side and whole and aligned else np.ascontiguousarray(array)


def face_rows(values: Any) -> npt.NDArray[np.uint32]:
    """Returns vertex indices of 32 bits, numbers of a row side by side. The array is copied only if
    it does not have this form, for example for 64-bit indices.
    """
    array = plain_array(values, "faces")
    if np.ma.is_masked(values):
        raise InvalidInputError("faces: an index is masked; leave its row out")
    if array.size == 0 and array.ndim <= 2 and (array.ndim == 0 or array.shape[-1] in (0, 3)):
        return np.empty((0, 3), np.uint32)
    if array.dtype.kind not in "iu":
        raise TypeError(f"faces: whole numbers are needed, not an array of {array.dtype}")
    if array.ndim != 2 or array.shape[1] != 3:
        raise InvalidInputError(
            f"faces: an array (M, 3) is needed, not {array.shape}; other polygons are cut by "
            "trimesh, pyvista or read_shape()"
        )
    if array.dtype.kind == "i" and array.min() < 0:
        raise InvalidInputError(f"faces: the index {array.min()} is negative")
    if array.dtype not in (np.dtype(np.int32), np.dtype(np.uint32)):
        if array.itemsize > 4 and array.max() > 0xFFFFFFFF:
            raise InvalidInputError(f"faces: the index {array.max()} has more than 32 bits")
        array = array.astype(np.uint32)
    side_by_side = array.strides[1] == array.itemsize
    whole = array.strides[0] >= 0 and array.strides[0] % array.itemsize == 0
    if not (side_by_side and whole and array.flags.aligned):
        array = np.ascontiguousarray(array)
    return array.view(np.uint32)


def attribute_type(dtype: np.dtype[Any]) -> str:
    """Returns the type that an attribute of this dtype has in a file."""
    name = str(dtype.name)
    if name in ATTRIBUTE_TYPES:
        return name
    kinds = {"b": "uint8", "i": "int32", "u": "uint32", "f": "float64" if dtype.itemsize > 4 else "float32"}
    if dtype.kind not in kinds:
        raise TypeError(f"no attribute can be an array of {dtype}")
    return kinds[dtype.kind]


#: Names of the columns of attributes with several numbers per vertex.
_COLUMNS = {
    "rgb": ("red", "green", "blue"),
    "rgba": ("red", "green", "blue", "alpha"),
    "color": ("red", "green", "blue", "alpha"),
    "colors": ("red", "green", "blue", "alpha"),
    "normal": ("nx", "ny", "nz"),
    "normals": ("nx", "ny", "nz"),
    "uv": ("u", "v"),
}


def attribute_tuples(attributes: Any, n: int) -> list[tuple[str, str, FloatArray]]:
    """Returns attributes as tuples (name, type, values). Each column of a wider array gets its own
    name.

    Parameters
    ----------
    attributes : mapping of str to array_like or None
        One array (N,) or (N, k) per attribute.
    n : int
        Number of vertices or points.
    """
    result: list[tuple[str, str, FloatArray]] = []
    if attributes is None:
        return result
    if not isinstance(attributes, Mapping):
        raise TypeError(f"attributes are a dict of arrays, not {type(attributes).__name__}")
    for name, values in attributes.items():
        if not isinstance(name, str):
            raise TypeError(f"attributes have names, not {name!r}")
        array = plain_array(values, f"attribute '{name}'")
        kind = attribute_type(array.dtype)
        if array.ndim not in (1, 2) or array.shape[0] != n:
            raise InvalidInputError(
                f"attribute '{name}': an array ({n},) or ({n}, k) is needed, not {array.shape}"
            )
        if array.dtype.itemsize == 8 and array.dtype.kind in "iu" and array.size:
            limits = np.iinfo(kind)
            if array.min() < limits.min or array.max() > limits.max:
                kind = "float64"
        if array.ndim == 1:
            result.append((name, kind, np.ascontiguousarray(array, dtype=np.float64)))
            continue
        names = _COLUMNS.get(name, ())
        if len(names) < array.shape[1]:
            names = tuple(f"{name}_{k}" for k in range(array.shape[1]))
        for k in range(array.shape[1]):
            result.append((names[k], kind, np.ascontiguousarray(array[:, k], dtype=np.float64)))
    return result


def attribute_dict(tuples: list[tuple[str, str, FloatArray]]) -> dict[str, npt.NDArray[Any]]:
    """Returns attributes by name, each with the type that it has in a file."""
    return {name: read_only(values.astype(kind)) for name, kind, values in tuples}


def directions(values: Any) -> tuple[FloatArray, tuple[int, ...]]:
    """Returns unit vectors (N, 3) of vectors (..., 3), and the shape without the last axis."""
    array = numeric(values, "directions")
    if array.ndim == 0 or array.shape[-1] != 3:
        raise InvalidInputError(f"directions: an array (..., 3) is needed, not {array.shape}")
    rows = np.ascontiguousarray(array.reshape(-1, 3), dtype=np.float64)
    squares = np.einsum("ij,ij->i", rows, rows)
    if (np.abs(squares - 1) <= 4 * np.finfo(np.float64).eps).all():  # unit vectors already
        return rows, array.shape[:-1]
    if not np.isfinite(squares).all() or (squares < 1e-200).any():  # too large or small to be squared
        scale = np.abs(rows).max(axis=1, keepdims=True)
        if not np.isfinite(scale).all() or (scale == 0).any():
            raise InvalidInputError("directions: a vector is zero or not finite")
        rows = rows / scale
        squares = np.einsum("ij,ij->i", rows, rows)
    return rows / np.sqrt(squares)[:, None], array.shape[:-1]


def triple(values: Any, what: str) -> tuple[float, float, float]:
    """Returns three numbers, the form in which the library takes a point."""
    x, y, z = float_row(values, what)
    return float(x), float(y), float(z)
