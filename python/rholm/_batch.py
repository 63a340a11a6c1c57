"""Populations: calls a function for many shapes, and makes a table of the results."""

from __future__ import annotations

import dataclasses
import os
import queue
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sized
from concurrent.futures import BrokenExecutor, Executor, Future, ThreadPoolExecutor
from types import TracebackType
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import public
from ._arrays import read_only
from ._errors import CancelledError, InvalidInputError
from ._expansion import Expansion
from ._run import Progress, reporter

_LEADING = ("id", "path", "error", "message", "seconds", "cpu_seconds")


@public
class BatchTable:
    """Table of results from `batch` and `read_batch`.

    ``table["area"]`` is a NumPy array with a value for each row. Numbers are NaN where a value is
    missing. Booleans become numbers if a value is missing; texts are objects. Lists of numbers form
    an array of two dimensions.

    Examples
    --------
    >>> table = rholm.batch(
    ...     [rholm.box((1, 1, n)) for n in (1, 2)], lambda mesh: {"volume": mesh.volume}
    ... )
    >>> table["volume"]
    array([1., 2.])
    """

    __slots__ = ("_columns", "_core")

    def __init__(self, core: _core.BatchTable) -> None:
        self._core = core
        self._columns = {name: read_only(_array(values)) for name, values in core.columns}

    @property
    def columns(self) -> dict[str, npt.NDArray[Any]]:
        """The arrays by name, in the order of the columns."""
        return dict(self._columns)

    @property
    def failed(self) -> npt.NDArray[np.bool_]:
        """True for rows with an error: an exception, or an exit code of ``rholm batch`` other than 0."""
        if "exit_code" in self._columns:
            codes: npt.NDArray[np.bool_] = self._columns["exit_code"].astype(str) != "0"
            return codes
        errors = self._columns.get("error")
        if errors is None:
            return np.zeros(len(self), bool)
        return np.asarray(errors != "", bool)

    def __len__(self) -> int:
        return int(self._core.rows)

    def __getitem__(self, name: str) -> npt.NDArray[Any]:
        return self._columns[name]

    def __contains__(self, name: object) -> bool:
        return name in self._columns

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, BatchTable):
            return NotImplemented
        return list(self) == list(other) and all(_same(self[name], other[name]) for name in self)

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        failed = int(self.failed.sum())
        return f"BatchTable({len(self)} rows, {failed} failed, {len(self._columns)} columns)"

    def to_csv(
        self, path: str | os.PathLike[str], *, coefficients: bool = True, raw_cells: bool = False
    ) -> None:
        """Writes comma-separated values. A list of numbers takes several columns.

        Texts that spreadsheets take for formulas (they begin with =, +, -, @ and are no numbers)
        get an apostrophe in front. `read_batch` removes it.

        Parameters
        ----------
        path : path
            File name that ends in .csv. An existing file is replaced when the new one is complete.
        coefficients : bool
            False: leaves out the column ``coefficients``.
        raw_cells : bool
            True: writes all texts without an added apostrophe.

        Examples
        --------
        >>> table = rholm.batch([1, 2, 3], lambda n: n * n)
        >>> table.to_csv("squares.csv")
        >>> len(rholm.read_batch("squares.csv"))
        3
        """
        self._write(path, ".csv", coefficients, raw_cells)

    def to_hdf5(self, path: str | os.PathLike[str]) -> None:
        """Writes HDF5 with a dataset for each column; docs/batch.md describes the layout.

        Parameters
        ----------
        path : path
            File name that ends in .h5. An existing file is replaced when the new one is complete.

        Examples
        --------
        >>> table = rholm.batch([1, 2, 3], lambda n: n * n)
        >>> table.to_hdf5("squares.h5")
        >>> rholm.read_batch("squares.h5")["value"].tolist()
        [1, 4, 9]
        """
        self._write(path, ".h5", True, False)

    def to_pandas(self) -> Any:
        """Returns a ``pandas.DataFrame``. A list of numbers takes columns name.0, name.1, ...

        Examples
        --------
        >>> table = rholm.batch([1, 2, 3], lambda n: n * n, times=False)
        >>> list(table.to_pandas().columns)
        ['id', 'error', 'message', 'value']
        """
        pandas = _import("pandas", "to_pandas()")
        columns = {}
        for name, values in self._columns.items():
            if values.ndim == 1:
                columns[name] = values
            else:
                columns |= {f"{name}.{k}": values[:, k] for k in range(values.shape[1])}
        return pandas.DataFrame(columns)

    def to_parquet(self, path: str | os.PathLike[str]) -> None:
        """Writes Parquet with pyarrow. Lists of numbers stay lists.

        Parameters
        ----------
        path : path
            File to write. An existing file is overwritten.

        Examples
        --------
        >>> rholm.batch([1, 2, 3], lambda n: n * n).to_parquet("squares.parquet")
        """
        arrow = _import("pyarrow", "to_parquet()")
        parquet = _import("pyarrow.parquet", "to_parquet()")
        arrays = {}
        for name, values in self._columns.items():
            flat = arrow.array(values.ravel())
            arrays[name] = (
                flat if values.ndim == 1 else arrow.FixedSizeListArray.from_arrays(flat, values.shape[1])
            )
        parquet.write_table(arrow.table(arrays), os.fspath(path))

    def _write(
        self, path: str | os.PathLike[str], extension: str, coefficients: bool, raw_cells: bool
    ) -> None:
        name = os.fspath(path)
        if not name.endswith(extension):
            raise InvalidInputError(f"the file is called *{extension}, not {name!r}")
        self._core.write(name, coefficients, raw_cells)


