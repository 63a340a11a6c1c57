"""Reads and writes files of models and coefficients."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any, NamedTuple

from . import _core
from ._atlas import Atlas, as_atlas
from ._coefficients import Normalization
from ._encode import as_expansion
from ._errors import InvalidInputError, UnsupportedError
from ._expansion import Expansion
from ._run import caller
from ._shapes import name_of


class CoefficientsFile(NamedTuple):
    """Coefficients read from a file, with its metadata."""

    expansion: Expansion
    """The function, in the library's own convention."""
    format: str
    """A name of `rholm.coefficients_formats`; "shtools" for a model file."""
    normalization: str
    """In which the numbers stood."""
    csphase: int
    """In which the numbers stood."""
    assumed: list[str]
    """What the file did not say."""
    product: str
    """What the file says it is of, if that is no shape."""
    passed_over: list[str]
    """What it says and what the expansion does not use."""


def _file_of(read: tuple[Any, ...]) -> CoefficientsFile:
    expansion, *rest = read
    return CoefficientsFile(Expansion._of(expansion), *rest)


_BEGINNING = 4096  # bytes that identify the contents of a file; the program uses the same number


def _not_a_shape(path: str | os.PathLike[str]) -> str:
    """Returns the path. Raises InvalidInputError if its name or first bytes belong to a shape."""
    name = os.fspath(path)
    beginning = b""
    if os.path.isfile(name):
        with open(name, "rb") as file:
            beginning = file.read(_BEGINNING)
    if _core.is_shape_file(beginning, name):
        raise InvalidInputError(
            f"{name} is a file of a shape, not of coefficients: expand() and compress() make them of it, "
            "read_shape() reads it"
        )
    return name


def read_coefficients(
    path: str | os.PathLike[str],
    *,
    normalization: Normalization = "4pi",
    csphase: int = 1,
    override_file: bool = False,
) -> CoefficientsFile:
    """Reads coefficients of text (SHTOOLS, ICGEM), JSON or NumPy files.

    Parameters
    ----------
    path : path
        File to read. The content decides the format.
    normalization, csphase
        Convention of a file that states none.
    override_file : bool
        True: uses this convention for all files, whatever they state.
    """
    source = _not_a_shape(path)
    with caller(0, False) as how:
        read = _core.read_coefficients(source, normalization, csphase, override_file, how)
    return _file_of(read)


def read_any_coefficients(
    path: str | os.PathLike[str],
    *,
    normalization: Normalization = "4pi",
    csphase: int = 1,
    override_file: bool = False,
) -> CoefficientsFile:
    """Reads a model file, or a file for `read_coefficients`.

    Parameters
    ----------
    path, normalization, csphase, override_file
        As in `read_coefficients`.
    """
    source = _not_a_shape(path)
    with caller(0, False) as how:
        read = _core.read_any_coefficients(source, normalization, csphase, override_file, how)
    return _file_of(read)


def parse_coefficients(
    data: bytes,
    name: str = "",
    *,
    normalization: Normalization = "4pi",
    csphase: int = 1,
    override_file: bool = False,
) -> CoefficientsFile:
    """Reads coefficients from the bytes of a file.

    Parameters
    ----------
    data : bytes
        Content of the file.
    name : str
        Name for messages. Its extension is used if the content does not identify the format.
    normalization, csphase, override_file
        As in `read_coefficients`.
    """
    with caller(0, False) as how:
        read = _core.parse_coefficients(data, name, normalization, csphase, override_file, how)
    return _file_of(read)


def looks_like_coefficients(data: bytes) -> bool:
    """Returns True if bytes begin like a file of coefficients. Bare text is not recognised.

    Parameters
    ----------
    data : bytes
        The beginning of a file.
    """
    return _core.looks_like_coefficients(bytes(data))


def coefficients_format_of(path: str | os.PathLike[str]) -> str | None:
    """Returns the format for an extension, a name of `coefficients_formats`; None for a model file
    and others.

    Parameters
    ----------
    path : path
        Name of a file, which need not exist.
    """
    return _core.coefficients_format_of(os.fspath(path))


def load(
    path: str | os.PathLike[str], *, normalization: Normalization = "4pi", csphase: int = 1
) -> Expansion | Atlas:
    """Reads a model file, of one expansion or of an atlas, or any file of coefficients.

    Parameters
    ----------
    path : path
        File to read. The content decides the format.
    normalization, csphase
        Convention of a file that states none (bare text, .npy).
    """
    source = _not_a_shape(path)
    with caller(0, False) as how:
        if _core.is_atlas_file(source):
            return Atlas._of(_core.read_atlas(source, how), name=name_of(path))
        expansion, *_ = _core.read_any_coefficients(source, normalization, csphase, False, how)
    return Expansion._of(expansion, name=name_of(path))


def read_model(path: str | os.PathLike[str]) -> Expansion:
    """Reads a model file of one expansion.

    Parameters
    ----------
    path : path
        HDF5 file; layout in docs/model-file.md.
    """
    with caller(0, False) as how:
        return Expansion._of(_core.read_model(os.fspath(path), how), name=name_of(path))


def write_model(expansion: Expansion, path: str | os.PathLike[str]) -> None:
    """Writes a model file.

    Parameters
    ----------
    expansion : Expansion
        Expansion, written with all its metadata.
    path : path
        File to write; an existing file is replaced when the new one is complete.
    """
    as_expansion(expansion).save(path, format="hdf5")


def write_coefficients(expansion: Expansion, path: str | os.PathLike[str], **options: Any) -> None:
    """Writes a file of coefficients; see `Expansion.save`.

    Parameters
    ----------
    expansion : Expansion
        Expansion to write.
    path : path
        File to write; its extension chooses the format.
    **options
        Arguments format, normalization, csphase, gravity_constant, reference_radius.
    """
    if Path(path).suffix.lower() in (".h5", ".hdf5") and options.get("format") is None:
        raise UnsupportedError(f"{os.fspath(path)}: model files are written by write_model(), or save()")
    as_expansion(expansion).save(path, **options)


def is_model_file(path: str | os.PathLike[str]) -> bool:
    """Returns True for a model file, by its first bytes.

    Parameters
    ----------
    path : path
        Any file.
    """
    return _core.is_model_file(os.fspath(path))


def read_atlas(path: str | os.PathLike[str]) -> Atlas:
    """Reads a model file of an atlas.

    Parameters
    ----------
    path : path
        HDF5 file; layout in docs/model-file.md.
    """
    with caller(0, False) as how:
        return Atlas._of(_core.read_atlas(os.fspath(path), how), name=name_of(path))


def write_atlas(atlas: Atlas, path: str | os.PathLike[str]) -> None:
    """Writes a model file of an atlas.

    Parameters
    ----------
    atlas : Atlas
        Atlas to write.
    path : path
        File to write; an existing file is replaced when the new one is complete.
    """
    as_atlas(atlas).save(path)


def is_atlas_file(path: str | os.PathLike[str]) -> bool:
    """Returns True for a model file that holds an atlas.

    Parameters
    ----------
    path : path
        Any file.
    """
    return _core.is_atlas_file(os.fspath(path))
