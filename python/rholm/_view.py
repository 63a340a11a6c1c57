"""Interactive views of expansions in notebooks and pages."""

from __future__ import annotations

import functools
from pathlib import Path
from typing import Any

from . import _core
from ._arguments import public
from ._convert import MeshLike, outward_mesh
from ._errors import InvalidInputError, UnsupportedError
from ._expand import as_expansion, expand
from ._expansion import Expansion
from ._interop import required
from ._run import Progress, caller

_DEGREE = 64  # chosen: fine enough to recognise the shape, and fast
_VIEWER = Path(__file__).with_name("viewer.js")


def viewer_script() -> str:
    """Returns the JavaScript that draws the data of `view_data`."""
    try:
        return _VIEWER.read_text(encoding="utf-8")
    except FileNotFoundError:
        raise UnsupportedError(
            "this package was built without the viewer: run scripts/studio before it is built"
        ) from None


@functools.cache
def _widget() -> Any:
    """Returns the class of widgets; anywidget is imported at the first call."""
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


@public
def view_data(
    model: MeshLike | Expansion,
    *,
    shape: Any = None,
    title: str = "",
    threads: int = 0,
    progress: Progress = None,
) -> bytes:
    """Returns the data of the viewer for an expansion; docs/studio.md describes them.

    Parameters
    ----------
    model : Expansion or mesh-like
        Model to show. A mesh is first expanded to degree 64.
    shape : mesh-like, optional
        Mesh of the expansion. By default the mesh of `expand`, if known. A mesh of more than 200
        000 faces is simplified.
    title : str
        Text above the surface; by default the name of the file.
    threads, progress
        See ``help(rholm)``.

    Returns
    -------
    bytes
        Coefficients to degree 512, errors of degrees, and the shape.

    Examples
    --------
    >>> type(rholm.figures.view_data(rholm.expand(rholm.bumpy_sphere(3), degree=4)))
    <class 'bytes'>
    """
    expansion = _expanded(model)
    known = expansion._shape if shape is None else shape
    mesh = None if known is None else outward_mesh(known)._core
    with caller(threads, progress) as how:
        data: bytes = _core.view_data(expansion._core, mesh, title or expansion._name, how)
    return data


@public
def view(
    model: MeshLike | Expansion,
    *others: MeshLike | Expansion,
    shape: Any = None,
    title: str = "",
    threads: int = 0,
    progress: Progress = None,
) -> Any:
    """Shows the surface of an expansion in a notebook; several surfaces stand side by side. Users
    can turn it and truncate it at any degree.

    A slider sets the degree. Colours show the radius or the truncation error. The spectrum stands
    beside the surface, and also the shape of the expansion if known. The browser itself sums the
    series: a notebook saved with its widgets works without Python.

    Parameters
    ----------
    model, shape, title, threads, progress
        See `view_data`.
    *others : Expansion or mesh-like
        Further models. `shape` and `title` are for a single model only.

    Returns
    -------
    anywidget.AnyWidget
        ``data`` holds the shown data. Assign the data of another model to show it instead. For
        several models an ``ipywidgets.HBox`` has the widgets in ``children``.

    Raises
    ------
    ImportError
        Without the package anywidget: ``pip install rholm[notebook]``.
    UnsupportedError
        If the package was built without the viewer.

    Examples
    --------
    >>> shown = rholm.view(rholm.expand(rholm.bumpy_sphere(3), degree=4))
    >>> type(shown.data)
    <class 'bytes'>
    """
    widget = _widget()
    if not others:
        return widget(data=view_data(model, shape=shape, title=title, threads=threads, progress=progress))
    if shape is not None or title:
        raise InvalidInputError("shape and title are for one model: view() the others by themselves")
    views = [widget(data=view_data(one, threads=threads, progress=progress)) for one in (model, *others)]
    return required("ipywidgets", "notebook").HBox(views)
