"""Copies: pickled, copied, compared by value, and read-only."""

from __future__ import annotations

import contextlib
import copy
import pickle
import threading
from concurrent.futures import ProcessPoolExecutor

import numpy as np
import pytest
import rholm
from conftest import public_names
from rholm import _arrays, _errors, harmonics


@pytest.fixture(scope="module")
def things(bumpy, ring):
    """One object of every public class, and of every class of its fields."""
    s = rholm.expand(bumpy, 6, length_unit="km")
    toleranced = rholm.expand(bumpy, tolerance=0.2, norm="max")
    chart = harmonics.make_star_chart(bumpy)
    cloud = rholm.sample_surface(ring, 3000)
    scans = rholm.sample_surface(ring, 3000, scans=3, misalignment=1e-3)
    made = rholm.reconstruct(cloud)
    atlas = rholm.compress(ring, 0.05)
    patches = harmonics.patch_atlas(ring, 4)
    found = rholm.align(s, s.rotate(rholm.rotation_about((0, 0, 1), 0.3)))
    texture = rholm.meshes.analyze_source(bumpy, "ball:0,0,1,0.9")
    table = rholm.batch([bumpy, ring], lambda m: {"area": m.area, "name": "a", "row": [1.0, 2.0], "n": 3})
    return [
        s, toleranced, s.errors, s.expanded, toleranced.expanded, toleranced.expanded.tolerance,
        s.expanded.transform, s.expanded.transform.fast, s.expanded.star, s.measure(), s.principal_axes(),
        chart, chart.report, harmonics.monte_carlo(chart, 2, samples=4), harmonics.expand_chart(chart, 4),
        harmonics.vertex_error_strengths(bumpy, (0, 0, 0)), bumpy, bumpy.inspect(), bumpy.bounds, cloud,
        rholm.clouds.clean(cloud), rholm.orient(cloud.points), rholm.clouds.align_scans(scans), made, atlas,
        atlas.report, atlas.errors, atlas.size, atlas.cap(0), patches, found, found.alignment,
        found.alignment.best, rholm.align(s.coeffs, s.coeffs), rholm.rotation_about((1, 2, 3), 0.4),
        rholm.compare(bumpy, ring, samples=100), rholm.compare(bumpy, ring, samples=100).a_to_b,
        rholm.repair(ring), rholm.meshes.weld(ring), rholm.simplify(ring, share=0.5),
        harmonics.overshoot("lanczos", 8), rholm.clouds.foresee_tiles(10**6), table,
        rholm.from_array(np.zeros((2, 3, 3)), function="other").with_gravity(1, 1).gravity,
        rholm.meshes.analyze_patch(bumpy, "ball:0,0,1,0.9", 1.0),
        texture.onto(bumpy, "ball:0,0,-1,0.9").report, rholm.render(bumpy, (16, 16)),
        rholm.read_shape, rholm.expand, made.atlas.rules,
    ]  # fmt: skip


def same(a, b):
    """Equality of all visible values."""
    if isinstance(a, np.ndarray):
        return np.array_equal(a, b)
    if isinstance(a, rholm.meshes.SmoothEditor):
        return np.array_equal(a.positions(1.0), b.positions(1.0)) and same(a.mesh, b.mesh)
    return a == b


def test_everything_can_be_pickled_and_copied(things):
    for thing in things:
        for twin in (pickle.loads(pickle.dumps(thing)), copy.copy(thing), copy.deepcopy(thing)):
            assert type(twin) is type(thing)
            assert same(thing, twin), type(thing)
    public = {kind for kind in public_names().values() if isinstance(kind, type)}
    records = {kind for kind in public if kind.__module__ == "rholm._core"}
    seen = {type(thing) for thing in things} | {
        type(field) for thing in things if isinstance(thing, tuple) for field in thing
    }
    assert records <= seen


def test_what_cannot_be_pickled_says_so(bumpy):
    texture = rholm.meshes.analyze_source(bumpy, "ball:0,0,1,0.9")
    editor = texture.onto(bumpy, "ball:0,0,-1,0.9")
    for thing in (texture, editor):
        with pytest.raises(TypeError, match="cannot be pickled"):
            pickle.dumps(thing)
    twin = copy.copy(editor)
    twin.height = 1.0
    assert editor.height == 0
    assert twin.mesh != editor.mesh


def test_exceptions_can_be_pickled():
    for kind in (rholm.Error, *_errors.BY_CODE.values()):
        error = pickle.loads(pickle.dumps(kind("a text")))
        assert type(error) is kind
        assert str(error) == "a text"
        assert error.code == kind.code
        assert str(copy.deepcopy(kind("b"))) == "b"


def _errors_of(s):
    return s.errors, s.expanded


def test_results_come_back_from_other_processes(bumpy):
    s = rholm.expand(bumpy, 6)
    with ProcessPoolExecutor(1) as pool:
        errors, expanded = pool.submit(_errors_of, s).result()
    assert errors == s.errors
    assert expanded.to_dict().keys() == s.expanded.to_dict().keys()


