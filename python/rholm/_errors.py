"""Exceptions, one for each error code of the library."""

from __future__ import annotations


class Error(Exception):
    """An error of the library. The text tells the value, the limit and what to do next.

    Attributes
    ----------
    code : str
        Name of the kind of error in the library: "InvalidInput" for `InvalidInputError`.
    """

    code = "Error"


class InvalidInputError(Error, ValueError):
    """The data cannot mean what was asked: a malformed file, NaN, an open mesh, a number out of range."""

    code = "InvalidInput"


class IoError(Error, OSError):
    """The operating system refused to read or write."""

    code = "Io"


class UnsupportedError(Error):
    """Well-formed, but a variant that is not handled."""

    code = "Unsupported"


class NotStarShapedError(InvalidInputError):
    """The surface is not star-shaped from any, or the given, centre."""

    code = "NotStarShaped"


class OutOfMemoryError(Error, MemoryError):
    """More memory than allowed would be needed."""

    code = "OutOfMemory"


class NotConvergedError(Error, ArithmeticError):
    """A tolerance was not reached within the limits."""

    code = "NotConverged"


class CancelledError(Error):
    """The progress callback asked to stop."""

    code = "Cancelled"


#: Exception classes by the library's error codes.
BY_CODE = {
    kind.code: kind
    for kind in (
        InvalidInputError,
        IoError,
        UnsupportedError,
        NotStarShapedError,
        OutOfMemoryError,
        NotConvergedError,
        CancelledError,
    )
}