@public
def read_batch(path: str | os.PathLike[str]) -> BatchTable:
    """Reads the results of ``rholm batch`` and of `BatchTable.to_hdf5`.

    Parameters
    ----------
    path : path
        HDF5 or CSV file. All values of a CSV file are texts.

    Examples
    --------
    >>> rholm.batch([rholm.icosphere(1)], lambda mesh: {"faces": len(mesh.faces)}).to_hdf5(
    ...     "table.h5"
    ... )
    >>> rholm.read_batch("table.h5")["faces"].tolist()
    [80]
    """
    return BatchTable(_core.read_batch(os.fspath(path)))


@public
def batch(
    items: Iterable[Any],
    function: Callable[[Any], Any],
    executor: Executor | None = None,
    *,
    journal: str | os.PathLike[str] | None = None,
    job: str = "",
    times: bool = True,
    in_flight: int = 1000,
    progress: Progress = None,
) -> BatchTable:
    """Calls a function for every item, and makes a table of the results with one row per item, in
    order.

    An exception fills the item's row with its type and message; other items continue.

    Parameters
    ----------
    items : iterable
        Paths or any objects, or pairs ``(id, item)`` with the id a str. Without ids, the path or
        the number of the item is used. Items are taken when needed; with a journal they are all
        taken first.
    function : callable
        Function of an item. It may return a number, text or boolean (the column ``value``). It may
        return a mapping, dataclass, named tuple or record of the library: each field is a column.
        Names of nested fields are joined by dots, and arrays of one dimension are lists. It may
        return an `Expansion`: its degree, centre, energy per degree and coefficients.
    executor : concurrent.futures.Executor, optional
        Executor that runs the function: a ProcessPoolExecutor, the executor of a dask.distributed
        client, mpi4py's MPIPoolExecutor, or another one. It must be able to send function and
        items. By default threads of this process are used, one per processor. They need to send
        nothing, and functions of the library release the interpreter's lock. For small shapes call
        these with ``threads=1``.
    journal : path, optional
        File to which finished rows are appended. A later call with the same items, function and job
        does not compute them again. The file stays until you delete it.
    job : str
        Names everything else that the rows depend on. A journal of another job is refused.
    times : bool
        True: adds the columns ``seconds`` and ``cpu_seconds``, which differ from run to run.
    in_flight : int
        Largest number of calls that wait or run at a time.
    progress : callable, bool or None
        See ``help(rholm)``; it counts items.

    Returns
    -------
    table : BatchTable
        Columns ``id``, ``path`` if items are paths, ``error``, ``message``, times, and the results.

    Examples
    --------
    >>> bodies = [rholm.box((1, 1, n)) for n in (1, 2, 3)]
    >>> table = rholm.batch(bodies, lambda mesh: {"area": mesh.area, "volume": mesh.volume})
    >>> table["volume"], table["area"]
    (array([1., 2., 3.]), array([ 6., 10., 14.]))
    """
    if in_flight < 1:
        raise InvalidInputError(f"in_flight is at least 1, not {in_flight}")
    kept = _Journal(journal, items, function, job)
    own = ThreadPoolExecutor(os.cpu_count() or 1) if executor is None else None
    rows: list[dict[str, Any]] = []
    try:
        with reporter(progress) as report:
            _run(kept, function, own or executor, in_flight, rows, report)
    finally:
        kept.close()
        if own is not None:
            own.shutdown(cancel_futures=True)
    for row in rows:
        if not times:
            row.pop("seconds", None)
            row.pop("cpu_seconds", None)
    present = {name for row in rows for name in row}
    leading = [name for name in _LEADING if name in present or name in ("id", "error", "message")]
    return BatchTable(_core.gather_batch(leading, rows))


