"""Arrays of users: layouts, types, copies and refusals."""

from __future__ import annotations

import itertools
import pickle

import numpy as np
import pytest
import rholm
from rholm import _arrays, harmonics
from rholm._arrays import face_rows, vertex_rows


def layouts(array: np.ndarray) -> dict[str, np.ndarray]:
    wide = np.zeros((len(array), 5), array.dtype)
    wide[:, 1:4] = array
    every = np.zeros((2 * len(array), 3), array.dtype)
    every[::2] = array
    locked = array.copy()
    locked.flags.writeable = False
    record = np.zeros(len(array), [("flag", "u1"), ("row", array.dtype, 3)])  # not aligned
    record["row"] = array
    return {
        "C": array.copy(),
        "Fortran": np.asfortranarray(array),
        "columns of a wider array": wide[:, 1:4],
        "every second row": every[::2],
        "reversed twice": array[::-1].copy()[::-1],
        "read-only": locked,
        "fields of records": record["row"],
        "big-endian": array.astype(array.dtype.newbyteorder(">")),
    }


FLOATS, INTS = ("f4", "f8"), ("i4", "u4", "i8", "u8", "i2")


@pytest.mark.parametrize("floats", FLOATS)
@pytest.mark.parametrize("ints", INTS)
def test_every_layout_gives_the_same_bits(bumpy, floats, ints):
    vertices = bumpy.vertices.astype(floats)
    triangles = bumpy.faces.astype(ints)
    how = {"degree": 12, "errors": False, "rays": 0}  # the fastest way to coefficients
    expected = rholm.expand((vertices, triangles), **how).coeffs
    assert expected.any()
    # Each layout meets each type here. Over all types it also meets each layout of the other array.
    shift = len(INTS) * FLOATS.index(floats) + INTS.index(ints)
    of_triangles = list(layouts(triangles).items())
    assert len(FLOATS) * len(INTS) >= len(of_triangles)
    for i, (name, v) in enumerate(layouts(vertices).items()):
        other, t = of_triangles[(i + shift) % len(of_triangles)]
        assert np.array_equal(rholm.expand((v, t), **how).coeffs, expected), (name, other)


def test_arrays_that_can_be_used_as_they_lie_are_not_copied(bumpy):
    for floats, ints in itertools.product(("f4", "f8"), ("i4", "u4")):
        vertices = bumpy.vertices.astype(floats)
        triangles = bumpy.faces.astype(ints)
        assert vertex_rows(vertices) is vertices
        assert np.shares_memory(face_rows(triangles), triangles)
        assert np.shares_memory(vertex_rows(vertices[::2]), vertices)
    columns = np.zeros((10, 5))[:, 1:4]
    assert vertex_rows(columns) is columns


def test_arrays_of_a_mesh_are_its_own_memory(bumpy):
    assert np.shares_memory(bumpy.vertices, bumpy.vertices)
    assert np.shares_memory(bumpy.faces, bumpy.faces)
    assert not bumpy.vertices.flags.writeable
    first = rholm.icosphere(3).vertices  # outlives the mesh
    assert np.allclose(np.linalg.norm(first, axis=1), 1)


def test_float32_is_what_float32_holds(bumpy):
    single = bumpy.vertices.astype("f4")
    a = rholm.expand((single, bumpy.faces), 10)
    b = rholm.expand((single.astype("f8"), bumpy.faces), 10)
    assert np.abs(a.coeffs - b.coeffs).max() <= 1e-15


@pytest.mark.parametrize(
    "shape",
    [
        (np.zeros((0, 3)), np.zeros((0, 3), int)),
        ([], []),
        (np.zeros((3, 2)), np.zeros((1, 3), int)),
        (np.zeros((3, 3)), np.zeros((1, 4), int)),
        (np.zeros((3, 3)), np.array([[0, 1, 3]])),
        (np.zeros((3, 3)), np.array([[0, 1, -1]])),
        (np.zeros((3, 3)), np.array([[0, 1, 2**32]])),
        (np.full((3, 3), np.nan), np.array([[0, 1, 2]])),
        (np.array([[np.inf, 0, 0], [0, 1, 0], [0, 0, 1]]), np.array([[0, 1, 2]])),
        (np.zeros(9), np.array([[0, 1, 2]])),
        (np.zeros((3, 3)), np.array([0, 1, 2])),
        (np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]]), np.array([[0, 1, 2]])),  # open
    ],
)
def test_what_is_no_mesh_is_refused(shape):
    with pytest.raises(rholm.InvalidInputError) as refusal:
        rholm.expand(shape, 4)
    assert len(str(refusal.value)) > 10
    assert refusal.value.code == "InvalidInput"


