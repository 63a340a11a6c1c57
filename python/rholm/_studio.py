"""The studio in notebooks: edits shapes in a page, and returns them to Python."""

from __future__ import annotations

import atexit
import contextlib
import functools
import json
import os
import tempfile
import threading
import weakref
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from ._arguments import public
from ._atlas import Atlas
from ._convert import MeshLike, PointsLike, as_mesh, as_points, write_shape
from ._errors import BY_CODE, InvalidInputError, UnsupportedError
from ._expansion import Expansion
from ._interop import foreign_mesh, required
from ._model_files import load
from ._shape_files import parse_shape
from ._shapes import Mesh, PointCloud, columns_text, name_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    import anywidget

_SCRIPT = Path(__file__).with_name("studio.js")
_HEIGHT = 720  # pixels; chosen: the page's panels fit
_BEAT = 10.0  # Seconds between signs of life that the page gets from Python (web/src/messages.ts).


def studio_script() -> str:
    """Returns the JavaScript that shows the page of the studio."""
    try:
        return _SCRIPT.read_text(encoding="utf-8")
    except FileNotFoundError:
        raise UnsupportedError(
            "this package was built without the studio's page: run scripts/studio before it is built"
        ) from None


@functools.cache
def _widget_class() -> Any:
    """Returns the class of widgets; anywidget is imported at the first call."""
    base = required("anywidget", "notebook").AnyWidget
    traitlets = required("traitlets", "notebook")
    members = {
        "__doc__": "The page of the studio; what it asks is answered by messages.",
        "_esm": studio_script(),
        "session": traitlets.Unicode().tag(sync=True),
        "height": traitlets.Int(_HEIGHT).tag(sync=True),
    }
    return type("StudioWidget", (base,), members)


def _is_points(thing: Any) -> bool:
    if isinstance(thing, PointCloud):
        return True
    if isinstance(thing, (Mesh, tuple, list)) or foreign_mesh(thing) is not None:
        return False
    return np.ndim(thing) == 2


def _file_of(thing: Any) -> tuple[str, bytes]:
    """Returns a name and the bytes of a file that the studio can open."""
    if isinstance(thing, (str, os.PathLike)):
        return name_of(thing), Path(thing).read_bytes()
    with tempfile.TemporaryDirectory(prefix="rholm-") as folder:
        if isinstance(thing, (Expansion, Atlas)):
            path = Path(folder, "model.h5")
            thing.save(path)
            return Path(thing._name or "shape").stem + ".h5", path.read_bytes()
        path = Path(folder, "shape.ply")
        points = _is_points(thing)
        write_shape(as_points(thing) if points else as_mesh(thing), path)
        return "points.ply" if points else "shape.ply", path.read_bytes()


def _told(core: _core.Studio, session: str, widget: weakref.ref[Any]) -> None:
    """Sends events of the session to the widget until the session ends."""
    listener = core.listen(session)
    while listener is not None and not listener.ended:
        events = listener.wait(_BEAT) or [("beat", "")]
        shown = widget()
        if shown is None:
            return
        for name, data in events:
            shown.send({"event": name, "data": data})


