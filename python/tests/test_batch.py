"""Populations: a row equals the function's result, wherever and however often the function runs."""

from __future__ import annotations

import csv
import dataclasses
import os
import re
import shutil
import subprocess
import sys
import textwrap
import threading
import time
from collections.abc import Iterator
from concurrent.futures import BrokenExecutor, Executor, ProcessPoolExecutor, ThreadPoolExecutor
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest
import rholm
from rholm import harmonics

ROOT = Path(__file__).resolve().parents[2]


def describe(path: str) -> dict[str, Any]:
    """Computes the row of docs/batch.md; other processes import it by its name."""
    s = rholm.expand(path, degree=4, threads=1)
    return {"volume": s.volume, "energy": harmonics.power_spectrum(s)}


def square(x: int) -> int:
    if x == 7:
        raise ValueError("seven")
    return x * x


def die(x: int) -> int:
    if x == 3:
        os._exit(1)
    return x


@pytest.fixture(scope="module")
def shapes(tmp_path_factory: pytest.TempPathFactory) -> list[str]:
    """Six star-shaped shapes, a ring, an empty file and a missing file."""
    folder = tmp_path_factory.mktemp("shapes")
    paths = []
    for seed in range(6):
        paths.append(str(folder / f"{seed}.ply"))
        rholm.bumpy_sphere(3, 0.3, seed=seed).save(paths[-1])
    rholm.torus(2, 0.7, 30, 15).save(folder / "ring.ply")
    (folder / "empty.ply").write_bytes(b"")
    return [
        *paths[:4],
        str(folder / "ring.ply"),
        str(folder / "empty.ply"),
        str(folder / "lost.ply"),
        *paths[4:],
    ]


def check_shapes(table: rholm.files.BatchTable, shapes: list[str]) -> None:
    assert list(table["id"]) == shapes
    assert list(table["error"][4:7]) == ["NotStarShapedError", "InvalidInputError", "IoError"]
    assert int(table.failed.sum()) == 3
    for row, path in enumerate(shapes):
        if table.failed[row]:
            assert table["message"][row] != ""
            assert np.isnan(table["volume"][row])
            assert np.isnan(table["energy"][row]).all()
        else:
            expected = describe(path)
            assert table["volume"][row] == expected["volume"]
            np.testing.assert_array_equal(table["energy"][row], expected["energy"])


def test_threads_are_the_default(shapes: list[str]) -> None:
    check_shapes(rholm.batch(shapes, describe), shapes)


def test_thread_pool(shapes: list[str]) -> None:
    with ThreadPoolExecutor(3) as executor:
        check_shapes(rholm.batch(shapes, describe, executor, in_flight=2), shapes)


def test_process_pool(shapes: list[str]) -> None:
    with ProcessPoolExecutor(2) as executor:
        check_shapes(rholm.batch(shapes, describe, executor), shapes)


