"""Checks the arguments of public functions by their type annotations. A message names the argument,
its value and what it must be.
"""

from __future__ import annotations

import difflib
import functools
import inspect
import operator
import os
import sys
import types
import typing
from collections.abc import Callable, Iterator, Sequence
from typing import Any, Literal, TypeVar, Union

import numpy as np

from ._errors import InvalidInputError

Check = Callable[[Any, str], Any]
Thing = TypeVar("Thing")

_LONGEST = 60  # Letters of a value that a message shows. Chosen: the message stays on one line.


def _refusal(value: Any, name: str, wanted: str, kind: type[Exception] = TypeError) -> Exception:
    shown = repr(value)
    if len(shown) > _LONGEST or "\n" in shown:
        shown = f"of the type {type(value).__name__}"
    elif value is not None and not isinstance(value, (bool, int, float)):
        shown = f"{shown} ({type(value).__name__})"
    return kind(f"{name} is {shown}; it must be {wanted}")


def _plain(value: Any) -> Any:
    """Returns the number in an array without dimensions, and any other value unchanged."""
    return value.item() if isinstance(value, np.ndarray) and value.ndim == 0 else value


def whole(value: Any, name: str) -> int:
    """Returns a whole number. It accepts 8.0 and refuses True."""
    number = _plain(value)
    if not isinstance(number, (bool, np.bool_, str, bytes)):
        try:
            return operator.index(number)
        except TypeError:
            pass
        try:
            if int(number) == number:
                return int(number)
        except (TypeError, ValueError, OverflowError):
            pass
    raise _refusal(value, name, "a whole number")


def number(value: Any, name: str) -> float:
    """Returns a real number. It refuses True and texts."""
    plain = _plain(value)
    if not isinstance(plain, (bool, np.bool_, str, bytes, bytearray)):
        try:
            return float(plain)
        except (TypeError, ValueError):
            pass
        except OverflowError:
            raise _refusal(value, name, "a number below 1.8e308", InvalidInputError) from None
    raise _refusal(value, name, "a number")


def flag(value: Any, name: str) -> bool:
    """Returns True or False. It accepts 0 and 1 as well."""
    plain = _plain(value)
    if isinstance(plain, (bool, np.bool_)) or (isinstance(plain, (int, np.integer)) and plain in (0, 1)):
        return bool(plain)
    raise _refusal(value, name, "True or False")


def text(value: Any, name: str) -> str:
    """Returns a text."""
    if isinstance(value, str):
        return value
    raise _refusal(value, name, "a text")


def path(value: Any, name: str) -> Any:
    """Returns a path as given; a path of bytes becomes a text."""
    if isinstance(value, bytes):
        return os.fsdecode(value)
    if isinstance(value, (str, os.PathLike)):
        return value
    raise _refusal(value, name, "a path")


def octets(value: Any, name: str) -> bytes:
    """Returns bytes."""
    if isinstance(value, (bytes, bytearray, memoryview)):
        return bytes(value)
    raise _refusal(value, name, "bytes")


def _choice(choices: tuple[Any, ...]) -> Check:
    listed = ", ".join(map(repr, choices[:-1])) + (" or " if len(choices) > 1 else "") + repr(choices[-1])

    def check(value: Any, name: str) -> Any:
        if any(isinstance(value, type(choice)) and value == choice for choice in choices):
            return value
        near = difflib.get_close_matches(value, choices, 1) if isinstance(value, str) else []
        meant = f"; did you mean {near[0]!r}?" if near else ""
        kind = InvalidInputError if isinstance(value, str) else TypeError
        raise _refusal(value, name, listed + meant, kind)

    return check


def _optional(check: Check) -> Check:
    return lambda value, name: None if value is None else check(value, name)


def _several(checks: tuple[Check, ...]) -> Check:
    n = len(checks)

    def check(value: Any, name: str) -> tuple[Any, ...]:
        if isinstance(value, (str, bytes)) or not hasattr(value, "__len__") or len(value) != n:
            raise _refusal(value, name, f"{n} values, ({', '.join(['...'] * n)})")
        return tuple(one(v, f"{name}[{i}]") for i, (one, v) in enumerate(zip(checks, value, strict=True)))

    return check


