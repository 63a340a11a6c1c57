"""Shapes that the tests share."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest
import rholm

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def bumpy() -> rholm.Mesh:
    """A star-shaped body without symmetry, 1280 triangles."""
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
