"""Formats of files and kinds of errors: Python has the same as the library's tables."""

from __future__ import annotations

import builtins
import os
import re
import subprocess

import numpy as np
import pytest
import rholm
from rholm import _core


def test_errors_are_those_of_the_table():
    for code, name, base, meaning in _core.ERRORS:
        kind = getattr(rholm, name)
        assert kind.__name__ == name
        assert name in rholm.__all__
        assert kind.code == code
        assert kind.__doc__ == meaning
        bases = {other.__name__ for other in kind.__mro__[1:] if not issubclass(rholm.Error, other)}
        assert (base in bases) if base else not bases
        if base:
            assert hasattr(builtins, base) or hasattr(rholm, base)
    assert list(rholm._errors.BY_CODE) == [code for code, *_ in _core.ERRORS]


def test_formats_are_those_of_the_program():
    program = os.environ.get("RHOLM_PROGRAM")
    if not program:
        pytest.skip("RHOLM_PROGRAM does not name the program")
    told = subprocess.run(
        [program, "convert", "--help", "all"], capture_output=True, text=True, check=True
    ).stdout
    choices = re.search(r"--format ([\w|]+)", told)
    assert choices, told
    written = [
        one.name for one in (*rholm.files.shape_formats(), *rholm.files.coefficients_formats()) if one.written
    ]
    assert choices[1].split("|") == written


def test_shapes_are_saved_in_every_format(tmp_path):
    sphere = rholm.icosphere(1)
    cloud = rholm.PointCloud(np.random.default_rng(1).normal(size=(30, 3)))
    for known in rholm.files.shape_formats():
        assert known.read
        assert known.written
        for shape, word in ((sphere, "faces"), (cloud, "points")):
            path = tmp_path / f"{word}.{known.extensions[0]}"
            if word not in known.holds:
                with pytest.raises(rholm.UnsupportedError, match=known.title):
                    rholm.files.write_shape(shape, path)
                continue
            rholm.files.write_shape(shape, path)
            assert rholm.read_shape(path).format == known.name
            rholm.files.write_shape(shape, tmp_path / "named", format=known.name)
            assert (tmp_path / "named").read_bytes() == path.read_bytes()


def test_coefficients_are_saved_in_every_format(tmp_path):
    sphere = rholm.expand(rholm.icosphere(2), degree=3)
    for known in rholm.files.coefficients_formats():
        assert known.read
        assert known.written
        path = tmp_path / f"a.{known.extensions[0]}"
        sphere.save(path)
        assert rholm.load(path).degree == 3
        assert rholm.files.coefficients_format_of(path) == (None if known.name == "h5" else known.name)
        sphere.save(tmp_path / "b", format=known.name)
        if known.name != "h5":  # a model file has the time of its making
            assert (tmp_path / "b").read_bytes() == path.read_bytes()


def test_a_shape_is_told_from_coefficients(tmp_path):
    for known in rholm.files.shape_formats():
        path = tmp_path / f"a.{known.extensions[0]}"
        path.write_bytes(b"")
        with pytest.raises(rholm.InvalidInputError, match="a file of a shape"):
            rholm.files.read_coefficients(path)