@pytest.mark.parametrize(
    "shape",
    [
        None,
        3,
        "",
        object(),
        (np.zeros((3, 3), complex), np.zeros((1, 3), int)),
        (np.zeros((3, 3)), np.zeros((1, 3))),
        (np.zeros((3, 3), object), np.zeros((1, 3), int)),
        (np.array([["a", "b", "c"]]), np.zeros((1, 3), int)),
        (np.zeros((3, 3)),),
    ],
)
def test_what_is_no_array_is_refused(shape):
    with pytest.raises((TypeError, rholm.Error)):
        rholm.expand(shape, 4)


def test_what_is_masked_is_not_known(bumpy, ring, tmp_path):
    points = np.array(rholm.sample_surface(ring, 2000).points)
    bad = np.arange(len(points)) % 10 == 0
    beneath = points.copy()
    beneath[bad] *= 0.7
    expected = rholm.reconstruct(points[~bad])
    one = np.zeros(points.shape, bool)
    one[bad, 1] = True  # a number is enough
    masks = [np.repeat(bad[:, None], 3, axis=1), one]
    for mask in masks:
        masked = np.ma.masked_array(beneath, mask=mask)
        unknown = np.where(mask, np.nan, beneath)
        for rows in (masked, unknown, list(masked), np.ma.masked_array(beneath.astype("f4"), mask=mask)):
            found = rholm.reconstruct(rows)
            assert found.report.dropped_points == bad.sum()
            assert len(rholm.clouds.clean(rows).cloud) == len(points) - bad.sum()
        assert rholm.reconstruct(masked).mesh == expected.mesh
    np.savetxt(tmp_path / "p.xyz", np.where(masks[0], np.nan, beneath))
    with pytest.warns(UserWarning, match="not finite"):
        report = rholm.reconstruct(tmp_path / "p.xyz").report
    assert (report.points, report.dropped_points) == (len(points), bad.sum())
    assert np.array_equal(
        rholm.clouds.as_points(np.ma.masked_array(points, mask=False)).points, points
    )  # nothing is masked
    mask = np.zeros(bumpy.vertices.shape, bool)
    mask[5, 1] = True
    for shape in (
        (np.ma.masked_array(bumpy.vertices, mask=mask), bumpy.faces),
        (bumpy.vertices, np.ma.masked_array(bumpy.faces, mask=bumpy.faces == 7)),
    ):
        with pytest.raises(rholm.InvalidInputError, match=r"not a finite number|masked"):
            rholm.expand(shape, 4)
        with pytest.raises(rholm.InvalidInputError, match=r"not a finite number|masked"):
            rholm.Mesh(*shape)
    coeffs = rholm.expand(bumpy, 4).to_array()
    with pytest.raises(rholm.InvalidInputError, match="not finite"):
        rholm.from_array(np.ma.masked_array(coeffs, mask=coeffs == coeffs[0, 2, 1]))
    with pytest.raises(rholm.InvalidInputError):
        rholm.expand(bumpy, 4)(np.ma.masked_array([[0, 0, 1.0]], mask=[[0, 0, 1]]))
    ids = np.ma.masked_array(np.arange(len(bumpy.vertices)), mask=mask[:, 1])
    q = bumpy.with_attributes(id=ids).attributes["id"]
    assert np.isnan(q[5])
    assert q[6] == 6


def test_points_without_a_place_are_dropped_and_counted(ring):
    cloud = rholm.sample_surface(ring, 1500)
    n = len(cloud.points)
    bad = np.arange(n) % 7 == 0
    points = np.array(cloud.points)
    points[bad, np.arange(n)[bad] % 3] = np.nan
    points[0, 0] = np.inf
    scan = np.arange(n) % 2
    scalars = np.linspace(0, 1, n)
    known = (points[~bad], cloud.normals[~bad])
    calls = {
        "orient": lambda p, m, s, v: rholm.orient(p, m).cloud,
        "align_scans": lambda p, m, s, v: rholm.clouds.align_scans((p, m), s).cloud,
        "compress": lambda p, m, s, v: rholm.compress((p, m), tolerance=0.05).mesh(),
        "patch_atlas": lambda p, m, s, v: harmonics.patch_atlas((p, m), 4).atlas.mesh(),
        "patch_picture": lambda p, m, s, v: rholm.figures.patch_picture((p, m)),
        "render": lambda p, m, s, v: rholm.render((p, m), size=(64, 64)),
        "Panel": lambda p, m, s, v: rholm.render(rholm.Panel((p, m), scalars=v), size=(64, 64)),
    }
    for name, call in calls.items():
        with pytest.warns(UserWarning, match=f"^{bad.sum()} points with a coordinate .* dropped"):
            found = call(points, cloud.normals, scan, scalars)
        expected = call(*known, scan[~bad], scalars[~bad])
        if name in ("orient", "align_scans"):
            assert np.array_equal(found.points, expected.points), name
            assert np.array_equal(found.normals, expected.normals), name
        elif name in ("render", "Panel"):
            assert np.array_equal(np.asarray(found), np.asarray(expected)), name
        else:
            assert found == expected, name
    with pytest.raises(rholm.InvalidInputError, match="2 values"):
        rholm.Panel(points, scalars=[0.0, 1.0])


