"""Structure of the package: few names, modules without circles, names of the previous version."""

from __future__ import annotations

import ast
import importlib
import pickle
import subprocess
import sys
import types
from pathlib import Path

import numpy as np
import pytest
import rholm
from conftest import MODULES, ROOT, public_names
from rholm import _old_names, _run

FOLDER = Path(rholm.__file__).parent


def imports_of(tree: ast.AST) -> set[str]:
    """Returns the modules of the package that code imports, also in functions, but not for type
    checkers.
    """
    found: set[str] = set()
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test):
            continue
        if isinstance(node, ast.ImportFrom) and node.level == 1:
            found |= {node.module} if node.module else {alias.name for alias in node.names}
        elif isinstance(node, ast.Import | ast.ImportFrom):
            names = (
                [alias.name for alias in node.names] if isinstance(node, ast.Import) else [node.module or ""]
            )
            found |= {"__init__" for name in names if name.partition(".")[0] == "rholm"}
        found |= imports_of(node)
    return found


def circle_in(graph: dict[str, set[str]]) -> list[str]:
    """Returns modules that import each other, each the next one; [] without a circle."""
    done: set[str] = set()

    def visit(name: str, path: list[str]) -> list[str]:
        if name in path:
            return [*path[path.index(name) :], name]
        if name in done:
            return []
        for other in sorted(graph.get(name, ())):
            if found := visit(other, [*path, name]):
                return found
        done.add(name)
        return []

    return next(filter(None, (visit(name, []) for name in sorted(graph))), [])


def test_no_modules_import_each_other():
    graph = {path.stem: imports_of(ast.parse(path.read_text())) for path in FOLDER.glob("*.py")}
    assert len(graph) > 40
    assert {"_core", "_errors", "_shapes"} <= graph["_convert"]
    assert circle_in(graph) == []


def test_a_circle_is_found():
    assert circle_in({"a": {"b"}, "b": {"c"}, "c": {"b"}}) == ["b", "c", "b"]
    assert circle_in({"a": {"b", "c"}, "b": {"c"}, "c": set()}) == []
    code = "def f():\n    from ._shapes import Mesh\nif TYPE_CHECKING:\n    from ._atlas import Atlas\n"
    assert imports_of(ast.parse(code)) == {"_shapes"}


def test_the_top_has_few_names_and_a_module_has_each():
    assert len(rholm.__all__) <= 45
    below = [name for module in MODULES[1:] for name in module.__all__]
    assert len(set(below)) == len(below)
    for name in rholm.__all__:
        thing = getattr(rholm, name)
        if not (isinstance(thing, type) and issubclass(thing, Exception)):
            assert name in below
            assert public_names()[name] is thing
    assert set(rholm.__all__) == set(rholm._HOMES)
    assert set(rholm.__all__) < set(dir(rholm))


def test_type_checkers_see_the_names_of_the_top():
    tree = ast.parse((FOLDER / "__init__.py").read_text())
    block = next(n for n in tree.body if isinstance(n, ast.If))
    seen = {
        (alias.name, node.module)
        for node in block.body
        if isinstance(node, ast.ImportFrom) and node.module
        for alias in node.names
    }
    assert seen == set(rholm._HOMES.items())


def test_names_that_left_the_top_warn_and_work():
    places = {
        name: module
        for module in rholm._MODULES
        if not module.startswith("_")
        for name in importlib.import_module(f"rholm.{module}").__all__
        if name not in rholm.__all__
    }
    assert len(places) > 150
    for name, module in places.items():
        with pytest.warns(DeprecationWarning, match=rf"rholm\.{name} is rholm\.{module}\.{name} now"):
            old = getattr(rholm, name)
        assert old is getattr(importlib.import_module(f"rholm.{module}"), name)
    for name, (place, thing) in _old_names._RENAMED.items():
        with pytest.warns(DeprecationWarning, match=f"rholm.{name} is ") as said:
            assert getattr(rholm, name) is thing
        assert place in str(said[0].message)
        assert said[0].filename == __file__
    assert not set(rholm.__all__) & set(_old_names._RENAMED)
    with pytest.raises(AttributeError, match="no attribute 'expant'"):
        _ = rholm.expant