class _Journal:
    """The items with their ids and, with a journal, the rows that are done."""

    def __init__(
        self,
        path: str | os.PathLike[str] | None,
        items: Iterable[Any],
        function: Callable[[Any], Any],
        job: str,
    ) -> None:
        self.total: int | None = len(items) if isinstance(items, Sized) else None
        self.items: Iterator[tuple[str, Any]] = _with_ids(items)
        self._core: Any = None
        if path is None:
            return
        listed = list(self.items)
        self.items, self.total = iter(listed), len(listed)
        name = f"{getattr(function, '__module__', '')}.{getattr(function, '__qualname__', type(function))}"
        self._core = _core.BatchJournal(
            os.fspath(path), ["python", _core.VERSION, name, job, *(i for i, _ in listed)], len(listed)
        )

    def read(self, row: int) -> dict[str, Any] | None:
        return self._core.read(row) if self._core is not None and self._core.has(row) else None

    def close(self) -> None:
        """Closes the file now, not only when the last traceback that refers to it is freed."""
        self._core = None

    def append(self, row: int, cells: dict[str, Any]) -> None:
        if self._core is not None:
            self._core.append(row, cells)


def _with_ids(items: Iterable[Any]) -> Iterator[tuple[str, Any]]:
    seen: set[str] = set()
    for i, item in enumerate(items):
        if isinstance(item, tuple) and len(item) == 2 and isinstance(item[0], str):
            name, thing = item
        else:
            name, thing = (os.fspath(item) if isinstance(item, (str, os.PathLike)) else str(i)), item
        if name in seen:
            raise ValueError(f"two items have the id {name!r}: give pairs (id, item) with ids of their own")
        seen.add(name)
        yield name, thing


def _run(
    kept: _Journal,
    function: Callable[[Any], Any],
    executor: Any,
    in_flight: int,
    rows: list[dict[str, Any]],
    report: Callable[[str, float], Any] | None,
) -> None:
    """Fills `rows`. The executor never has more than `in_flight` calls."""
    ended: queue.SimpleQueue[tuple[int, Future[dict[str, Any]]]] = queue.SimpleQueue()
    waiting: dict[int, Future[dict[str, Any]]] = {}
    done = failed = 0

    def take() -> None:
        nonlocal done, failed
        row, future = ended.get()
        del waiting[row]
        cells = _result_of(future)
        kept.append(row, cells)
        rows[row].update(cells)
        done += 1
        failed += bool(cells["error"])
        total = kept.total if kept.total is not None else len(rows)
        if (
            report is not None
            and report(f"{done} of {total}, {failed} failed", done / max(total, 1)) is False
        ):
            raise CancelledError("the progress callable returned False")

    try:
        for row, (name, item) in enumerate(kept.items):
            where = {"path": os.fspath(item)} if isinstance(item, (str, os.PathLike)) else {}
            rows.append({"id": name, **where})
            cells = kept.read(row)
            if cells is not None:
                rows[row].update({"error": "", "message": "", **cells})
                done += 1
                failed += bool(cells.get("error"))
                continue
            if len(waiting) >= in_flight:
                take()
            future = executor.submit(_call, function, item)
            waiting[row] = future
            future.add_done_callback(lambda f, row=row: ended.put((row, f)))
        while waiting:
            take()
    finally:
        for future in waiting.values():
            future.cancel()


def _result_of(future: Future[dict[str, Any]]) -> dict[str, Any]:
    """Returns the cells of a row. An item that cannot be sent is an error of its row; a broken
    executor is an error of the whole call.
    """
    try:
        return future.result()
    except (BrokenExecutor, KeyboardInterrupt):
        raise
    except Exception as error:
        return _error_cells(error)


def _error_cells(error: BaseException) -> dict[str, Any]:
    return {"error": type(error).__name__, "message": _text(str(error))}


