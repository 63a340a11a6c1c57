"""A row that is added to a table of the library is found in the package.

The module of these tests is that of users, with one made-up row in each table (tests/one_list/*.inc).
"""

import typing

import numpy as np
import pytest
import rholm


@pytest.fixture
def expansion():
    return rholm.expand(rholm.bumpy_sphere(3), degree=8)


def test_window_is_a_choice_and_documented(expansion):
    assert typing.get_args(rholm._filters.Window)[-1] == "wedge"
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