def _list(check: Check) -> Check:
    def checked(value: Any, name: str) -> list[Any]:
        if isinstance(value, (str, bytes)) or not hasattr(value, "__iter__"):
            raise _refusal(value, name, "a list")
        return [check(v, f"{name}[{i}]") for i, v in enumerate(value)]

    return checked


def _with_article(kind: type) -> str:
    name = kind.__name__
    return f"{'an' if name[0] in 'AEIO' else 'a'} {name}"


def _instance(kinds: tuple[type, ...]) -> Check:
    names = " or ".join(_with_article(kind) for kind in kinds)

    def check(value: Any, name: str) -> Any:
        if isinstance(value, kinds):
            return value
        raise _refusal(value, name, names)

    return check


#: Annotations of arguments that are converted, with what they must be.
_FORMS: list[tuple[frozenset[Any], Check]] = []


def form(annotation: Any, wanted: str) -> None:
    """Declares a union of types that the package converts. Numbers and None are refused by the name of
    the argument; the conversion refuses everything else.

    Parameters
    ----------
    annotation : union of types
        Annotation of arguments.
    wanted : str
        The condition on an argument.
    """

    def check(value: Any, name: str) -> Any:
        if value is None or isinstance(value, (bool, int, float, complex, np.number, bytes)):
            raise _refusal(value, name, wanted)
        return value

    _FORMS.append((frozenset(typing.get_args(annotation)), check))


_SIMPLE: dict[Any, Check] = {int: whole, float: number, bool: flag, str: text, bytes: octets}


#: Classes that functions take in more than one form, with the functions that make them.
_MADE_BY = {
    "Atlas": "compress() and load() make one",
    "Expansion": "expand(), load() and from_array() make one",
    "Mesh": "",
    "Panel": "",
    "PointCloud": "",
    "StarChart": "make_star_chart() makes one",
}


def _model(*kinds: type) -> Check:
    """Returns a check that refuses values of Python and NumPy; functions check objects of packages."""
    wanted = " or ".join(_with_article(kind) for kind in kinds)
    made = ", ".join(_MADE_BY[kind.__name__] for kind in kinds)

    def check(value: Any, name: str) -> Any:
        if type(value).__module__ in ("builtins", "numpy", "pathlib"):
            raise _refusal(value, name, f"{wanted}; {made}")
        return value

    return check


def _is_ours(kind: Any) -> bool:
    # Functions that convert things to expansions and atlases have their own messages.
    return inspect.isclass(kind) and kind.__module__.startswith("rholm.") and kind.__name__ not in _MADE_BY


def check_of(annotation: Any) -> Check | None:
    """Returns the check for an argument of this type; None if the function itself checks it."""
    if annotation in (str | os.PathLike, Union[str, os.PathLike], os.PathLike):
        return path
    if isinstance(annotation, type) and annotation in _SIMPLE:
        return _SIMPLE[annotation]
    origin, parts = typing.get_origin(annotation), typing.get_args(annotation)
    if origin is Literal:
        return _choice(parts)
    if origin in (Union, types.UnionType):
        return _check_of_union(parts)
    if origin is tuple and Ellipsis not in parts:
        checks = tuple(check_of(part) for part in parts)
        return None if None in checks else _several(typing.cast("tuple[Check, ...]", checks))
    if origin is Sequence or annotation is Sequence:
        check = check_of(parts[0])
        return None if check is None else _list(check)
    if inspect.isclass(annotation) and annotation.__module__.startswith("rholm."):
        if _MADE_BY.get(annotation.__name__):
            return _model(annotation)
        return _instance((annotation,)) if _is_ours(annotation) else None
    return None


def _check_of_union(parts: tuple[Any, ...]) -> Check | None:
    kinds = tuple(part for part in parts if part is not type(None))
    for known, converted in _FORMS:
        if known <= set(parts):
            return converted if len(kinds) == len(parts) else _optional(converted)
    plain = {typing.get_origin(kind) or kind for kind in kinds}
    if plain == {str, os.PathLike}:
        check: Check | None = path
    elif all(_MADE_BY.get(getattr(kind, "__name__", "")) for kind in kinds):
        check = _model(*kinds)
    elif all(_is_ours(kind) for kind in kinds):
        check = _instance(kinds)
    else:
        check = check_of(kinds[0]) if len(kinds) == 1 else None
    if check is None or len(kinds) == len(parts):
        return check
    return _optional(check)


