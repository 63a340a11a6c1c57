"""Makes keyword arguments of functions from the library's lists of options: names, defaults, texts."""

from __future__ import annotations

import inspect
import textwrap
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

from . import _core
from ._arguments import whole
from ._arrays import triple
from ._errors import InvalidInputError
from ._run import renamed

_Function = TypeVar("_Function", bound=Callable[..., Any])
#: Placeholder for the documentation of the options in the docstring of a function.
_PLACE = "{options}"


def simplify_options(simplify: Any) -> _core.SimplifyOptions | None:
    """Returns when to stop, for None, "auto", a number of faces (1 or more), or a dict of options."""
    if simplify is None or simplify is False:
        return None
    if simplify is True or simplify == "auto":
        return _core.SimplifyOptions()
    if isinstance(simplify, dict):
        named = {str(name): value for name, value in simplify.items()}
        if "triangles" in named:
            renamed("simplify={'triangles': ...}", "simplify={'faces': ...}")
            named["faces"] = named.pop("triangles")
        return _core.SimplifyOptions(**named)
    if isinstance(simplify, str):
        raise InvalidInputError(f"simplify is {simplify!r}; it must be 'auto', a number of faces or a dict")
    return _core.SimplifyOptions(faces=whole(simplify, "simplify"))


def _converted(field: dict[str, Any], value: Any) -> Any:
    """Returns a value in the form that the library takes; None stands for the default."""
    kind = field["kind"].removeprefix("optional ")
    if value is None:
        return None
    if kind == "point":
        return triple(value, field["name"])
    if kind == "path":
        return Path(value)
    if kind == "texts":
        return list(value)
    if kind == "options":
        return simplify_options(value)
    return value


def keywords_of(kind: Any) -> list[dict[str, Any]]:
    """Returns the fields of a class of options that are keyword arguments of functions."""
    return [field for field in kind.FIELDS if field["keyword"]]


def options_of(kind: Any, given: dict[str, Any], function: str, **own: Any) -> Any:
    """Returns options of a class, made from the keyword arguments of a function. `own` are fields
    that the function sets in another way. Raises TypeError for an unknown argument.
    """
    keywords = [field["name"] for field in keywords_of(kind)]
    for name in given:
        if name not in keywords:
            raise TypeError(f"{function}() got an unexpected keyword argument {name!r}")
    fields = {field["name"]: field for field in kind.FIELDS}
    return kind(**{name: _converted(fields[name], value) for name, value in {**given, **own}.items()})


def given_of(*kinds: Any, given: dict[str, Any], function: str) -> list[dict[str, Any]]:
    """Splits the keyword arguments of a function by class of options. Raises TypeError for others."""
    parts = []
    for kind in kinds:
        names = [field["name"] for field in keywords_of(kind) if field["name"] in given]
        parts.append({name: given.pop(name) for name in names})
    for name in given:
        raise TypeError(f"{function}() got an unexpected keyword argument {name!r}")
    return parts


#: Type of an argument for each kind of field, in annotations and in docstrings.
_TYPES = {
    "bool": ("bool", "bool"),
    "whole number": ("int", "int"),
    "number": ("float", "float"),
    "point": ("npt.ArrayLike", "array_like, (3,)"),
    "text": ("str", "str"),
    "texts": ("Sequence[str]", "sequence of str"),
    "path": ("str | os.PathLike[str]", "path"),
    "options": ("Any", '"auto", int or dict'),
}


def _may_be_none(field: dict[str, Any]) -> bool:
    """Returns True if None stands for no value; None also stands for an empty path."""
    kind: str = field["kind"]
    return kind.startswith("optional ") or kind == "path"


def _types(field: dict[str, Any]) -> tuple[str, str]:
    """Returns the type of an argument for its annotation and for docstrings."""
    kind = field["kind"].removeprefix("optional ")
    choices = ", ".join(f'"{name}"' for name in field["choices"])
    written, shown = (f"Literal[{choices}]", f"{{{choices}}}") if choices else _TYPES[kind]
    if _may_be_none(field):
        written += "" if written == "Any" else " | None"
        shown += ", optional"
    return written, shown


def annotation(field: dict[str, Any]) -> str:
    """Returns the type of an argument for its annotation."""
    return _types(field)[0]


def _bounds(field: dict[str, Any]) -> str:
    """Returns a sentence about the least and the largest value, if both exist."""
    if not field["bounds"]:
        return ""
    least, most = (str(int(bound)) if bound == int(bound) else repr(bound) for bound in field["bounds"])
    return f" Within {least} ... {most}" + (", or 0." if field["may_be_zero"] else ".")


def _documentation(field: dict[str, Any]) -> str:
    """Returns the entry of an argument in a docstring."""
    unit = {"length": " In the unit of the shape.", "bytes": " In bytes."}.get(field["unit"], "")
    said = field["help"][0].upper() + field["help"][1:] + "." + _bounds(field) + unit
    return f"{field['name']} : {_types(field)[1]}\n" + textwrap.indent(textwrap.fill(said, 90), "    ")


def takes(*kinds: Any) -> Callable[[_Function], _Function]:
    """Replaces ``**options`` of a function by the fields of classes of options, and documents them.

    Parameters
    ----------
    *kinds : classes of options
        Classes with a list of fields in ``FIELDS``.
    """
    fields = [field for kind in kinds for field in keywords_of(kind)]

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
            for field in fields
        ]
        parameters = [p for p in own if p not in last] + added + last
        function.__signature__ = signature.replace(parameters=parameters)  # type: ignore[attr-defined]
        text = "\n".join(_documentation(field) for field in fields)
        function.__doc__ = inspect.cleandoc(function.__doc__ or "").replace(_PLACE, text)
        return function

    return decorate
