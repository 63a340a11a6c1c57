"""Arguments of functions from the lists of the library's options: names, defaults and documentation."""

from __future__ import annotations

import inspect
import textwrap
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

from ._arrays import triple
from ._topology import simplify_options

_Function = TypeVar("_Function", bound=Callable[..., Any])
#: Where the documentation of the options goes in the docstring of a function.
_PLACE = "{options}"


def _converted(field: dict[str, Any], value: Any) -> Any:
    """A value as the library takes it; None is that of the default."""
    kind = field["kind"].removeprefix("optional ")
    if value is None:
        return None
    if kind == "point":
        return triple(value, field["name"])
    if kind == "path":
        return Path(value)
    if kind == "options":
        return simplify_options(value)
    return value


def options_of(kind: Any, given: dict[str, Any], function: str) -> Any:
    """Options of that class from the keyword arguments of a function; TypeError for one it has not."""
    fields = {field["name"]: field for field in kind.FIELDS}
    for name in given:
        if name not in fields:
            raise TypeError(f"{function}() got an unexpected keyword argument {name!r}")
    return kind(**{name: _converted(fields[name], value) for name, value in given.items()})


#: Of each kind of field: the type of the argument as it is written in Python, and in docstrings.
_TYPES = {
    "bool": ("bool", "bool"),
    "whole number": ("int", "int"),
    "number": ("float", "float"),
    "point": ("npt.ArrayLike", "array_like, (3,)"),
    "text": ("str", "str"),
    "path": ("str | os.PathLike[str]", "path"),
    "options": ("Any", '"auto", int or dict'),
}


def _may_be_none(field: dict[str, Any]) -> bool:
    """Whether None stands for no value: an empty path is none."""
    kind: str = field["kind"]
    return kind.startswith("optional ") or kind == "path"


def _types(field: dict[str, Any]) -> tuple[str, str]:
    """The type of an argument as it is written in Python, and in docstrings."""
    kind = field["kind"].removeprefix("optional ")
    choices = ", ".join(f'"{name}"' for name in field["choices"])
    written, shown = (f"Literal[{choices}]", f"{{{choices}}}") if choices else _TYPES[kind]
    if _may_be_none(field):
        written += "" if written == "Any" else " | None"
        shown += ", optional"
    return written, shown


def annotation(field: dict[str, Any]) -> str:
    """The type of an argument, as it is written in Python."""
    return _types(field)[0]


def _documentation(field: dict[str, Any]) -> str:
    """The entry of an argument in a docstring."""
    unit = {"length": " In the unit of the shape.", "bytes": " In bytes."}.get(field["unit"], "")
    said = field["help"][0].upper() + field["help"][1:] + "." + unit
    return f"{field['name']} : {_types(field)[1]}\n" + textwrap.indent(textwrap.fill(said, 90), "    ")


def takes(kind: Any) -> Callable[[_Function], _Function]:
    """Shows and documents ``**options`` of a function as the arguments that a class of options has.

    Parameters
    ----------
    kind : class of options
        It has the list in ``FIELDS``.
    """

    def decorate(function: _Function) -> _Function:
        signature = inspect.signature(function)
        own = [p for p in signature.parameters.values() if p.kind is not p.VAR_KEYWORD]
        last = [p for p in own if p.name in ("threads", "progress")]
        added = [
            inspect.Parameter(
                field["name"],
                inspect.Parameter.KEYWORD_ONLY,
                default=None if _may_be_none(field) else field["default"],
                annotation=annotation(field),
            )
            for field in kind.FIELDS
        ]
        parameters = [p for p in own if p not in last] + added + last
        function.__signature__ = signature.replace(parameters=parameters)  # type: ignore[attr-defined]
        text = "\n".join(_documentation(field) for field in kind.FIELDS)
        function.__doc__ = inspect.cleandoc(function.__doc__ or "").replace(_PLACE, text)
        return function

    return decorate