class _Clock:
    """Measures wall-clock seconds and processor seconds of this thread."""

    def __enter__(self) -> _Clock:
        self._begin = time.perf_counter(), time.thread_time()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.wall = time.perf_counter() - self._begin[0]
        self.cpu = time.thread_time() - self._begin[1]


def _call(function: Callable[[Any], Any], item: Any) -> dict[str, Any]:
    """Runs in the executor: only the returned cells are sent back."""
    with _Clock() as clock:
        try:
            cells = {"error": "", "message": "", **_cells_of(function(item))}
        except Exception as error:
            cells = _error_cells(error)
    return {**cells, "seconds": clock.wall, "cpu_seconds": clock.cpu}


def _cells_of(result: Any) -> dict[str, Any]:
    cells: dict[str, Any] = {}
    fields = _fields_of(result)
    if fields is None:
        _put(cells, "value", result)
    else:
        for key, value in fields.items():
            _put(cells, str(key), value)
    for name in cells:
        if name in _LEADING:
            raise ValueError(f"the table has a column {name!r} of its own: give the value another name")
    return cells


def _fields_of(value: Any) -> Mapping[Any, Any] | None:
    """Returns the named parts of a value; None for a plain value."""
    if isinstance(value, Mapping):
        return value
    if isinstance(value, Expansion):
        return _of_expansion(value)
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return {field.name: getattr(value, field.name) for field in dataclasses.fields(value)}
    if hasattr(value, "_asdict"):
        fields: Mapping[Any, Any] = value._asdict()
        return fields
    if type(value).__module__ == _core.__name__ and hasattr(value, "to_dict"):
        record: Mapping[Any, Any] = value.to_dict()
        return record
    return None


def _of_expansion(expansion: Expansion) -> dict[str, Any]:
    cosines, sines = expansion.to_array("orthonormal")
    listed = np.zeros((expansion.degree + 1) ** 2)
    for degree in range(expansion.degree + 1):
        middle = degree * degree + degree
        listed[middle : middle + degree + 1] = cosines[degree, : degree + 1]
        listed[middle - degree : middle] = sines[degree, degree:0:-1]
    return {
        "degree": expansion.degree,
        "function": expansion.function,
        "center": expansion.center,
        "energy": _core.power_spectrum(expansion._core.coefficients),
        "coefficients": listed,
    }


def _put(cells: dict[str, Any], name: str, value: Any) -> None:
    """Adds a value, or its nested values, to the cells of a row. Raises TypeError for any other type."""
    if isinstance(value, np.generic):
        value = value.item()
    if value is None or isinstance(value, (bool, float)):
        cells[name] = value
    elif isinstance(value, int):
        cells[name] = value if -(2**63) <= value < 2**63 else float(value)
    elif isinstance(value, str):
        cells[name] = _text(value)
    elif (fields := _fields_of(value)) is not None:
        for key, inner in fields.items():
            _put(cells, f"{name}.{key}", inner)
    elif isinstance(value, (list, tuple, np.ndarray)):
        numbers = np.asarray(value)
        if numbers.size > 0 and (numbers.ndim != 1 or numbers.dtype.kind not in "biuf"):
            raise TypeError(f"{name!r} is no list of numbers, but of {numbers.dtype}, {numbers.shape}")
        cells[name] = [float(x) for x in numbers.ravel()]
    else:
        raise TypeError(f"{name!r} is of {type(value).__name__}: no number, text, list of numbers or mapping")


def _text(text: str) -> str:
    """Returns a text that UTF-8 can encode, without zeros."""
    return text.encode("utf-8", "replace").decode("utf-8").replace("\0", "\N{REPLACEMENT CHARACTER}")


def _array(values: Any) -> npt.NDArray[Any]:
    if isinstance(values, list):
        texts = np.empty(len(values), object)
        texts[:] = values
        return texts
    array = np.asarray(values)
    if array.dtype != np.int8:
        return array
    return np.where(array < 0, np.nan, array) if np.any(array < 0) else array.astype(bool)


def _same(a: npt.NDArray[Any], b: npt.NDArray[Any]) -> bool:
    """Returns True for equal arrays; missing numbers are equal."""
    return bool(np.array_equal(a, b, equal_nan=a.dtype.kind == "f" and b.dtype.kind == "f"))


def _import(name: str, use: str) -> Any:
    import importlib

    try:
        return importlib.import_module(name)
    except ImportError as error:
        package = name.split(".")[0]
        raise ImportError(f"{use} needs {package}: pip install {package}") from error
