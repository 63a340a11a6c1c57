"""Threads and progress of computations."""

from __future__ import annotations

import os
import sys
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from . import _core
from ._errors import InvalidInputError, UnsupportedError

#: A callable f(stage, fraction), True for a bar, False for none, None for a bar on terminals.
Progress = Callable[[str, float], Any] | bool | None

os.register_at_fork(after_in_child=_core.after_fork_in_child)

_BAR_DELAY = 0.5  # seconds; chosen: a shorter computation needs no bar


def _in_notebook() -> bool:
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython is not None else None
    return shell is not None and type(shell).__name__ == "ZMQInteractiveShell"


def _bar_is_seen() -> bool:
    stream = sys.stderr
    return _in_notebook() or (stream is not None and hasattr(stream, "isatty") and stream.isatty())


class _Bar:
    """A tqdm bar that shows the stages of one computation one after the other."""

    def __init__(self) -> None:
        from tqdm.auto import tqdm

        self._tqdm = tqdm
        self._bar: Any = None
        self._stage = ""

    def __call__(self, stage: str, fraction: float) -> None:
        if self._bar is None:
            form = "{desc:<14} {percentage:3.0f} %|{bar}| {elapsed}"
            self._bar = self._tqdm(total=1.0, leave=False, bar_format=form, delay=_BAR_DELAY)
        if stage != self._stage:
            self._stage = stage
            self._bar.set_description_str(stage, refresh=False)
        self._bar.n = min(max(fraction, 0.0), 1.0)
        self._bar.update(0)

    def close(self, done: bool) -> None:
        if self._bar is None:
            return
        if done:  # the last step is not reported; a bar that is not full would look like a failure
            self._bar.n = self._bar.total
        self._bar.close()


def named(path: str | os.PathLike[str], endings: tuple[str, ...], what: str) -> str:
    """Returns the path of a file. Raises UnsupportedError if its extension names another format."""
    name = os.fspath(path)
    ending = os.path.splitext(name)[1].lower()
    if ending[1:2].isalpha() and ending not in endings:
        raise UnsupportedError(
            f"{name}: {what} is written as *{endings[0]}, so its name must not end in {ending}"
        )
    return name


@contextmanager
def reporter(progress: Progress) -> Iterator[Any]:
    """Yields the function to call for a Progress: a callable f(stage, fraction), or None."""
    bar: _Bar | None = None
    if progress is True or (progress is None and _bar_is_seen()):
        bar = _Bar()
    elif progress is not None and progress is not False and not callable(progress):
        raise TypeError(f"progress is a callable, a bool or None, not {progress!r}")
    done = False
    try:
        yield bar if bar is not None else (progress if callable(progress) else None)
        done = True
    finally:
        if bar is not None:
            bar.close(done)


@contextmanager
def caller(threads: int = 0, progress: Progress = None) -> Iterator[_core.Caller]:
    """Yields threads and progress for one call of the library.

    Parameters
    ----------
    threads : int
        Number of worker threads; 0 means one per processor. Results are the same for any number.
    progress : callable, bool or None
        Called as ``f(stage, fraction)`` on the calling thread, at most about 50 times a second. If
        it returns False the computation stops (`CancelledError`). True shows a tqdm bar. None shows
        a bar if standard error is a terminal, and in notebooks.
    """
    if not isinstance(threads, int) or threads < 0:
        raise InvalidInputError(f"threads is a whole number from 0 on, not {threads!r}")
    with reporter(progress) as report:
        yield _core.Caller(threads, report)


def warn(text: str, kind: type[Warning] = UserWarning) -> None:
    """Warns the caller of the package: the warning points to the first frame outside of it.

    Parameters
    ----------
    text : str
        One sentence.
    kind : type of warning
        Category of the warning.
    """
    frame, depth = sys._getframe(1), 2
    while frame.f_back is not None and frame.f_globals.get("__name__", "").startswith("rholm"):
        frame, depth = frame.f_back, depth + 1
    warnings.warn(text, kind, stacklevel=depth)


def renamed(old: str, new: str) -> None:
    """Warns the caller of the package of a name that the next version does not have.

    Parameters
    ----------
    old, new : str
        The name that was used, and the name that replaces it.
    """
    warn(f"{old} is {new} now; the next version removes the old name", DeprecationWarning)


#: Fields of results that were called triangles in the previous version, by their class.
_FIELDS_OF_FACES = {
    _core.Expanded: ["collapsed_faces"],
    _core.FastReport: ["lumped_faces"],
    _core.Inspection: ["faces", "degenerate_faces", "duplicate_faces"],
    _core.ReconstructReport: ["faces"],
    _core.RepairReport: [
        *("collapsed_faces", "duplicate_faces", "degenerate_faces", "flipped_faces", "hole_faces")
    ],
    _core.StarReport: ["bad_faces"],
}


def _old_field(kind: type, new: str) -> None:
    old = new.replace("faces", "triangles")

    def value(self: Any) -> Any:
        renamed(f"{kind.__name__}.{old}", f"{kind.__name__}.{new}")
        return getattr(self, new)

    setattr(kind, old, property(value, doc=f"Old name of `{new}`."))


for _kind, _names in _FIELDS_OF_FACES.items():
    for _name in _names:
        _old_field(_kind, _name)
