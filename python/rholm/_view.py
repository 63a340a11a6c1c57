"""Expansions under the hand, in notebooks and pages."""

from __future__ import annotations

import functools
from pathlib import Path
from typing import Any

from . import _core
from ._encode import as_expansion, expand
from ._errors import InvalidInputError, UnsupportedError
from ._expansion import Expansion
from ._interop import required
from ._run import Progress, caller
from ._shapes import outward_mesh

_DEGREE = 64  # chosen: fine enough to be known by sight, and there at once
_VIEWER = Path(__file__).with_name("viewer.js")


def viewer_script() -> str:
    """The JavaScript that draws what `view_data` has."""
    try:
        return _VIEWER.read_text(encoding="utf-8")
    except FileNotFoundError:
        raise UnsupportedError(
            "this package was built without the viewer: run scripts/studio before it is built"
        ) from None


@functools.cache
def _widget() -> Any:
    """The class of widgets, once anywidget is wanted."""
    base = required("anywidget", "notebook").AnyWidget
    traitlets = required("traitlets", "notebook")
    members = {
        "__doc__": "A surface that can be turned, and cut off at any degree.",
        "_esm": viewer_script(),
        "data": traitlets.Bytes().tag(sync=True),
    }
    return type("View", (base,), members)


def _expanded(model: Any) -> Expansion:
    try:
        return as_expansion(model)
    except TypeError:
        return expand(model, _DEGREE)


def view_data(
    model: Any, *, shape: Any = None, title: str = "", threads: int = 0, progress: Progress = None
) -> bytes:
    """What a viewer shows of an expansion, as docs/studio.md has it.

    Parameters
    ----------
    model : Expansion or mesh-like
        What is shown; a mesh is expanded first, to degree 64.
    shape : mesh-like, optional
        The mesh that the expansion is of; by default that of `expand`, if it is known. Of more than
        200 000 faces a simpler one goes along.
    title : str
        Above it; by default the name of the file.
    threads, progress
        See `rholm.caller`.

    Returns
    -------
    bytes
        Coefficients to degree 512, errors of degrees, and the shape.
    """
    expansion = _expanded(model)
    known = expansion._shape if shape is None else shape
    mesh = None if known is None else outward_mesh(known)._core
    with caller(threads, progress) as how:
        data: bytes = _core.view_data(expansion._core, mesh, title or expansion._name, how)
    return data


def view(
    model: Any, *others: Any, shape: Any = None, title: str = "", threads: int = 0, progress: Progress = None
) -> Any:
    """The surface of an expansion in a notebook, to be turned and cut off at any degree; of several
    side by side.

    A slider goes through the degrees; colours show the radius or what is left out; the spectrum
    stands beside it, and the shape that the expansion is of, if it is known. The browser sums the
    series by itself: a notebook that was saved with its widgets goes on working without Python.

    Parameters
    ----------
    model, shape, title, threads, progress
        See `view_data`.
    *others : Expansion or mesh-like
        Shown beside it; `shape` and `title` are for one alone.

    Returns
    -------
    anywidget.AnyWidget
        ``data`` is what it shows: assign that of another model to show it instead. Of several an
        ``ipywidgets.HBox`` of these, in ``children``.

    Raises
    ------
    ImportError
        Without the package anywidget: ``pip install rholm[notebook]``.
    UnsupportedError
        If this package was built without the viewer.
    """
    widget = _widget()
    if not others:
        return widget(data=view_data(model, shape=shape, title=title, threads=threads, progress=progress))
    if shape is not None or title:
        raise InvalidInputError("shape and title are for one model: view() the others by themselves")
    views = [widget(data=view_data(one, threads=threads, progress=progress)) for one in (model, *others)]
    return required("ipywidgets", "notebook").HBox(views)