def test_attributes_keep_their_types(tmp_path, bumpy):
    n = len(bumpy.vertices)
    given = {
        "quality": np.linspace(0, 1, n, dtype="f4"),
        "flag": np.arange(n) % 2 == 0,
        "id": np.arange(n, dtype="i8"),
        "far": np.full(n, 2**40, dtype="i8"),
        "rgb": np.full((n, 3), [1, 2, 3], "u1"),
        "uv": np.zeros((n, 2)),
        "stress": np.ones((n, 6)),
    }
    mesh = rholm.Mesh(bumpy.vertices, bumpy.faces, given)
    mesh.save(tmp_path / "a.ply")
    for attributes in (mesh.attributes, rholm.read_shape(tmp_path / "a.ply").shape.attributes):
        assert attributes["quality"].dtype == np.float32
        assert attributes["flag"].dtype == np.uint8
        assert attributes["id"].dtype == np.int32
        assert attributes["far"].dtype == np.float64
        assert attributes["far"][3] == 2**40
        assert [attributes[c][5] for c in ("red", "green", "blue")] == [1, 2, 3]
        assert "stress_5" in attributes
        assert "u" in attributes
    with pytest.raises(rholm.InvalidInputError):
        rholm.Mesh(bumpy.vertices, bumpy.faces, {"short": np.zeros(3)})
    with pytest.raises(TypeError):
        rholm.Mesh(bumpy.vertices, bumpy.faces, {"text": np.full(n, "a")})


def test_shapes_and_expansions_can_be_pickled(bumpy):
    mesh = pickle.loads(pickle.dumps(bumpy.with_attributes(q=np.arange(len(bumpy.vertices)))))
    assert np.array_equal(mesh.vertices, bumpy.vertices)
    assert np.array_equal(mesh.faces, bumpy.faces)
    assert mesh.attributes["q"][7] == 7
    cloud = rholm.sample_surface(bumpy, 100)
    copy = pickle.loads(pickle.dumps(cloud))
    assert np.array_equal(copy.normals, cloud.normals)
    s = rholm.expand(bumpy, 8, length_unit="km")
    copy = pickle.loads(pickle.dumps(s))
    assert copy == s
    assert copy.unit == "km"
    assert copy.errors.rms == s.errors.rms
    assert copy.tail_strength == s.tail_strength


def test_a_mapped_file_is_the_mesh_of_the_file(tmp_path, bumpy):
    bumpy.save(tmp_path / "m.ply")
    vertices, triangles = rholm.files.map_mesh(tmp_path / "m.ply")
    assert np.array_equal(vertices, bumpy.vertices)
    assert np.array_equal(triangles, bumpy.faces)
    assert not vertices.flags.writeable
    bumpy.save(tmp_path / "m.off")
    assert rholm.files.map_mesh(tmp_path / "m.off") is None
    assert np.array_equal(
        rholm.expand((vertices, triangles), 8).coeffs, rholm.expand(tmp_path / "m.ply", 8).coeffs
    )


def test_an_empty_mesh_is_a_mesh():
    empty = rholm.Mesh([], [])
    assert empty.vertices.shape == empty.faces.shape == (0, 3)
    assert empty.area == 0
    assert rholm.inspect(empty).faces == 0


def test_directions_of_any_length_are_the_same(bumpy, random):
    s = rholm.expand(bumpy, 8)
    unit = random.normal(size=(50, 3))
    unit /= np.linalg.norm(unit, axis=1, keepdims=True)
    expected = s(unit)
    for length in (1e-320, 1e-300, 1e-160, 0.3, 7.0, 1e160, 1e300):
        # Numbers this small have fewer digits.
        limit = 1e-2 if length < 1e-310 else 1e-13
        assert np.allclose(s(length * unit), expected, rtol=limit), length
    assert np.shares_memory(_arrays.directions(unit)[0], unit)  # not copied
    for wrong in ([0, 0, 0], [np.nan, 0, 1], [np.inf, 0, 0]):
        with pytest.raises(rholm.InvalidInputError):
            s([[0, 0, 1], wrong])
