"""File formats, taken from the library's tables."""

from __future__ import annotations

from typing import NamedTuple

from . import _core
from ._arguments import public


class FileFormat(NamedTuple):
    """A file format."""

    name: str
    """The name that arguments take: "ply"."""
    title: str
    """The name for people: "PLY"."""
    extensions: tuple[str, ...]
    """Extensions of its files, without dot; a new file gets the first."""
    text: bool
    """True if text files are read or written."""
    binary: bool
    """True if binary files are read or written."""
    read: bool
    """True if files of the format can be read."""
    written: bool
    """True if files of the format can be written."""
    holds: tuple[str, ...]
    """Contents of its files, as words: "faces", "points", "normals", "meaning", ..."""
    help: str
    """Description of the format, in one sentence."""


@public
def shape_formats() -> tuple[FileFormat, ...]:
    """Returns the formats of meshes and points.

    Examples
    --------
    >>> [f.name for f in rholm.files.shape_formats() if "ply" in f.extensions]
    ['ply']
    """
    return tuple(FileFormat(*line) for line in _core.shape_formats())


@public
def coefficients_formats() -> tuple[FileFormat, ...]:
    """Returns the formats of coefficients, first the model file.

    Examples
    --------
    >>> rholm.files.coefficients_formats()[0].extensions[0]
    'h5'
    """
    return tuple(FileFormat(*line) for line in _core.coefficients_formats())
