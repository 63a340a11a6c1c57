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
    """The input is invalid: a malformed file, NaN, an open mesh, a number out of range."""

    code = "InvalidInput"


class IoError(Error, OSError):
    """The operating system could not read or write a file."""

    code = "Io"


class UnsupportedError(Error):
    """The input is well-formed, but of a variant that is not supported."""

    code = "Unsupported"


class NotStarShapedError(InvalidInputError):
    """The surface is not star-shaped from the given centre, or from any centre."""

    code = "NotStarShaped"


class OutOfMemoryError(Error, MemoryError):
    """The task needs more memory than is allowed."""

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
