"""The studio of notebooks, tested from Python. JupyterLab tests (web/e2e) cover its page."""

import json
import re
import threading

import numpy as np
import pytest
import rholm
from conftest import ROOT
from rholm import _studio

pytest.importorskip("anywidget")


@pytest.fixture(autouse=True)
def script(tmp_path, monkeypatch):
    """Replaces the page of scripts/studio by a page of one line."""
    file = tmp_path / "studio.js"
    file.write_text("export default { render() {} };")
    monkeypatch.setattr(_studio, "_SCRIPT", file)
    _studio._widget_class.cache_clear()
    yield file
    _studio._widget_class.cache_clear()


@pytest.fixture
def page():
    """A studio, and the messages to its page."""
    with rholm.studio(threads=1) as studio:
        yield studio, Page(studio)


class Page:
    """Acts as the page: sends requests as messages, and receives answers and events."""

    def __init__(self, studio):
        self.studio, self.told, self.heard = studio, [], threading.Condition()
        studio.widget.send = self.hear

    def hear(self, content, buffers=()):
        """Receives a message, as the widget's send()."""
        with self.heard:
            self.told.append((content, [bytes(b) for b in buffers]))
            self.heard.notify_all()

    def ask(self, method, path, body=b"", **query):
        """Returns the answer to a message: status, type, bytes."""
        asked = {"view": 1, "id": len(self.told), "method": method, "path": path, "query": query}
        asked["session"] = self.studio.widget.session
        self.studio.widget._handle_custom_msg(asked, [body] if body else [])
        with self.heard:
            answers = [(c["answer"], b) for c, b in self.told if "answer" in c]
        answer, buffers = answers[-1]
        assert answer["view"] == 1
        assert answer["id"] == asked["id"]
        return answer["status"], answer["type"], buffers[0]

    def wait_for(self, event, seen):
        """Waits until there is such an event."""
        with self.heard:
            assert self.heard.wait_for(lambda: any(seen(d) for d in self.events(event)), timeout=600)

    def events(self, name):
        """Returns all events of that name."""
        return [json.loads(c["data"]) for c, _ in self.told if c.get("event") == name]


def test_shapes_go_in_and_come_back_exactly(bumpy, tmp_path):
    points = rholm.sample_surface(bumpy, 50)
    expansion = rholm.expand(bumpy, 5)
    atlas = rholm.compress(bumpy, 1e-1)
    file = tmp_path / "file of mine.off"
    rholm.files.write_shape(bumpy, file)
    with rholm.studio(bumpy, points, points.points, expansion, atlas, file, threads=1) as studio:
        assert len(studio) == 6
        assert studio.names[-1] == "file of mine.off"
        np.testing.assert_array_equal(studio[0].vertices, bumpy.vertices)
        np.testing.assert_array_equal(studio[0].faces, bumpy.faces)
        np.testing.assert_array_equal(studio[1].points, points.points)
        np.testing.assert_array_equal(studio[2].points, points.points)
        np.testing.assert_array_equal(studio[3].coeffs, expansion.coeffs)
        for i in range(len(atlas)):
            np.testing.assert_array_equal(studio[4].coefficients_of(i), atlas.coefficients_of(i))
        np.testing.assert_array_equal(studio["file of mine.off"].vertices, bumpy.vertices)
        assert isinstance(studio.mesh(4), rholm.Mesh)
        with pytest.raises(rholm.InvalidInputError, match="points"):
            studio.mesh(1)


def test_names_are_given(bumpy):
    with rholm.studio(threads=1) as studio:
        studio.add(bumpy, "one")
        studio.add((bumpy.vertices, bumpy.faces), "two")
        assert studio.names == ["one", "two"]
        assert repr(studio) == "<rholm.figures.Studio: one, two>"
        with pytest.raises(KeyError, match="three"):
            studio["three"]
        with pytest.raises(IndexError):
            studio[2]


def test_columns_of_tables_are_said(tmp_path):
    table = tmp_path / "points.txt"
    table.write_text("1 0 0 2\n2 4 0 2\n3 0 5 2\n4 1 1 3\n")
    with rholm.studio(threads=1) as studio:
        studio.add(table)
        studio.add(table, "turned", columns=["-", "z", "x", "y"])
        np.testing.assert_array_equal(studio[0].points[1], [4, 0, 2])
        np.testing.assert_array_equal(studio[1].points[1], [0, 2, 4])
        with pytest.raises(rholm.InvalidInputError, match="columns"):
            studio.add(table, columns="x,y,z")


