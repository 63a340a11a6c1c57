"""Examples in docstrings give the documented results."""

from __future__ import annotations

import doctest
import importlib
from pathlib import Path

import pytest
import rholm

MODULES = sorted(
    p.stem for p in Path(rholm.__file__).parent.glob("_*.py") if p.stem not in ("__init__", "_pyvista")
)


@pytest.mark.parametrize("name", MODULES)
def test_docstrings(name):
    failed, _ = doctest.testmod(importlib.import_module(f"rholm.{name}"))
    assert failed == 0
