"""The viewer of notebooks and pages: its input data. Browser tests (web/e2e) cover its drawing."""

import json

import numpy as np
import pytest
import rholm
from rholm import _view


@pytest.fixture
def script(tmp_path, monkeypatch):
    """Replaces the viewer of scripts/studio by a viewer of one line."""
    file = tmp_path / "viewer.js"
    file.write_text("export default { render() {} };")
    monkeypatch.setattr(_view, "_VIEWER", file)
    _view._widget.cache_clear()
    yield file.read_text()
    _view._widget.cache_clear()


def read(data):
    """Returns arrays and metadata, by the definition in docs/studio.md."""
    assert data[:8] == b"RHOLM1\0\0"
    length = int.from_bytes(data[8:12], "little")
    head = json.loads(data[12 : 12 + length])
    types = {"f64": "<f8", "f32": "<f4", "u32": "<u4", "u8": "u1"}
    arrays = {
        a["name"]: np.frombuffer(
            data, types[a["type"]], int(np.prod(a["shape"])), offset=a["offset"]
        ).reshape(a["shape"])
        for a in head["arrays"]
    }
    return arrays, head["meta"]


def test_data_are_the_expansion_and_its_shape():
    mesh = rholm.ellipsoid([3, 2, 1], 2)
    expansion = rholm.expand(mesh, 6, length_unit="km")
    arrays, meta = read(rholm.figures.view_data(expansion, title="an ellipsoid"))
    np.testing.assert_array_equal(arrays["coefficients"], expansion.to_array("orthonormal", 1))
    np.testing.assert_array_equal(arrays["positions"], mesh.vertices.astype("f4"))
    np.testing.assert_array_equal(arrays["triangles"], mesh.faces)
    assert meta["title"] == "an ellipsoid"
    assert meta["unit"] == "km"
    assert meta["expansion"] == {"degree": 6, "function": "radius", "center": list(expansion.center)}
    assert [row[0] for row in meta["error"]] == [1, 2, 4, 6]


def test_a_mesh_is_expanded_first():
    arrays, _ = read(rholm.figures.view_data(rholm.ellipsoid([3, 2, 1], 2)))
    assert arrays["coefficients"].shape == (2, 65, 65)


def test_a_widget_shows_the_data(script):
    pytest.importorskip("anywidget")
    expansion = rholm.expand(rholm.ellipsoid([3, 2, 1], 2), 4)
    widget = rholm.view(expansion)
    assert widget.data == rholm.figures.view_data(expansion)
    assert widget._esm == script


def test_several_are_shown_side_by_side(script):
    pytest.importorskip("anywidget")
    first, second = (rholm.expand(rholm.ellipsoid([3, 2, k], 2), 4) for k in (1, 2))
    shown = rholm.view(first, second, rholm.icosphere(1))
    assert [type(one).__name__ for one in shown.children] == ["View"] * 3
    assert shown.children[1].data == rholm.figures.view_data(second)
    with pytest.raises(rholm.InvalidInputError):
        rholm.view(first, second, title="both")


def test_an_interactive_page_has_the_viewer_and_needs_nothing(script, tmp_path):
    expansion = rholm.expand(rholm.ellipsoid([3, 2, 1], 2), 4)
    page = expansion.report_html(tmp_path / "page.html", interactive=True, picture_size=16)
    assert script in page
    assert (tmp_path / "page.html").read_text() == page
    assert "http://" not in page.replace("http://www.w3.org/", "")
    assert "https://" not in page


def test_an_interactive_page_is_of_an_expansion(script):
    atlas = rholm.compress(rholm.icosphere(3), 1e-2)
    with pytest.raises(rholm.InvalidInputError, match="atlas"):
        atlas.report_html(interactive=True)


def test_without_the_viewer_it_is_said_how_to_get_it(tmp_path, monkeypatch):
    monkeypatch.setattr(_view, "_VIEWER", tmp_path / "viewer.js")
    _view._widget.cache_clear()
    expansion = rholm.expand(rholm.icosphere(2), 2)
    with pytest.raises(rholm.UnsupportedError, match="scripts/studio"):
        expansion.report_html(interactive=True)