def test_dask(shapes: list[str], tmp_path: Path) -> None:
    distributed = pytest.importorskip("distributed", reason="SKIPPED: dask.distributed is not installed")
    with (
        distributed.LocalCluster(
            n_workers=2,
            threads_per_worker=1,
            processes=True,
            dashboard_address=None,
            local_directory=str(tmp_path),
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        check_shapes(rholm.batch(shapes, describe, client.get_executor()), shapes)


def test_mpi(shapes: list[str], tmp_path: Path) -> None:
    pytest.importorskip("mpi4py", reason="SKIPPED: mpi4py is not installed")
    mpiexec = shutil.which("mpiexec")
    if mpiexec is None:
        pytest.skip("SKIPPED: there is no mpiexec: scripts/setup test installs it")
    script = tmp_path / "run.py"
    script.write_text(
        textwrap.dedent(
            f"""
            import sys
            sys.path.insert(0, {str(Path(__file__).parent)!r})
            import rholm
            from mpi4py.futures import MPIPoolExecutor
            from test_batch import check_shapes, describe

            if __name__ == "__main__":
                shapes = {shapes!r}
                with MPIPoolExecutor() as executor:
                    check_shapes(rholm.batch(shapes, describe, executor), shapes)
                    print("workers:", executor.num_workers)
            """
        )
    )
    environment = {
        **os.environ,
        "OMPI_ALLOW_RUN_AS_ROOT": "1",
        "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
        "OMPI_MCA_rmaps_base_oversubscribe": "1",
        "OMPI_MCA_btl": "self,vader",
        # Containers forbid processes to read each other's memory, and waiting ranks must yield the
        # processor.
        "OMPI_MCA_btl_vader_single_copy_mechanism": "none",
        "OMPI_MCA_mpi_yield_when_idle": "1",
        "OMPI_MCA_hwloc_base_binding_policy": "none",
    }
    ran = subprocess.run(
        [mpiexec, "-n", "3", sys.executable, "-m", "mpi4py.futures", str(script)],
        env=environment,
        capture_output=True,
        text=True,
        timeout=3000,
        check=False,
    )
    assert ran.returncode == 0, ran.stderr
    assert "workers: 2" in ran.stdout


def test_tables_of_all_executors_are_the_same_bytes(shapes: list[str], tmp_path: Path) -> None:
    with ProcessPoolExecutor(2) as executor:
        for name, where in (("threads", None), ("processes", executor)):
            table = rholm.batch(shapes, describe, where, times=False)
            table.to_hdf5(tmp_path / f"{name}.h5")
            table.to_csv(tmp_path / f"{name}.csv")
    for extension in ("h5", "csv"):
        threads, processes = (tmp_path / f"{name}.{extension}" for name in ("threads", "processes"))
        assert threads.read_bytes() == processes.read_bytes()


class Fields(NamedTuple):
    """A result."""

    a: int
    b: str


@dataclasses.dataclass
class Data:
    """A result that contains another one."""

    flag: bool
    inner: Fields
    numbers: list[float]


def test_what_a_function_may_return(bumpy: rholm.Mesh) -> None:
    s = rholm.expand(bumpy, degree=3)
    results: list[Any] = [
        3,
        2.5,
        np.float32(0.5),
        "text\0\ud800",
        True,
        None,
        Data(True, Fields(1, "x"), [1, 2]),
        {"flag": False, "numbers": np.arange(3), "inner": {"a": 2**70}},
        s,
        rholm.inspect(bumpy),
        object(),
        [[1, 2], [3, 4]],
        {"message": 1},
    ]
    table = rholm.batch(range(len(results)), results.__getitem__)
    assert list(table["id"]) == [str(i) for i in range(len(results))]
    assert list(table["value"][:5]) == ["3", "2.5", "0.5", "text\N{REPLACEMENT CHARACTER}?", "true"]
    assert list(table["inner.a"][6:8]) == [1, 2**70]
    assert table["inner.b"][6] == "x"
    assert list(table["flag"][6:8]) == [1, 0]
    np.testing.assert_array_equal(table["numbers"][6:8], [[1, 2, np.nan], [0, 1, 2]])
    assert table["area"][9] == rholm.inspect(bumpy).area
    assert list(np.nonzero(table.failed)[0]) == [10, 11, 12]
    assert list(table["error"][10:]) == ["TypeError", "TypeError", "ValueError"]
    # Parseval's identity, with coefficients in the documented order.
    c = table["coefficients"][8]
    cosines, sines = s.to_array("orthonormal")
    for degree in range(4):
        inner = c[degree**2 : (degree + 1) ** 2]
        assert inner[degree] == cosines[degree, 0]
        assert np.sum(inner**2) == pytest.approx(table["energy"][8, degree], rel=1e-14)
        for m in range(1, degree + 1):
            assert inner[degree + m] == cosines[degree, m]
            assert inner[degree - m] == sines[degree, m]


def test_ids_are_given_or_found_and_unique(tmp_path: Path) -> None:
    table = rholm.batch([("one", 1), ("two", 2)], square)
    assert list(table["id"]) == ["one", "two"]
    assert list(table["value"]) == [1, 4]
    assert table["value"].dtype == np.int64
    with pytest.raises(ValueError, match="two items have the id 'a'"):
        rholm.batch([("a", 1), ("a", 2)], square)


def test_items_are_taken_as_they_are_needed() -> None:
    started = threading.Semaphore(0)
    taken = 0

    def endless() -> Iterator[int]:
        nonlocal taken
        while True:
            taken += 1
            yield taken

    def stop(stage: str, fraction: float) -> bool:
        return not stage.startswith("50 of")

    with pytest.raises(rholm.CancelledError):
        rholm.batch(endless(), lambda x: started.release(), in_flight=5, progress=stop)
    assert taken <= 56


def test_a_journal_is_gone_on_from(tmp_path: Path) -> None:
    journal = tmp_path / "j"
    calls = []

    def count(x: int) -> int:
        calls.append(x)
        if len(calls) == 6:
            raise KeyboardInterrupt
        return square(x)

    with ThreadPoolExecutor(1) as executor, pytest.raises(KeyboardInterrupt):
        rholm.batch(range(20), count, executor, journal=journal, in_flight=1)
    assert len(calls) == 6
    table = rholm.batch(range(20), count, journal=journal)
    assert len(calls) == 6 + 15  # without the five finished items
    assert list(np.delete(table["value"], 7)) == [x * x for x in range(20) if x != 7]
    assert table["message"][7] == "seven"
    done = len(calls)
    again = rholm.batch(range(20), count, journal=journal)
    assert len(calls) == done
    for name in table:
        np.testing.assert_array_equal(again[name], table[name])
    with pytest.raises(rholm.InvalidInputError, match="another job"):
        rholm.batch(range(21), count, journal=journal)
    with pytest.raises(rholm.InvalidInputError, match="another job"):
        rholm.batch(range(20), count, journal=journal, job="other")


def test_a_broken_executor_is_no_row(tmp_path: Path) -> None:
    with ProcessPoolExecutor(1) as executor, pytest.raises(BrokenExecutor):
        rholm.batch(range(6), die, executor, journal=tmp_path / "j")
    table = rholm.batch(range(6), square, journal=tmp_path / "k")
    assert list(table["value"]) == [0, 1, 4, 9, 16, 25]


def test_what_cannot_be_sent_is_an_error_of_its_row() -> None:
    with ProcessPoolExecutor(1) as executor:
        table = rholm.batch([("a", 2), ("b", threading.Lock()), ("c", 3)], square, executor)
    assert list(table.failed) == [False, True, False]
    assert table["error"][1] == "TypeError"


def test_order_is_that_of_the_items() -> None:
    def slow_first(x: int) -> int:
        time.sleep(0.02 if x % 5 == 0 else 0)
        return x

    with ThreadPoolExecutor(8) as executor:
        assert list(rholm.batch(range(40), slow_first, executor)["value"]) == list(range(40))


def test_tables_in_files(shapes: list[str], tmp_path: Path) -> None:
    table = rholm.batch(shapes, describe)
    table.to_hdf5(tmp_path / "t.h5")
    back = rholm.read_batch(tmp_path / "t.h5")
    assert list(back) == list(table)
    for name in table:
        np.testing.assert_array_equal(back[name], table[name])
    table.to_csv(tmp_path / "t.csv")
    with open(tmp_path / "t.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [r["id"] for r in rows] == shapes
    assert [float(r["energy.3"] or "nan") for r in rows] == pytest.approx(
        list(table["energy"][:, 3]), rel=0, abs=0, nan_ok=True
    )
    for save in (table.to_csv, table.to_hdf5):
        with pytest.raises(ValueError, match="is called"):
            save(tmp_path / "t.txt")
    with pytest.raises(rholm.IoError):
        rholm.read_batch(tmp_path / "none.h5")
    pytest.importorskip("pandas", reason="SKIPPED: pandas is not installed")
    frame = table.to_pandas()
    assert frame.shape == (len(shapes), sum(1 if v.ndim == 1 else v.shape[1] for v in table.columns.values()))
    np.testing.assert_array_equal(frame["energy.2"], table["energy"][:, 2])


def test_parquet(shapes: list[str], tmp_path: Path) -> None:
    parquet = pytest.importorskip("pyarrow.parquet", reason="SKIPPED: pyarrow is not installed")
    table = rholm.batch(shapes, describe)
    table.to_parquet(tmp_path / "t.parquet")
    back = parquet.read_table(tmp_path / "t.parquet").to_pydict()
    np.testing.assert_array_equal(np.array(back["energy"], float), table["energy"])
    assert back["error"] == list(table["error"])


def test_without_pyarrow_it_says_what_to_install(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    with pytest.raises(ImportError, match="pip install pyarrow"):
        rholm.batch([1], square).to_parquet(tmp_path / "t.parquet")


def test_h5py_reads_what_the_document_says(shapes: list[str], tmp_path: Path) -> None:
    h5py = pytest.importorskip("h5py", reason="SKIPPED: h5py is not installed")
    table = rholm.batch(shapes, describe)
    table.to_hdf5(tmp_path / "t.h5")
    with h5py.File(tmp_path / "t.h5") as file:
        assert list(file["columns"].asstr()[:]) == list(table)
        np.testing.assert_array_equal(file["energy"][:], table["energy"])
        assert list(file["error"].asstr()[:]) == list(table["error"])
        assert file.attrs["rows"] == len(table)


def test_results_of_the_program(shapes: list[str], tmp_path: Path, program: Path) -> None:
    with open(tmp_path / "m.csv", "w", newline="", encoding="utf-8") as file:
        csv.writer(file).writerows([["path", "group"], *([path, "x"] for path in shapes)])
    subprocess.run(
        [program, "batch", "m.csv", "-o", "r.h5", "--", "--degree", "4"],
        cwd=tmp_path,
        check=True,
        capture_output=True,
    )
    table = rholm.read_batch(tmp_path / "r.h5")
    mine = rholm.batch(shapes, lambda path: rholm.expand(path, degree=4))
    assert list(table["path"]) == shapes
    assert list(table.failed) == list(mine.failed)
    np.testing.assert_array_equal(table["coefficients"], mine["coefficients"])
    np.testing.assert_array_equal(table["energy"], mine["energy"])
    assert list(table["group"]) == ["x"] * len(shapes)


@pytest.mark.skipif(not (ROOT / "docs").exists(), reason="the documents are not here")
def test_the_document_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    text = (ROOT / "docs" / "batch.md").read_text(encoding="utf-8")
    blocks = re.findall(r"^```python\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    block = next(block for block in blocks if "def describe" in block)
    monkeypatch.chdir(tmp_path)
    for name in ("a.ply", "b.ply"):
        rholm.bumpy_sphere(2, 0.3, seed=1).save(name)
    rholm.torus(2, 0.7, 30, 15).save("ring.ply")
    names: dict[str, Any] = {}
    exec(compile(block, "batch.md", "exec"), names)
    assert list(names["table"]["error"]) == ["", "", "NotStarShapedError", "IoError"]
    assert (tmp_path / "python.h5").exists()


def test_executors_are_those_of_the_standard_library() -> None:
    class Here(Executor):
        """Runs at once: the simplest possible executor."""

        def submit(self, function: Any, /, *words: Any, **more: Any) -> Any:
            from concurrent.futures import Future

            future: Future[Any] = Future()
            future.set_result(function(*words, **more))
            return future

    assert list(rholm.batch(range(3), square, Here())["value"]) == [0, 1, 4]
