"""What the package makes of the library's tables; `_tables.pyi` has it for type checkers."""

from __future__ import annotations

from typing import Any, Literal

from . import _core

#: The name of a filter window; see `low_pass`.
Window = Literal[tuple(row["name"] for row in _core.windows())]


class Described:
    """What has each descriptor as a property: the figure that its `measure()` gives."""

    __slots__ = ()


def _property_of(row: dict[str, Any]) -> property:
    name = row["name"]
    return property(lambda self: getattr(self.measure(), name), doc=row["doc"])


for _row in _core.descriptors():
    setattr(Described, _row["name"], _property_of(_row))
