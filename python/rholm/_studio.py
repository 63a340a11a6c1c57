"""The studio in notebooks: shapes under the hand, and back in Python."""

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
from ._atlas import Atlas
from ._errors import BY_CODE, InvalidInputError, UnsupportedError
from ._expansion import Expansion
from ._interop import foreign_mesh, required
from ._model_files import load
from ._shape_files import parse_shape, write_shape
from ._shapes import Mesh, MeshLike, PointCloud, PointsLike, as_mesh, as_points, columns_text, name_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    import anywidget

_SCRIPT = Path(__file__).with_name("studio.js")
_HEIGHT = 720  # pixels; chosen: the page's panels fit
_BEAT = 10.0  # seconds: how often the page hears that Python is there (web/src/messages.ts)


def studio_script() -> str:
    """The JavaScript that shows the page of the studio."""
    try:
        return _SCRIPT.read_text(encoding="utf-8")
    except FileNotFoundError:
        raise UnsupportedError(
            "this package was built without the studio's page: run scripts/studio before it is built"
        ) from None


@functools.cache
def _widget_class() -> Any:
    """The class of widgets, once anywidget is wanted."""
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
    """A name and the bytes of a file that the studio opens."""
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
    """Tells the widget what happens in the session, until that ends."""
    listener = core.listen(session)
    while listener is not None and not listener.ended:
        events = listener.wait(_BEAT) or [("beat", "")]
        shown = widget()
        if shown is None:
            return
        for name, data in events:
            shown.send({"event": name, "data": data})


class Studio:
    """Shapes that are worked on in a page of the notebook, and the way to them from Python.

    Made by `studio`. The page and Python see the same: what `add` brings appears on the page, what is
    done on the page is there for ``studio["name"]``. Ends with `close`, with the widget, or with Python.

    Attributes
    ----------
    widget : anywidget.AnyWidget
        The page, to be put into other widgets. A notebook shows the studio itself by it.
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

    # The body of what is asked and the bytes that answer go beside the messages.
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
        """What the shapes on the page are called, oldest first."""
        return [item["name"] for item in self._state()["items"]]

    @property
    def recipe(self) -> str:
        """Lines of Python that do all that has been done on the page."""
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
            Of a path the file itself: anything that ``rholm studio`` opens, sessions among them.
        name : str
            What it is called; by default as its file.
        columns : str or sequence of str, optional
            Of the path of a text table: what its columns are, as for `read_shape`.

        Raises
        ------
        InvalidInputError, UnsupportedError, IoError
            For what cannot be read.
        """
        called, data = _file_of(shape)
        before = len(self)
        self._ask("POST", "file", data, name=called, columns=columns_text(columns))
        if name and len(self) == before + 1:
            item = self._find(-1)["id"]
            self._ask("POST", "step", json.dumps({"op": "rename", "item": item, "name": name}).encode())

    def __getitem__(self, key: str | int) -> Mesh | PointCloud | Expansion | Atlas:
        """A shape of the page as it is now, exactly: the expansion or the atlas that is known of it.

        A mesh that has not been analyzed is a mesh, points are points; `mesh` has the surface of all.

        Parameters
        ----------
        key : str or int
            Its name (of several of a name the newest) or its number, from 0 or from the end: ``studio[-1]``.
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
        """The surface that the page shows of a shape.

        Parameters
        ----------
        key : str or int
            As of ``studio[key]``.

        Raises
        ------
        InvalidInputError
            For points, which have none.
        """
        item = self._find(key)
        if item["kind"] == "points":
            raise InvalidInputError(f"{item['name']} holds points, not a mesh")
        shape = parse_shape(self._ask("GET", "save", item=str(item["id"]), format="ply"), item["name"]).shape
        return as_mesh(shape)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes a file of the session: shapes, expansions, caps and recipe, to be opened again.

        Parameters
        ----------
        path : path
            Replaced when complete.
        """
        _core.write_file(os.fspath(path), self._ask("GET", "session-file"))

    def close(self) -> None:
        """Ends it: what runs is cancelled, memory is given back. The page says that nobody answers."""
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
            return f"<rholm.Studio: {', '.join(self.names) or 'empty'}>"
        return "<rholm.Studio: closed>"

    def _repr_mimebundle_(self, **options: Any) -> Any:
        return self.widget._repr_mimebundle_(**options)


def studio(
    *shapes: MeshLike | PointsLike | Expansion | Atlas, height: int = _HEIGHT, threads: int = 0
) -> Studio:
    """The studio in a notebook: the page of ``rholm studio``, with these shapes on it.

    Shapes are looked at, analyzed, cut off at any degree, smoothed, given texture, made from points,
    aligned, blended and compressed by hand; ``studio["name"]`` has what became of them. The computing
    is done by this Python: while a cell runs the page waits.

    Parameters
    ----------
    *shapes : mesh-like, PointCloud, array (N, 3) of points, Expansion, Atlas, path
        As of `Studio.add`. Without any, the page makes one to play with.
    height : int
        Of the page, in pixels.
    threads : int
        See `rholm.caller`.

    Returns
    -------
    Studio
        Shown by the notebook if it is what a cell ends with.

    Raises
    ------
    ImportError
        Without the package anywidget: ``pip install rholm[notebook]``.
    UnsupportedError
        If this package was built without the studio's page.
    """
    opened = Studio(threads, height)
    try:
        for shape in shapes:
            opened.add(shape)
    except BaseException:
        opened.close()
        raise
    return opened
