"""Every example of the pages for readers runs as it stands, in order, in one folder per page.

Blocks of Python share their names, blocks of sh are for bash. A block of text right behind one is
what it prints. Blocks that install or build are for a clone of the project, and are recognised by
the words below.
"""

from __future__ import annotations

import contextlib
import io
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

DOCS = Path(__file__).resolve().parents[2] / "docs"
PAGES = [DOCS.parent / "README.md", DOCS / "start.md", *sorted((DOCS / "guides").glob("*.md"))]
pytestmark = pytest.mark.skipif(not DOCS.exists(), reason="the documents are not here")
FOR_A_CLONE = ("scripts/", "cmake ", "git ", "python3 -m venv", "pip ", "apt ", "sudo ")
OPTIONAL = ("matplotlib", "meshio", "pyshtools", "pyvista", "trimesh", "xarray")
BLOCK = re.compile(r"^```(python|sh)\n(.*?)^```\n(?:\n```text\n(.*?)^```\n)?", re.MULTILINE | re.DOTALL)


def program() -> str | None:
    """The folder of the program: from RHOLM_PROGRAM, beside the interpreter, or on the path."""
    beside = str(Path(sys.executable).parent)
    found = os.environ.get("RHOLM_PROGRAM") or shutil.which("rholm", path=beside) or shutil.which("rholm")
    return str(Path(found).resolve().parent) if found else None


def run_python(code: str, where: str, names: dict[str, Any]) -> str:
    """Returns the output that the code prints."""
    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        exec(compile(code, where, "exec"), names)
    return said.getvalue()


def run_sh(code: str, where: str, folder: Path) -> str:
    """Returns the standard output of the commands."""
    path = f"{program()}{os.pathsep}{os.environ['PATH']}"
    done = subprocess.run(
        ["bash", "-eu", "-o", "pipefail", "-c", code],
        cwd=folder,
        env={**os.environ, "PATH": path},
        capture_output=True,
        text=True,
        stdin=subprocess.DEVNULL,
        timeout=300,
        check=False,
    )
    assert done.returncode == 0, f"{where}:\n{code}\n{done.stderr}"
    return done.stdout


def run_page(text: str, name: str, folder: Path) -> list[str]:
    """Runs the blocks of a page; returns the blocks that were left out, and why."""
    names: dict[str, Any] = {"__name__": "__main__"}
    left_out = []
    for match in BLOCK.finditer(text):
        language, code, expected = match.groups()
        line = text[: match.start()].count("\n") + 1
        where = f"{name}:{line}"
        if language == "sh" and any(word in code for word in FOR_A_CLONE):
            continue
        if language == "sh" and not program():
            left_out.append(f"{where} (no program rholm)")
            continue
        try:
            said = run_python(code, where, names) if language == "python" else run_sh(code, where, folder)
        except ImportError as error:
            if error.name is None or error.name.partition(".")[0] not in OPTIONAL:
                raise
            left_out.append(f"{where} (no {error.name})")
            continue
        if expected is not None:
            assert said.rstrip() == expected.rstrip(), where
    return left_out


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_page(page, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "agg")
    text = page.read_text()
    if page.stem == "README":  # its sh lines need shapes; tests/cli/examples_test.py runs them
        text = text.replace("```sh\n", "```\n")
    left_out = run_page(text, page.name, tmp_path)
    if left_out:
        pytest.skip("left out: " + ", ".join(left_out))


@pytest.mark.parametrize(
    ("text", "error"),
    [
        ("```python\nprint(2)\n```\n\n```text\n3\n```\n", AssertionError),
        ("```python\na = 1\n```\n\n```python\nprint(b)\n```\n", NameError),
        ("```sh\nexit 3\n```\n", AssertionError),
        ("```python\nimport nothing_of_that_name\n```\n", ImportError),
    ],
    ids=["output", "name", "exit code", "package"],
)
def test_a_wrong_example_is_found(text, error, tmp_path, monkeypatch):
    monkeypatch.setenv("RHOLM_PROGRAM", "/bin/true")
    with pytest.raises(error):
        run_page(text, "page", tmp_path)


def test_every_guide_has_examples():
    for page in PAGES:
        assert page.stem == "index" or BLOCK.search(page.read_text()), page.name