def _names() -> dict[str, Any]:
    """Returns everything that the loaded modules of the package define. Some modules import a type
    for type checkers only, so that its name must be found elsewhere.
    """
    modules = [m for name, m in list(sys.modules.items()) if name.startswith(f"{__package__}._")]
    return {name: value for module in modules for name, value in vars(module).items()}


def _checks_of(function: Callable[..., Any]) -> tuple[list[tuple[str, Check | None]], dict[str, Check]]:
    """Returns the checks of arguments by position and by name."""
    positional: list[tuple[str, Check | None]] = []
    named: dict[str, Check] = {}
    for parameter in inspect.signature(function).parameters.values():
        if parameter.kind in (parameter.VAR_POSITIONAL, parameter.VAR_KEYWORD):
            continue
        annotation = parameter.annotation
        try:
            if isinstance(annotation, str):
                annotation = eval(annotation, _names(), getattr(function, "__globals__", {}))
            check = check_of(annotation)
        except NameError:  # a type of another package, imported for type checkers only
            check = None
        if check is not None and parameter.default is None:
            check = _optional(check)
        if parameter.kind is not parameter.KEYWORD_ONLY:
            positional.append((parameter.name, check))
        if check is not None:
            named[parameter.name] = check
    return positional, named


def _out_of_range(values: dict[str, Any]) -> Iterator[str]:
    for name, value in values.items():
        if isinstance(value, int) and not 0 <= value < 2**31:
            yield f"{name} is {value}"


def checked(function: Callable[..., Any], setter_of: str = "") -> Callable[..., Any]:
    """Returns the function with its arguments checked by their annotations.

    Parameters
    ----------
    function : callable
        A function of the package.
    setter_of : str
        Name of the property that the function sets, if it is a setter.
    """
    checks: tuple[Any, ...] | None = None
    title = setter_of or f"{function.__qualname__.removesuffix('.__init__')}()"

    @functools.wraps(function)
    def call(*args: Any, **kwargs: Any) -> Any:
        nonlocal checks
        if checks is None:  # at the first call, so that the package is imported fast
            checks = _checks_of(function)  # two threads may do this: the results are equal
        positional, named = checks
        taken = list(args)
        for i, ((name, check), value) in enumerate(zip(positional, args, strict=False)):
            if check is not None:
                taken[i] = check(value, title if setter_of else f"{title}: {name}")
        for name in kwargs:
            if name in named:
                kwargs[name] = named[name](kwargs[name], f"{title}: {name}")
        try:
            return function(*taken, **kwargs)
        except TypeError as error:
            if "incompatible function arguments" not in str(error):
                raise
            # The types are right at this point. The library refuses numbers out of its range.
            values = dict(zip((name for name, _ in positional), taken, strict=False)) | kwargs
            wrong = ", ".join(_out_of_range(values)) or "an argument is of the wrong type"
            raise InvalidInputError(f"{title}: {wrong}, which is out of range") from None

    return call


def _checked_class(kind: type) -> None:
    for name, member in list(vars(kind).items()):
        if isinstance(member, types.FunctionType) and (
            not name.startswith("_") or name in ("__init__", "__call__")
        ):
            setattr(kind, name, checked(member))
        elif isinstance(member, property) and member.fset is not None and not name.startswith("_"):
            setter = checked(member.fset, f"{kind.__name__}.{name}")
            setattr(kind, name, property(member.fget, setter, member.fdel, member.__doc__))


def public(thing: Thing) -> Thing:
    """Checks the arguments of a function, or of the methods of a class, whenever they are called.

    Parameters
    ----------
    thing : function or class
        Function or class that users call. It is used as a decorator.
    """
    if inspect.isclass(thing):
        _checked_class(thing)
        return thing
    return typing.cast(Thing, checked(typing.cast("Callable[..., Any]", thing)))
