"""Checks that a row added to a table of the library, or an option added to a list, appears in the
package. These tests use the users' module with the additions of tests/one_list.
"""

import inspect
import subprocess
import sys
import typing
from pathlib import Path

import numpy as np
import pytest
import rholm
from rholm import _filters


@pytest.fixture
def expansion():
    return rholm.expand(rholm.bumpy_sphere(3), degree=8)


def test_window_is_a_choice_and_documented(expansion):
    assert typing.get_args(_filters.Window)[-1] == "wedge"
    assert np.allclose(rholm.low_pass(3, 5, "wedge", order=1), [1, 0.75, 0.5, 0.25, 0, 0])
    assert expansion.low_pass(3, "wedge").method.endswith("low-pass 3 wedge")
    assert '"wedge"}' in rholm.low_pass.__doc__
    assert 'p of "exponential" and "wedge"' in rholm.low_pass.__doc__
    with pytest.raises(rholm.InvalidInputError, match="did you mean 'wedge'"):
        rholm.low_pass(3, 5, "wegde")


def test_descriptor_is_a_property_of_expansions_and_measures(expansion):
    measures = expansion.measure()
    assert expansion.thickness == measures.thickness == measures.to_dict()["thickness"]
    assert expansion.thickness == expansion.volume / expansion.area
    assert "Nobody 1900" in rholm.Expansion.thickness.__doc__
    assert "thickness" in expansion._repr_html_()


def test_option_is_an_argument_with_its_documentation():
    argument = inspect.signature(rholm.reconstruct).parameters["made_up"]
    assert (argument.default, argument.annotation) == (0.5, "float")
    assert "made_up : float\n" in rholm.reconstruct.__doc__
    assert "A made-up option, for tests. Within 0 ... 1." in rholm.reconstruct.__doc__


def test_option_is_checked():
    points = rholm.sample_surface(rholm.bumpy_sphere(3), 2000)
    assert rholm.reconstruct(points, made_up=0.25).mesh.faces.shape[1] == 3
    with pytest.raises(rholm.InvalidInputError, match="made_up is"):
        rholm.reconstruct(points, made_up=1.5)


def test_option_is_in_the_types_of_keywords(tmp_path):
    script = Path(__file__).resolve().parents[2] / "scripts" / "tables-stub"
    subprocess.run([sys.executable, script, tmp_path], check=True)
    assert "    made_up: float\n" in (tmp_path / "_keywords.py").read_text()