@public
class Studio:
    """Shapes that are edited in a page of the notebook, and their access from Python.

    `studio` makes it. The page and Python share the same shapes: `add` shows a shape on the page,
    and ``studio["name"]`` returns the result of edits. It ends with `close`, with the widget, or
    with Python.

    Attributes
    ----------
    widget : anywidget.AnyWidget
        The page, which can be put into other widgets. A notebook shows it for the studio itself.

    Examples
    --------
    >>> with rholm.studio(rholm.icosphere(2)) as page:
    ...     page.mesh()
    <rholm.Mesh: 162 vertices, 320 faces>
    """

    def __init__(self, threads: int = 0, height: int = _HEIGHT) -> None:
        kind = _widget_class()
        self._core: _core.Studio | None = _core.Studio(tempfile.gettempdir(), threads)
        self._session = self._core.offered_session()
        self.widget: anywidget.AnyWidget = kind(session=self._session, height=height)
        self.widget.on_msg(self._answer)
        self.widget.observe(self._close_with_widget, names="comm")
        self._teller = threading.Thread(
            target=_told, args=(self._core, self._session, weakref.ref(self.widget)), daemon=True
        )
        self._teller.start()
        atexit.register(self.close)

    def __reduce__(self) -> Any:
        raise TypeError("a Studio cannot be copied or pickled, as it works with a page: take its items")

    def _ask(self, method: str, path: str, body: bytes = b"", **query: str) -> bytes:
        if self._core is None:
            raise InvalidInputError("this studio has been closed")
        status, _, answer, _ = self._core.handle(method, f"api/{path}", query, body, self._session)
        if status < 400:
            return bytes(answer)
        error = json.loads(answer)["error"]
        named = error["code"].title().replace("_", "")
        raise BY_CODE.get(named, InvalidInputError)(error["message"])

    # The request's body and the response's bytes are sent as buffers beside the messages.
    def _answer(self, widget: Any, asked: dict[str, Any], buffers: list[Any]) -> None:
        if self._core is None:
            return
        body = bytes(buffers[0]) if buffers else b""
        how = asked["method"], asked["path"], asked["query"], body, asked["session"]
        status, kind, answer, _ = self._core.handle(*how)
        to = {"view": asked["view"], "id": asked["id"], "status": status, "type": kind}
        widget.send({"answer": to}, [answer])

    def _close_with_widget(self, change: Any) -> None:
        if change.new is None:
            self.close()

    def _state(self) -> dict[str, Any]:
        state: dict[str, Any] = json.loads(self._ask("GET", "state"))
        return state

    def _find(self, key: str | int) -> dict[str, Any]:
        items: list[dict[str, Any]] = self._state()["items"]
        if isinstance(key, str):
            named = [item for item in items if item["name"] == key]
            if not named:
                raise KeyError(f"no shape of the studio is called {key!r}: {[i['name'] for i in items]}")
            return named[-1]
        return items[key]

    @property
    def names(self) -> list[str]:
        """Names of the shapes on the page, oldest first."""
        return [item["name"] for item in self._state()["items"]]

    @property
    def recipe(self) -> str:
        """Lines of Python that repeat all edits of the page."""
        return str(self._state()["recipe"]["python"])

    def add(
        self,
        shape: MeshLike | PointsLike | Expansion | Atlas,
        name: str = "",
        *,
        columns: str | Sequence[str] | None = None,
    ) -> None:
        """Opens another shape on the page.

        Parameters
        ----------
        shape : mesh-like, PointCloud, array (N, 3) of points, Expansion, Atlas, path
            Shape to open. A path names any file that ``rholm studio`` opens, also a session.
        name : str
            Name of the shape; by default the name of its file.
        columns : str or sequence of str, optional
            Meaning of the columns of a text table, as in `read_shape`.

        Raises
        ------
        InvalidInputError, UnsupportedError, IoError
            For a shape or file that cannot be read.

        Examples
        --------
        >>> with rholm.studio(rholm.icosphere(2)) as page:
        ...     page.add(rholm.torus(2, 0.7, 40, 20), "ring")
        ...     page.names[-1]
        'ring'
        """
        called, data = _file_of(shape)
        before = len(self)
        self._ask("POST", "file", data, name=called, columns=columns_text(columns))
        if name and len(self) == before + 1:
            item = self._find(-1)["id"]
            self._ask("POST", "step", json.dumps({"op": "rename", "item": item, "name": name}).encode())

    def __getitem__(self, key: str | int) -> Mesh | PointCloud | Expansion | Atlas:
        """Returns the present state of a shape of the page, exactly: its expansion or atlas if it
        has one.

        A mesh without an expansion is returned as a mesh, points as points. `mesh` returns the
        surface of any shape.

        Parameters
        ----------
        key : str or int
            Name (the newest shape of that name), or index, also negative: ``studio[-1]``.
        """
        item = self._find(key)
        modelled = item["kind"] == "atlas" or item["expansion"] is not None
        data = self._ask("GET", "save", item=str(item["id"]), format="h5" if modelled else "ply")
        if not modelled:
            return parse_shape(data, item["name"]).shape
        with tempfile.TemporaryDirectory(prefix="rholm-") as folder:
            path = Path(folder, "model.h5")
            path.write_bytes(data)
            return load(path)

    def mesh(self, key: str | int = -1) -> Mesh:
        """Returns the surface that the page shows of a shape.

        Parameters
        ----------
        key : str or int
            Name or index, as in ``studio[key]``.

        Raises
        ------
        InvalidInputError
            For points, which have no surface.

        Examples
        --------
        >>> with rholm.studio(rholm.icosphere(2)) as page:
        ...     page.mesh(0)
        <rholm.Mesh: 162 vertices, 320 faces>
        """
        item = self._find(key)
        if item["kind"] == "points":
            raise InvalidInputError(f"{item['name']} holds points, not a mesh")
        shape = parse_shape(self._ask("GET", "save", item=str(item["id"]), format="ply"), item["name"]).shape
        return as_mesh(shape)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes a file of the session that can be opened again: shapes, expansions, caps and
        recipe.

        Parameters
        ----------
        path : path
            File to write; an existing file is replaced when the new one is complete.

        Examples
        --------
        >>> with rholm.studio(rholm.icosphere(2)) as page:
        ...     page.save("today.rholm")
        """
        _core.write_file(os.fspath(path), self._ask("GET", "session-file"))

    def close(self) -> None:
        """Ends the studio: cancels running work and frees memory. The page tells that Python does
        not answer.

        Examples
        --------
        >>> page = rholm.studio(rholm.icosphere(2))
        >>> page.close()
        >>> page
        <rholm.figures.Studio: closed>
        """
        if self._core is None:
            return
        self._core.close()
        atexit.unregister(self.close)
        if threading.current_thread() is not self._teller:
            self._teller.join()
        self._core = None

    def __len__(self) -> int:
        return len(self._state()["items"])

    def __enter__(self) -> Studio:
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()

    def __repr__(self) -> str:
        with contextlib.suppress(InvalidInputError):
            return f"<rholm.figures.Studio: {', '.join(self.names) or 'empty'}>"
        return "<rholm.figures.Studio: closed>"

    def _repr_mimebundle_(self, **options: Any) -> Any:
        return self.widget._repr_mimebundle_(**options)


@public
def studio(
    *shapes: MeshLike | PointsLike | Expansion | Atlas, height: int = _HEIGHT, threads: int = 0
) -> Studio:
    """Shows the studio in a notebook: the page of ``rholm studio``, with these shapes on it.

    In the page you can view, expand, truncate, smooth, texture, align, blend and compress shapes,
    and reconstruct points. ``studio["name"]`` returns the result. Python does the computing: while
    a cell runs the page waits.

    Parameters
    ----------
    *shapes : mesh-like, PointCloud, array (N, 3) of points, Expansion, Atlas, path
        Shapes as for `Studio.add`. Without shapes the page makes an example.
    height : int
        Height of the page in pixels.
    threads : int
        Number of threads; see ``help(rholm)``.

    Returns
    -------
    Studio
        The studio. The notebook shows it if it is the last value of a cell.

    Raises
    ------
    ImportError
        Without the package anywidget: ``pip install rholm[notebook]``.
    UnsupportedError
        If the package was built without the studio's page.

    Examples
    --------
    >>> with rholm.studio(rholm.icosphere(2), rholm.torus(2, 0.7, 40, 20)) as page:
    ...     len(page)
    2
    """
    opened = Studio(threads, height)
    try:
        for shape in shapes:
            opened.add(shape)
    except BaseException:
        opened.close()
        raise
    return opened
