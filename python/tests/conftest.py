"""Shapes that several tests use."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import rholm
import rholm.clouds
import rholm.figures
import rholm.files
import rholm.harmonics
import rholm.meshes

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "support"))
import times  # noqa: E402

#: The modules that users see.
MODULES = (rholm, rholm.harmonics, rholm.meshes, rholm.clouds, rholm.files, rholm.figures)


def public_names() -> dict[str, Any]:
    """Every public object of the package by its name."""
    return {name: getattr(module, name) for module in MODULES for name in module.__all__}


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_protocol(item: pytest.Item) -> Iterator[None]:
    """Records the times of each test, with its fixtures."""
    before = times.spent()
    yield
    seconds = times.minus(times.spent(), before)
    session = item.session
    noted = getattr(session, "noted", (0.0, 0.0))
    session.noted = times.plus(noted, seconds)  # type: ignore[attr-defined]
    times.note(seconds, f"python/{item.path.stem}", item.name)


def pytest_sessionfinish(session: pytest.Session) -> None:
    """Records the remaining time of the process: starting Python and reading the tests."""
    if session.items:
        seconds = times.minus(times.spent(), getattr(session, "noted", (0.0, 0.0)))
        times.note(seconds, f"python/{session.items[0].path.stem}", "(start)")


@pytest.fixture(scope="session")
def bumpy() -> rholm.Mesh:
    """A star-shaped body without symmetry, 1280 faces."""
    return rholm.bumpy_sphere(3, 0.3, seed=7)


@pytest.fixture(scope="session")
def ring() -> rholm.Mesh:
    """A torus: not star-shaped, genus 1."""
    return rholm.torus(2, 0.7, 60, 30)


@pytest.fixture
def random() -> np.random.Generator:
    """Random numbers that are the same in every run."""
    return np.random.default_rng(1)


@pytest.fixture(scope="session")
def program() -> Path:
    """The program that was built together with the package."""
    path = Path(os.environ.get("RHOLM_PROGRAM", ROOT / "build" / "release" / "cli" / "rholm"))
    if not path.exists():
        pytest.skip(f"there is no program {path}: set RHOLM_PROGRAM")
    return path
