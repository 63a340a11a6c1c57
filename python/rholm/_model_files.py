"""Reads and writes files of models and coefficients."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any, NamedTuple

from . import _core
from ._arguments import public
from ._atlas import Atlas, as_atlas
from ._coefficients import Normalization
from ._errors import InvalidInputError, UnsupportedError
from ._expand import as_expansion
from ._expansion import Expansion
from ._run import caller
from ._shapes import name_of


class CoefficientsFile(NamedTuple):
    """Coefficients read from a file, with its metadata."""

    expansion: Expansion
    """The function, in the library's own convention."""
    format: str
    """A name of `rholm.files.coefficients_formats`; "shtools" for a model file."""
    normalization: str
    """Normalisation of the numbers in the file."""
    csphase: int
    """Sign convention (1 or -1) of the numbers in the file."""
    assumed: list[str]
    """Conventions that the file does not state and that were assumed."""
    product: str
    """Content of the file by its own words, if this is no shape."""
    passed_over: list[str]
    """Entries of the file that the expansion does not use."""


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


@public
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

    Examples
    --------
    >>> rholm.expand(rholm.bumpy_sphere(3), degree=4).save("body.json")
    >>> rholm.files.read_coefficients("body.json").expansion.degree
    4
    """
    source = _not_a_shape(path)
    with caller(0, False) as how:
        read = _core.read_coefficients(source, normalization, csphase, override_file, how)
    return _file_of(read)


@public
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

    Examples
    --------
    >>> rholm.expand(rholm.bumpy_sphere(3), degree=4).save("body.h5")
    >>> rholm.files.read_any_coefficients("body.h5").expansion.degree
    4
    """
    source = _not_a_shape(path)
    with caller(0, False) as how:
        read = _core.read_any_coefficients(source, normalization, csphase, override_file, how)
    return _file_of(read)


@public
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

    Examples
    --------
    >>> text = b"0, 0, 2.5, 0"
    >>> float(rholm.files.parse_coefficients(text, "body.sh").expansion.coeffs[0, 0, 0])
    2.5
    """
    with caller(0, False) as how:
        read = _core.parse_coefficients(data, name, normalization, csphase, override_file, how)
    return _file_of(read)


@public
def looks_like_coefficients(data: bytes) -> bool:
    """Returns True if bytes begin like a file of coefficients. Bare text is not recognised.

    Parameters
    ----------
    data : bytes
        The beginning of a file.

    Examples
    --------
    >>> rholm.files.looks_like_coefficients(b"product_type gravity_field")
    True
    """
    return _core.looks_like_coefficients(bytes(data))


@public
def coefficients_format_of(path: str | os.PathLike[str]) -> str | None:
    """Returns the format for an extension, a name of `coefficients_formats`; None for a model file
    and others.

    Parameters
    ----------
    path : path
        Name of a file, which need not exist.

    Examples
    --------
    >>> (
    ...     rholm.files.coefficients_format_of("moon.gfc"),
    ...     rholm.files.coefficients_format_of("moon.stl"),
    ... )
    ('icgem', None)
    """
    return _core.coefficients_format_of(os.fspath(path))


@public
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

    Examples
    --------
    >>> rholm.expand(rholm.bumpy_sphere(3), degree=4).save("body.h5")
    >>> rholm.load("body.h5").degree
    4
    """
    source = _not_a_shape(path)
    with caller(0, False) as how:
        if _core.is_atlas_file(source):
            return Atlas._of(_core.read_atlas(source, how), name=name_of(path))
        expansion, *_ = _core.read_any_coefficients(source, normalization, csphase, False, how)
    return Expansion._of(expansion, name=name_of(path))


@public
def read_model(path: str | os.PathLike[str]) -> Expansion:
    """Reads a model file of one expansion.

    Parameters
    ----------
    path : path
        HDF5 file; layout in docs/model-file.md.

    Examples
    --------
    >>> rholm.expand(rholm.bumpy_sphere(3), degree=4).save("body.h5")
    >>> rholm.files.read_model("body.h5").degree
    4
    """
    with caller(0, False) as how:
        return Expansion._of(_core.read_model(os.fspath(path), how), name=name_of(path))


@public
def write_model(expansion: Expansion, path: str | os.PathLike[str]) -> None:
    """Writes a model file.

    Parameters
    ----------
    expansion : Expansion
        Expansion, written with all its metadata.
    path : path
        File to write; an existing file is replaced when the new one is complete.

    Examples
    --------
    >>> rholm.files.write_model(rholm.expand(rholm.bumpy_sphere(3), degree=4), "body.h5")
    >>> rholm.files.is_model_file("body.h5")
    True
    """
    as_expansion(expansion).save(path, format="hdf5")


@public
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

    Examples
    --------
    >>> s = rholm.expand(rholm.bumpy_sphere(3), degree=4)
    >>> rholm.files.write_coefficients(s, "body.gfc")
    >>> rholm.load("body.gfc").degree
    4
    """
    if Path(path).suffix.lower() in (".h5", ".hdf5") and options.get("format") is None:
        raise UnsupportedError(f"{os.fspath(path)}: model files are written by write_model(), or save()")
    as_expansion(expansion).save(path, **options)


@public
def is_model_file(path: str | os.PathLike[str]) -> bool:
    """Returns True for a model file, by its first bytes.

    Parameters
    ----------
    path : path
        Any file.

    Examples
    --------
    >>> rholm.icosphere(1).save("ball.ply")
    >>> rholm.files.is_model_file("ball.ply")
    False
    """
    return _core.is_model_file(os.fspath(path))


@public
def read_atlas(path: str | os.PathLike[str]) -> Atlas:
    """Reads a model file of an atlas.

    Parameters
    ----------
    path : path
        HDF5 file; layout in docs/model-file.md.

    Examples
    --------
    >>> rholm.load("ring.h5").save("copy.h5")
    >>> len(rholm.files.read_atlas("copy.h5")) == len(rholm.load("ring.h5"))
    True
    """
    with caller(0, False) as how:
        return Atlas._of(_core.read_atlas(os.fspath(path), how), name=name_of(path))


@public
def write_atlas(atlas: Atlas, path: str | os.PathLike[str]) -> None:
    """Writes a model file of an atlas.

    Parameters
    ----------
    atlas : Atlas
        Atlas to write.
    path : path
        File to write; an existing file is replaced when the new one is complete.

    Examples
    --------
    >>> rholm.files.write_atlas(rholm.load("ring.h5"), "copy.h5")
    >>> rholm.files.is_atlas_file("copy.h5")
    True
    """
    as_atlas(atlas).save(path)


@public
def is_atlas_file(path: str | os.PathLike[str]) -> bool:
    """Returns True for a model file that holds an atlas.

    Parameters
    ----------
    path : path
        Any file.

    Examples
    --------
    >>> rholm.expand(rholm.bumpy_sphere(3), degree=4).save("body.h5")
    >>> rholm.files.is_atlas_file("body.h5")
    False
    """
    return _core.is_atlas_file(os.fspath(path))


@public
def write_file(path: str | os.PathLike[str], data: bytes) -> None:
    """Writes bytes to a temporary file that replaces `path` when complete.

    Parameters
    ----------
    path : path
        File to write.
    data : bytes
        Content of the file.

    Examples
    --------
    >>> rholm.files.write_file("notes.txt", b"measured twice")
    >>> open("notes.txt").read()
    'measured twice'
    """
    _core.write_file(os.fspath(path), bytes(data))