def test_what_cannot_be_opened_is_said(tmp_path):
    broken = tmp_path / "broken.ply"
    broken.write_bytes(b"ply\nformat ascii 1.0\n")
    before = threading.active_count()
    with pytest.raises(rholm.InvalidInputError, match=r"broken\.ply"):
        rholm.studio(broken)
    assert threading.active_count() == before
    with pytest.raises(FileNotFoundError):
        rholm.studio(tmp_path / "missing.ply")
    with pytest.raises(TypeError, match="mesh"):
        rholm.studio(7)


def test_the_page_asks_and_is_told(page, bumpy):
    studio, browser = page
    studio.add(bumpy, "bumpy")
    status, kind, body = browser.ask("GET", "api/state")
    assert (status, kind) == (200, "application/json")
    assert [item["name"] for item in json.loads(body)["items"]] == ["bumpy"]
    step = {"op": "expand", "item": json.loads(body)["items"][0]["id"], "degree": 6, "center": "auto"}
    assert browser.ask("POST", "api/step", json.dumps(step).encode())[0] == 202
    browser.wait_for("state", lambda state: state["items"] and state["items"][0]["expansion"])
    browser.wait_for("job", lambda job: job["state"] == "done")
    expansion = studio["bumpy"]
    assert expansion.degree == 6
    assert expansion.coeffs.tobytes() == rholm.expand(bumpy, 6).coeffs.tobytes()
    shown = studio.mesh("bumpy").vertices
    np.testing.assert_allclose(shown, expansion.points(bumpy.vertices - expansion.center), atol=1e-12)
    assert "degree=6" in studio.recipe
    assert browser.ask("GET", "api/nothing")[0] == 404
    assert browser.ask("POST", "api/file", b"", name="empty.ply")[0] == 422


def test_bytes_of_a_file_come_beside_the_message(page, bumpy, tmp_path):
    studio, browser = page
    file = tmp_path / "bumpy.ply"
    rholm.files.write_shape(bumpy, file)
    assert browser.ask("POST", "api/file", file.read_bytes(), name="bumpy.ply")[0] == 200
    status, kind, body = browser.ask("GET", "api/save", item="1", format="ply")
    assert (status, kind, body) == (200, "application/octet-stream", file.read_bytes())
    assert studio.names == ["bumpy.ply"]


def test_silence_is_broken(monkeypatch):
    monkeypatch.setattr(_studio, "_BEAT", 0.01)
    with rholm.studio(threads=1) as studio:
        browser = Page(studio)
        with browser.heard:
            assert browser.heard.wait_for(lambda: any(c.get("event") == "beat" for c, _ in browser.told), 60)


def test_a_session_is_a_file(bumpy, tmp_path):
    with rholm.studio(bumpy, threads=1) as studio:
        studio.save(tmp_path / "work.rholm")
        data = (tmp_path / "work.rholm").read_bytes()
    with rholm.studio(tmp_path / "work.rholm", threads=1) as again:
        np.testing.assert_array_equal(again[0].vertices, bumpy.vertices)
        assert again.names == ["shape.ply"]
    assert data.startswith(b"RHOLMSS1")


def test_it_ends_with_its_widget(bumpy, tmp_path, monkeypatch):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    studio = rholm.studio(bumpy)
    assert len(studio[0].faces) == 1280
    assert len(list(tmp_path.glob("rholm-studio-*"))) == 1
    job = {"op": "compress", "item": 1, "tolerance": 1e-6}
    studio._ask("POST", "step", json.dumps(job).encode())
    # The widget's own close() leaves this state. Closing waits for the job, which is cancelled.
    studio.widget.comm = None
    assert not studio._teller.is_alive()
    with pytest.raises(rholm.InvalidInputError, match="closed"):
        studio.add(bumpy)
    assert repr(studio) == "<rholm.figures.Studio: closed>"
    studio.close()
    assert not list(tmp_path.glob("rholm-studio-*"))


def test_without_the_page_it_is_said_how_to_get_it(script):
    script.unlink()
    _studio._widget_class.cache_clear()
    with pytest.raises(rholm.UnsupportedError, match="scripts/studio"):
        rholm.studio()


@pytest.mark.skipif(not (ROOT / "docs").exists(), reason="the documents are not here")
def test_the_example_of_the_document_runs(capsys):
    text = (ROOT / "docs/studio.md").read_text()
    (block,) = re.findall(r"^```python\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    names = {}
    exec(block, names)
    assert "import rholm" in capsys.readouterr().out  # the recipe
    assert repr(names["studio"]) == "<rholm.figures.Studio: closed>"