def test_shapes_and_records_are_equal_by_value(bumpy):
    twin = rholm.Mesh(bumpy.vertices, bumpy.faces)
    assert twin == bumpy
    assert twin is not bumpy
    assert rholm.meshes.flip(bumpy) != bumpy
    assert bumpy != bumpy.with_attributes(q=np.zeros(len(bumpy.vertices)))
    unknown = bumpy.with_attributes(q=np.full(len(bumpy.vertices), np.nan))
    assert unknown == unknown.copy()
    assert bumpy != 3
    cloud = rholm.sample_surface(bumpy, 50)
    assert cloud == rholm.PointCloud(cloud.points, cloud.normals)
    assert cloud != rholm.PointCloud(cloud.points)
    assert bumpy.inspect() == twin.inspect()
    assert bumpy.inspect() != rholm.icosphere(1).inspect()
    assert harmonics.Rotation() == harmonics.Rotation(1, 0, 0, 0)
    assert harmonics.Rotation() != bumpy.bounds


def test_results_are_shown_in_a_line(things):
    for thing in things:
        assert len(repr(thing)) < 420, repr(thing)
        assert "\n" not in repr(thing)
        if hasattr(thing, "to_dict"):
            assert len(repr(thing)) < 200, repr(thing)
            assert repr(thing).startswith(type(thing).__name__ + "(")
            assert "\n" not in repr(thing)


def test_arrays_that_are_copies_cannot_be_written_to(bumpy):
    s = rholm.expand(bumpy, 4)
    marked = bumpy.with_attributes(q=np.zeros(len(bumpy.vertices)), rgb=np.ones((len(bumpy.vertices), 3)))
    atlas = rholm.compress(bumpy, 0.1)
    for array in (
        rholm.batch([1], float)["value"], atlas.cap(0).axes, atlas.coefficients_of(0),
        s.coeffs, s.center, s.centroid, s.expanded.star.center, bumpy.vertices, bumpy.faces,
        marked.attributes["q"], marked.normals, marked.colors, bumpy.bounds.min, s.principal_axes().axes,
        rholm.sample_surface(bumpy, 20).normals,
    ):  # fmt: skip
        before = array.copy()
        with pytest.raises(ValueError, match="read-only"):
            array[...] = 5
        assert np.array_equal(array, before)
    with pytest.raises(ValueError, match="WRITEABLE"):
        bumpy.faces.flags.writeable = True
    for array in (s.to_array(), s([[0, 0, 1]]), s.inertia(), s.spectrum()):  # these belong to the user
        array[...] = 5


class Writer:
    """Another thread that writes to an array, and restores it, while other code runs."""

    def __init__(self, array, wrong):
        self.array, self.right, self.wrong = array, array.copy(), wrong
        self.stop = threading.Event()
        self.thread = threading.Thread(target=self.run, daemon=True)

    def run(self):
        """Writes until it is stopped."""
        while not self.stop.is_set():
            self.array[100:200] = self.wrong
            self.array[100:200] = self.right[100:200]

    def __enter__(self):
        self.thread.start()

    def __exit__(self, *error):
        self.stop.set()
        self.thread.join()


def test_other_threads_may_write_to_arrays_that_are_in_use():
    body = rholm.bumpy_sphere(4, 0.3, seed=2)
    s = rholm.expand(body, 16)
    directions = body.vertices / np.linalg.norm(body.vertices, axis=1, keepdims=True)
    vertices, triangles = np.array(body.vertices), np.array(body.faces)
    directions = _arrays.directions(directions)[0]

    def tried(call):
        for _ in range(10):
            with contextlib.suppress(rholm.Error):
                call()

    with Writer(triangles, 2**31 - 1):
        for call in (
            lambda: rholm.expand((vertices, triangles), 8, errors=False),
            lambda: rholm.meshes.surface_area((vertices, triangles)),
            lambda: rholm.inspect((vertices, triangles)),
        ):
            tried(call)
    with Writer(vertices, np.nan):
        tried(lambda: rholm.expand((vertices, triangles), 8, errors=False))
        tried(lambda: rholm.meshes.distances_to_surface(vertices, body))
    with Writer(directions, np.nan):
        tried(lambda: s(directions))
        tried(lambda: harmonics.adjoint(directions, degree=8))


def test_arrays_that_nobody_can_write_to_are_used_where_they_lie(tmp_path, bumpy):
    own = _arrays.unwritable
    array = np.array(bumpy.vertices)
    assert not np.shares_memory(own(array), array)
    view = array[:]
    view.flags.writeable = False  # written to through the other array
    assert not np.shares_memory(own(view), array)
    array.flags.writeable = False
    assert own(array) is array
    assert own(array[::2]).base is array
    assert own(bumpy.vertices) is not None
    assert np.shares_memory(own(bumpy.vertices), bumpy.vertices)
    data = np.frombuffer(bytes(array))
    assert own(data) is data
    writable = np.frombuffer(bytearray(array))
    writable.flags.writeable = False
    assert not np.shares_memory(own(writable), writable)
    bumpy.save(tmp_path / "m.ply")
    mapped = rholm.files.map_mesh(tmp_path / "m.ply")[0]
    assert np.shares_memory(own(mapped), mapped)