def test_old_names_of_faces_warn_and_work(bumpy):
    with pytest.warns(DeprecationWarning, match=r"Mesh\.triangles is Mesh\.faces now"):
        assert bumpy.triangles is not None
    with pytest.warns(DeprecationWarning, match=r"simplify\(faces=\)"):
        fewer = rholm.simplify(bumpy, triangles=200)
    assert fewer.mesh == rholm.simplify(bumpy, faces=200).mesh
    welded = rholm.meshes.weld(bumpy)
    with pytest.warns(DeprecationWarning, match="collapsed_faces"):
        assert welded.collapsed_triangles == welded.collapsed_faces
    atlas = rholm.compress(rholm.icosphere(2), 0.05)
    mesh = atlas.mesh(simplify={"faces": 100})
    assert len(mesh.faces) <= 100
    with pytest.warns(DeprecationWarning, match="simplify={'faces': ...}"):
        assert atlas.mesh(simplify={"triangles": 100}) == mesh
    report = bumpy.inspect()
    with pytest.warns(DeprecationWarning, match=r"Inspection\.triangles is Inspection\.faces now"):
        assert report.triangles == report.faces
    for kind, names in _run._FIELDS_OF_FACES.items():
        for name in names:
            assert isinstance(getattr(kind, name.replace("faces", "triangles")), property)


def test_importing_loads_nothing_else():
    code = "import sys, rholm; print(any(m.startswith('rholm.') or m == 'numpy' for m in sys.modules))"
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert done.stdout.strip() == "False"


@pytest.mark.parametrize("module", [m.__name__ for m in MODULES])
def test_every_module_can_be_imported_first(module):
    code = f"import {module} as m; [getattr(m, name) for name in m.__all__]; print(len(m.__all__))"
    done = subprocess.run([sys.executable, "-W", "error", "-c", code], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert int(done.stdout) > 10


def test_public_functions_can_be_pickled():
    for name, thing in public_names().items():
        if isinstance(thing, type | types.FunctionType):
            assert pickle.loads(pickle.dumps(thing)) is thing, name


def test_wrong_types_name_the_argument(bumpy):
    s = rholm.expand(bumpy, 2)
    for call, said in (
        (lambda: rholm.expand(3), r"expand\(\): shape is 3; it must be a mesh"),
        (lambda: rholm.expand(None), r"expand\(\): shape is None"),
        (lambda: rholm.compare(bumpy, 1.5), r"compare\(\): b is 1\.5"),
        (lambda: rholm.orient(3), r"orient\(\): points is 3; it must be points"),
        (lambda: rholm.reconstruct(np.float64(2)), r"reconstruct\(\): points is .*2"),
        (lambda: rholm.placed(3, None), r"placed\(\): a is 3; it must be an Expansion; expand\(\)"),
        (lambda: rholm.harmonics.power_spectrum(3), r"power_spectrum\(\): coefficients is 3"),
        (lambda: s.rotate(3), r"rotate\(\): rotation is 3; it must be a rotation"),
        (lambda: rholm.harmonics.size_of("a"), r"size_of\(\): atlas is 'a'.*compress\(\)"),
        (lambda: rholm.harmonics.tail_strength(3), r"tail_strength\(\): chart is 3.*make_star_chart\(\)"),
        (lambda: rholm.view(3), r"view\(\): model is 3"),
        (lambda: rholm.report_html(3), r"report_html\(\): model is 3"),
    ):
        with pytest.raises(TypeError, match=said):
            call()


def mypy(*words: str | Path) -> subprocess.CompletedProcess[str]:
    """Runs mypy --strict on the package that is tested."""
    pytest.importorskip("mypy")
    how = ["--strict", "--config-file", str(ROOT / "pyproject.toml"), "--no-error-summary"]
    return subprocess.run(
        [sys.executable, "-m", "mypy", *how, *map(str, words)], capture_output=True, text=True, cwd=ROOT
    )


@pytest.mark.skipif(not (ROOT / "docs").exists(), reason="the documents are not here")
def test_types_hold_users_to_what_functions_take(tmp_path):
    """Examples of documents pass mypy --strict. Each marked line of misuse.py fails."""
    readme = "".join(
        part.partition("```")[0] for part in (ROOT / "README.md").read_text().split("```python\n")[1:]
    )
    (tmp_path / "readme.py").write_text(readme)
    misuse = Path(__file__).with_name("misuse.py")
    gallery = sorted((ROOT / "docs" / "gallery").glob("*.py"))
    done = mypy("--cache-dir", tmp_path, misuse, tmp_path / "readme.py", *gallery)
    lines = misuse.read_text().splitlines()
    wrong = {i for i, line in enumerate(lines, 1) if line.endswith("# error")}
    told = [line for line in done.stdout.splitlines() if ": error:" in line]
    found = {int(line.split(":")[1]) for line in told if "misuse.py" in line}
    assert found == wrong, done.stdout + done.stderr
    assert [line for line in told if "misuse.py" not in line] == []
