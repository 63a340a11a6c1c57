"""Types and properties from the library's tables; `_tables.pyi` has them for type checkers."""

from __future__ import annotations

from typing import Any, Literal

from . import _core

#: Name of a filter window; see `low_pass`.
Window = Literal[tuple(row["name"] for row in _core.windows())]


class Described:
    """Base of classes with a property for each descriptor: the number of that name in `measure()`."""

    __slots__ = ()


def _property_of(row: dict[str, Any]) -> property:
    name = row["name"]
    return property(lambda self: getattr(self.measure(), name), doc=row["doc"])


for _row in _core.descriptors():
    setattr(Described, _row["name"], _property_of(_row))
