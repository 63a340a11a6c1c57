"""Arguments of functions from the lists of the library's options: names, defaults and documentation."""

from __future__ import annotations

import inspect
import textwrap
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

from . import _core
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


def annotation(field: dict[str, Any]) -> str:
    """The type of an argument, as it is written in Python."""
    kind = field["kind"].removeprefix("optional ")
    text = {
        "bool": "bool",
        "whole number": "int",
        "number": "float",
        "point": "npt.ArrayLike",
        "text": "str",
        "path": "str | os.PathLike[str]",
        "options": "Any",
    }.get(kind)
    if text is None:
        text = "Literal[" + ", ".join(f'"{name}"' for name in field["choices"]) + "]"
    optional = field["kind"] != kind and kind != "options"
    return text + " | None" if optional else text


def _documentation(field: dict[str, Any]) -> str:
    """The entry of an argument in a docstring."""
    kind = field["kind"].removeprefix("optional ")
    text = {
        "whole number": "int",
        "number": "float",
        "point": "array_like, (3,)",
        "text": "str",
        "path": "path",
        "options": '"auto", int or dict',
    }.get(kind, kind)
    if field["choices"]:
        text = "{" + ", ".join(f'"{name}"' for name in field["choices"]) + "}"
    if field["kind"] != kind:
        text += ", optional"
    unit = {"length": " In the unit of the shape.", "bytes": " In bytes."}.get(field["unit"], "")
    help_text = field["help"][0].upper() + field["help"][1:] + "." + unit
    return f"{field['name']} : {text}\n" + textwrap.indent("\n".join(textwrap.wrap(help_text, 90)), "    ")


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
                default=None if field["kind"].startswith("optional ") else field["default"],
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


def keywords_module() -> str:
    """The text of ``_keywords.py``, which type checkers read: scripts/python-stub writes it."""
    kinds = [kind for kind in vars(_core).values() if hasattr(kind, "FIELDS")]
    text = '''"""Keywords of functions, from the lists of the library; written by scripts/python-stub."""

from __future__ import annotations

import os
from typing import Any, Literal, TypedDict

import numpy.typing as npt
'''
    for kind in kinds:
        text += f"\n\nclass {kind.__name__.removesuffix('Options')}Keywords(TypedDict, total=False):\n"
        text += f'    """{kind.__doc__}"""\n\n'
        text += "".join(f"    {field['name']}: {annotation(field)}\n" for field in kind.FIELDS)
    return text
