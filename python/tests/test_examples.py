"""Every public function, class and method has an example in its docstring, which gives what it says."""

from __future__ import annotations

import doctest
import inspect
import re

import numpy as np
import pytest
import rholm
from conftest import public_names
from rholm import _shown

#: Words of examples that need another package, which takes seconds to import.
PACKAGES = {
    "anywidget": r"\.studio\(|\.view\(",
    "matplotlib": "matplotlib",
    "meshio": "to_meshio",
    "pandas": "to_pandas",
    "pyarrow": "to_parquet",
    "pyshtools": "to_pyshtools",
    "pyvista": "to_pyvista",
    "trimesh": "to_trimesh",
    "xarray": "to_xarray",
}
#: Results of the library, which functions make: their fields are documented one by one.
RESULTS = {
    name for name, thing in public_names().items() if getattr(thing, "__module__", "") == "rholm._core"
}


def documented():
    """Yields names and objects that need an example."""
    things = {**public_names(), "Shown": _shown.Shown, "Reported": _shown.Reported}
    for name, thing in things.items():
        if inspect.isfunction(thing):
            yield name, thing
        elif inspect.isclass(thing) and name not in RESULTS and not issubclass(thing, Exception):
            if not issubclass(thing, tuple) and name not in ("Shown", "Reported"):
                yield name, thing
            for method, function in vars(thing).items():
                if inspect.isfunction(function) and not method.startswith("_"):
                    yield f"{name}.{method}", function


def marked(name, thing):
    """Returns parameters for pytest: examples that need another package run in nightly tests."""
    needed = [package for package, words in PACKAGES.items() if re.search(words, thing.__doc__ or "")]
    marks = [pytest.mark.nightly] if needed else []
    return pytest.param(name, thing, needed, id=name, marks=marks)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder for the files of examples, with an atlas."""
    made = tmp_path_factory.mktemp("examples")
    ring = rholm.sample_surface(rholm.torus(2, 0.7, 40, 20), 1000)
    rholm.reconstruct(ring).atlas.save(made / "ring.h5")
    return made


@pytest.mark.parametrize(("name", "thing", "needed"), [marked(*one) for one in documented()])
def test_example(name, thing, needed, folder, monkeypatch):
    for package in needed:
        pytest.importorskip(package)
    monkeypatch.chdir(folder)
    monkeypatch.setenv("MPLBACKEND", "agg")
    test = doctest.DocTestParser().get_doctest(
        inspect.getdoc(thing) or "", {"rholm": rholm, "np": np}, name, None, None
    )
    assert test.examples, f"{name} has no example"
    said: list[str] = []
    doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE).run(test, out=said.append)
    assert not said, "".join(said)
