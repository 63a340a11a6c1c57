"""Meshes and points: files, repair, atlases, edits, pictures."""

from __future__ import annotations

import pickle

import numpy as np
import pytest
import rholm
from rholm import harmonics


def test_files_of_shapes_come_back(bumpy, tmp_path):
    for name in ("a.ply", "a.obj", "a.off", "a.stl"):
        bumpy.save(tmp_path / name)
        read = rholm.read_shape(tmp_path / name)
        assert read.format == name[2:]
        mesh = rholm.meshes.weld(read.shape).mesh
        assert np.isclose(mesh.volume, bumpy.volume, rtol=1e-5)
        assert np.isclose(rholm.meshes.as_mesh(tmp_path / name).area, bumpy.area, rtol=1e-5)
        again = rholm.files.parse_shape((tmp_path / name).read_bytes(), name)
        assert np.array_equal(again.shape.vertices, read.shape.vertices)
    cloud = rholm.sample_surface(bumpy, 50)
    cloud.save(tmp_path / "p.xyz")
    assert np.array_equal(rholm.clouds.as_points(tmp_path / "p.xyz").points, cloud.points)
    assert rholm.files.attributes_left_out(bumpy.with_attributes(q=bumpy.vertices[:, 0]), "stl") == ["q"]
    with pytest.raises(rholm.InvalidInputError, match="points"):
        rholm.expand(tmp_path / "p.xyz", 4)


@pytest.mark.parametrize(
    ("data", "error"),
    [
        (b"", rholm.InvalidInputError),
        (b"ply\nformat ascii 1.0\nelement vertex 3\n", rholm.InvalidInputError),
        (
            b"ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty double x\n"
            b"property double y\nproperty double z\nend_header\nabc",
            rholm.InvalidInputError,
        ),
        (b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 nan\n3 0 1 2\n", rholm.InvalidInputError),
        (b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n", rholm.InvalidInputError),
        (b"solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0", rholm.InvalidInputError),
        (b"\x89HDF\r\n\x1a\n" + b"\0" * 100, rholm.Error),
        (b"\xff\xfe\x00\x01" * 50, rholm.Error),
    ],
)
def test_malformed_files_are_refused(tmp_path, data, error):
    for name in ("f.ply", "f.off", "f.stl"):
        path = tmp_path / name
        path.write_bytes(data)
        for read in (rholm.read_shape, rholm.load, lambda p: rholm.expand(p, 4), rholm.clouds.as_points):
            with pytest.raises(rholm.Error) as refusal:
                read(path)
            assert len(str(refusal.value)) > 5
        with pytest.raises(error):
            rholm.read_shape(path)


def test_files_that_cannot_be_read_or_written(bumpy, tmp_path):
    with pytest.raises(rholm.IoError) as refusal:
        rholm.read_shape(tmp_path / "none.ply")
    assert isinstance(refusal.value, OSError)
    s = rholm.expand(bumpy, 4)
    for write, name in (
        (bumpy.save, "a.ply"),
        (s.save, "a.h5"),
        (s.report_html, "a.html"),
        (lambda p: rholm.render(bumpy, (64, 64), path=p), "a.png"),
    ):
        with pytest.raises(rholm.IoError):
            write(tmp_path / "no" / name)
    with pytest.raises(rholm.UnsupportedError):
        bumpy.save(tmp_path / "a.docx")
    assert list(tmp_path.iterdir()) == []


def test_inspection_and_repair(bumpy):
    report = rholm.inspect(bumpy)
    assert report.closed
    assert report.manifold
    assert report.genus == 0
    assert report.vertices - report.edges + report.faces == 2
    assert rholm.inspect(rholm.torus(2, 1, 12, 8)).genus == 1
    assert rholm.meshes.pair_edges(bumpy).shape == (report.edges, 4)
    hole = rholm.Mesh(bumpy.vertices, bumpy.faces[5:])
    assert not rholm.inspect(hole).closed
    mended = rholm.repair(hole)
    assert mended.report.closed_holes > 0
    assert rholm.inspect(mended.mesh).closed
    assert rholm.meshes.closing_tolerance(bumpy) is None
    soup = rholm.Mesh(
        bumpy.vertices[bumpy.faces].reshape(-1, 3), np.arange(3 * len(bumpy.faces)).reshape(-1, 3)
    )
    assert rholm.meshes.weld(soup).merged_vertices == len(soup.vertices) - len(bumpy.vertices)
    assert np.isclose(rholm.meshes.flip(bumpy).volume, -bumpy.volume)
    fewer = rholm.simplify(bumpy, faces=200)
    assert len(fewer.mesh.faces) <= 200
    assert rholm.inspect(fewer.mesh).genus == 0
    two = rholm.Mesh(
        np.concatenate([bumpy.vertices, rholm.icosphere(0).vertices * 0.1 + 9]),
        np.concatenate([bumpy.faces, rholm.icosphere(0).faces + len(bumpy.vertices)]),
    )
    assert len(rholm.meshes.largest_component(two).faces) == len(bumpy.faces)
    assert np.allclose(np.linalg.norm(bumpy.normals, axis=1), 1)
    assert np.allclose(rholm.meshes.area_normals(rholm.box((1, 1, 1))).sum(axis=0), 0)
    assert rholm.meshes.bounds(bumpy.vertices).diagonal == bumpy.bounds.diagonal
    assert rholm.meshes.surface_area(rholm.box((1, 2, 3))) == pytest.approx(22)
    assert rholm.meshes.enclosed_volume(rholm.box((1, 2, 3))) == pytest.approx(6)
    with pytest.raises(rholm.InvalidInputError):
        rholm.simplify(bumpy)


def test_points_are_cleaned_and_oriented(ring, random):
    cloud = rholm.sample_surface(ring, 4000)
    points = np.concatenate([cloud.points, cloud.points[:5], [[np.nan, 0, 0]]])
    cleaned = rholm.clouds.clean(points)
    assert cleaned.report.not_finite == 1
    assert cleaned.report.duplicates == 5
    oriented = rholm.orient(cloud.points)
    agreement = (oriented.cloud.normals * cloud.normals).sum(axis=1)
    assert (agreement > 0.8).mean() > 0.99
    wrong = cloud.normals * np.where(random.random(len(cloud)) < 0.5, 1, -1)[:, None]
    signs = rholm.orient(cloud.points, wrong, keep_directions=True)
    assert ((signs.cloud.normals * cloud.normals).sum(axis=1) > 0.999).mean() > 0.99
    out = rholm.orient(rholm.icosphere(4).vertices, center=(0, 0, 0)).cloud
    assert ((out.normals * out.points).sum(axis=1) > 0.9).all()


def test_scans_are_brought_together(ring):
    scans = rholm.sample_surface(ring, 4000, scans=4, misalignment=0.01, sensor=True)
    made = rholm.clouds.align_scans(scans)
    assert made.report.scans == 4
    assert made.report.distance < made.report.distance_before / 3
    way = np.asarray(made.cloud.points) - scans.points
    assert made.report.moved == pytest.approx(np.sqrt((way**2).sum(1).mean()))
    bare = rholm.clouds.align_scans(scans.points, scans.attributes["scan"])
    assert bare.report.scans == 4
    assert rholm.clouds.align_scans(scans.points).report.scans == 0
    surface = rholm.reconstruct(scans)
    assert surface.report.scans.scans == 4
    assert rholm.inspect(surface.mesh).genus == 1
    assert rholm.reconstruct(scans, keep_scans=True).report.scans.scans == 0
    seen = rholm.reconstruct(scans.points, sensor=(0, 0, 30), holes="keep", keep_scans=True)
    assert "sensor_x" not in seen.mesh.attributes


def test_confidence_of_points_and_of_surfaces(ring):
    points = rholm.sample_surface(ring, 4000).points
    far = np.concatenate([points, [[1e6, 0, 0]]])
    oriented = rholm.orient(far, confidence=True)
    assert oriented.report.outliers == 1
    confidence = oriented.cloud.attributes["confidence"]
    assert confidence[-1] == 0
    assert confidence[:-1].min() > 0.9
    assert rholm.orient(far, keep_outliers=True).report.outliers == 0
    whole = rholm.reconstruct(points, confidence=True)
    part = rholm.reconstruct(points[points[:, 0] > -1], confidence=True)
    assert whole.report.unseen_area == 0
    assert part.report.unseen_area > 0.05
    assert part.report.unsure_area >= part.report.unseen_area
    assert 0 <= part.mesh.attributes["confidence"].min() < 0.1
    assert whole.mesh.attributes["confidence"].min() > 0.9
    assert np.isclose(whole.report.volume, rholm.meshes.enclosed_volume(whole.mesh))


def test_given_normals_that_contradict_each_other_are_turned_or_told():
    rng = np.random.default_rng(1)
    points = rng.normal(size=(2000, 3))
    points /= np.linalg.norm(points, axis=1)[:, None]
    turned = rng.random(2000) < 0.3
    r = rholm.reconstruct(points, np.where(turned[:, None], -points, points))
    assert r.report.mended_normals == turned.sum()
    assert r.report.volume == pytest.approx(4 / 3 * np.pi, rel=0.02)
    # Points that fill a ball are refused, or they look like a thick wall (2 of 8 balls), and the report
    # says that most lie off the surface.
    refused = []
    for part in rng.random((4, 2000, 1)):
        try:
            assert rholm.reconstruct(points * part ** (1 / 3)).report.points_off_surface > 0.5
        except rholm.InvalidInputError as error:
            refused.append(str(error))
    assert refused
    assert all("volume" in said for said in refused)


def test_surfaces_from_points_carry_attributes(ring):
    cloud = rholm.sample_surface(ring, 8000)
    height = cloud.points[:, 2]
    rgb = np.round(255 * (cloud.points - cloud.points.min(0)) / np.ptp(cloud.points, axis=0)).astype("u1")
    r = rholm.reconstruct(cloud.points, cloud.normals, {"rgb": rgb, "height": height}, holes="fill")
    report = rholm.inspect(r.mesh)
    assert report.closed
    assert report.genus == 1
    assert np.isclose(report.volume, 2 * np.pi**2 * 2 * 0.49, rtol=0.02)
    # The attribute is an average over the nearest points.
    assert np.abs(r.mesh.attributes["height"] - r.mesh.vertices[:, 2]).max() < 2 * r.report.spacing
    assert r.mesh.colors.shape == (len(r.mesh.vertices), 3)
    assert len(r.atlas) == r.report.caps
    assert r.atlas.rules.left_out == ["red", "green", "blue", "height"]
    assert r.atlas.rules.holes == "fill"
    assert len(rholm.reconstruct(cloud, simplify="auto").mesh.faces) < len(r.mesh.faces)
    with pytest.raises(rholm.InvalidInputError, match="16"):
        rholm.reconstruct(cloud.points[:5])
    with pytest.raises(rholm.OutOfMemoryError) as refusal:
        rholm.reconstruct(cloud, step=1e-5)
    assert isinstance(refusal.value, MemoryError)
    with pytest.raises(rholm.InvalidInputError):
        rholm.reconstruct(cloud, holes="dig")


@pytest.mark.parametrize("holes", ["fill", "keep"])
@pytest.mark.parametrize("simplify", [None, 500])
def test_the_atlas_of_open_points_gives_their_surface_again(tmp_path, holes, simplify):
    i = np.arange(3000) + 0.5
    z, phi = 1 - 2 * i / 3000, i * np.pi * (3 - np.sqrt(5))
    ball = np.stack([np.sqrt(1 - z * z) * np.cos(phi), np.sqrt(1 - z * z) * np.sin(phi), z], 1)
    half = ball[z < 0.2]
    for normals in (half, None):
        r = rholm.reconstruct(half, normals, holes=holes, simplify=simplify)
        r.atlas.save(tmp_path / "half.h5")
        for atlas in (r.atlas, rholm.load(tmp_path / "half.h5"), pickle.loads(pickle.dumps(r.atlas))):
            again = atlas.mesh()
            assert np.array_equal(again.vertices, r.mesh.vertices)
            assert np.array_equal(again.faces, r.mesh.faces)
            assert atlas.rules == r.atlas.rules
        assert len(r.atlas.mesh(simplify={"share": 1}).faces) >= len(r.mesh.faces)
    tiled = rholm.reconstruct(half, tile_points=1000)
    tiled.atlas.save(tmp_path / "b.h5")
    assert rholm.load(tmp_path / "b.h5").rules.tiles


def test_compression_keeps_its_tolerance(ring, tmp_path):
    a = rholm.compress(ring, 2e-2, unit="diagonal")
    assert a.report.met
    assert a.errors.rms <= 2e-2 * ring.bounds.diagonal
    assert a.size.numbers < 3 * len(ring.vertices)
    mesh = a.mesh()
    assert rholm.inspect(mesh).genus == 1
    assert rholm.compare(ring, mesh).a_to_b.rms <= 1.1 * a.errors.rms
    a.save(tmp_path / "a.h5")
    assert rholm.files.is_atlas_file(tmp_path / "a.h5")
    back = rholm.load(tmp_path / "a.h5")
    assert isinstance(back, rholm.Atlas)
    # The file stores frames of caps in single precision.
    assert rholm.compare(harmonics.synthesize(back), mesh).hausdorff < 1e-6
    assert rholm.files.read_atlas(tmp_path / "a.h5").size.numbers == harmonics.size_of(a).numbers
    caps = a.dominant_caps(ring.vertices)
    assert caps.max() < len(a)
    cap = a.cap(0)
    assert len(a.coefficients_of(0)) == harmonics.n_coefficients(cap.basis, cap.degree)
    assert harmonics.highest_degree(a) == max(a.cap(i).degree for i in range(len(a)))
    # No cap has samples farther from its surface than four tolerances.
    step = 0.01 * cap.axes[2]
    distance, gradient, valid = a.evaluate(0, [cap.seed, cap.seed + step])
    assert valid.all()
    assert abs(distance[0]) <= 4 * 2e-2 * ring.bounds.diagonal
    assert np.isclose(distance[1] - distance[0], gradient[0] @ step, rtol=0.02)
    assert np.isclose(np.linalg.norm(gradient[0]), 1, rtol=0.1)
    assert a.colored(ring).colors.shape == (len(ring.vertices), 3)
    assert a.colored(ring, by="degree").colors is not None
    with pytest.raises(IndexError):
        a.cap(len(a))
    with pytest.raises(rholm.InvalidInputError):
        rholm.figures.set_cap_colors(ring, a, np.full(len(ring.vertices), 10**6))
    with pytest.raises(TypeError):
        rholm.Atlas()
    assert "caps" in a._repr_html_()
    assert "<html" in a.report_html(picture_size=64)


def test_the_papers_atlas(ring):
    made = harmonics.patch_atlas(ring, 6)
    assert len(made.atlas) > 1
    assert made.rms_along_rays > 0
    assert len(made.mesh.faces) > 0
    picture = rholm.figures.patch_picture(ring, "triangles")
    assert picture.colors is not None


def test_smoothing_takes_noise_from_a_region_only(random):
    sphere = rholm.icosphere(5)
    noise = 1 + 0.004 * random.normal(size=(len(sphere.vertices), 1))
    rough = rholm.Mesh(sphere.vertices * noise, sphere.faces)
    region = sphere.vertices[:, 2] > 0.7
    smooth = rholm.smooth(rough, region, wavelength=0.4, fitting="mean")
    inner = sphere.vertices[:, 2] > 0.75
    before = np.abs(np.linalg.norm(rough.vertices[inner], axis=1) - 1).mean()
    after = np.abs(np.linalg.norm(smooth.vertices[inner], axis=1) - 1).mean()
    assert after < 0.4 * before
    weights = rholm.meshes.region_weights(rough, region, 0.4)
    assert np.array_equal(smooth.vertices[weights == 0], rough.vertices[weights == 0])
    same = rholm.smooth(rough, ["ball:0,0,1,0.5"], 0.4, strength=0)
    assert np.array_equal(same.vertices, rough.vertices)
    by_index = rholm.smooth(rough, np.flatnonzero(region), 0.4, fitting="mean")
    assert np.array_equal(by_index.vertices, smooth.vertices)
    for wrong in (np.ones(3, bool), np.array([10**9]), "cone:1", np.full(len(region), np.nan), [-1]):
        with pytest.raises(rholm.InvalidInputError):
            rholm.smooth(rough, wrong, 0.4)
    with pytest.raises(rholm.InvalidInputError):
        rholm.smooth(rough, region, 1e-9)


def test_the_whole_mesh_is_a_region(random):
    ball = rholm.icosphere(5)
    rough = rholm.Mesh(ball.vertices * (1 + 0.004 * random.normal(size=(len(ball.vertices), 1))), ball.faces)
    smooth = rholm.smooth(rough, None, 0.4)
    # Waves longer than 0.4 are about (2 pi/0.4 + 1)^2 = 280 numbers for 10 242 vertices: about 1/6
    # of the noise remains, and half of that again where the caps' fits differ.
    assert np.std(np.linalg.norm(smooth.vertices, axis=1)) < 0.004 / 3
    everywhere = rholm.smooth(rough, np.ones(len(ball.vertices)), 0.4)
    assert np.array_equal(everywhere.vertices, smooth.vertices)
    assert np.array_equal(rholm.smooth(rough, "box:-2,-2,-2,2,2,2", 0.4).vertices, smooth.vertices)
    assert (rholm.meshes.region_weights(rough, None) == 1).all()
    with pytest.raises(rholm.InvalidInputError, match="nothing around"):
        rholm.smooth(rough, None, 0.4, fitting="around")
    with pytest.raises(rholm.InvalidInputError, match="no vertex"):
        rholm.smooth(rough, np.zeros(len(ball.vertices), bool), 0.4)


def test_an_editor_moves_its_mesh_in_place(bumpy):
    fine = rholm.expand(bumpy, 24).mesh(5)
    editor = rholm.meshes.analyze_patch(fine, "ball:0,0,1,0.6", 0.5)
    vertices = editor.mesh.vertices
    before = vertices.copy()
    editor.strength = 1
    assert not np.array_equal(vertices, before)  # the same array
    moved = editor.vertices
    assert np.array_equal(vertices[moved], editor.positions())
    still = np.setdiff1d(np.arange(len(before)), moved)
    assert np.array_equal(vertices[still], before[still])
    half = editor.positions(strength=0.5)
    assert np.allclose(half, (before[moved] + vertices[moved]) / 2, atol=1e-12)
    editor.wavelength = editor.longest_wavelength
    assert rholm.meshes.longest_wavelength(editor) == editor.wavelength
    editor.strength = 0
    assert np.array_equal(vertices, before)
    assert np.array_equal(fine.vertices, before)
    applied = rholm.meshes.apply(editor, rholm.meshes.update(editor, strength=1.0, wavelength=0.5), fine)
    assert not np.array_equal(applied.vertices, before)
    with pytest.raises(rholm.InvalidInputError):
        editor.strength = np.nan
    assert editor.strength == 0
    with pytest.raises(rholm.InvalidInputError):
        rholm.meshes.apply(editor, np.zeros((3, 3)), fine)


def test_detail_is_transferred(random):
    plain = rholm.icosphere(5)
    waves = 1 + 0.01 * np.sin(40 * plain.vertices[:, :1])
    rough = rholm.Mesh(plain.vertices * waves, plain.faces)
    at = "ball:0,0,1,0.5"
    there = rholm.transfer(rough, at, plain, at, angle=0.0)
    inner = np.linalg.norm(plain.vertices - [0, 0, 1], axis=1) < 0.3
    radii = np.linalg.norm(there.vertices[inner], axis=1)
    assert np.corrcoef(radii - 1, waves[inner, 0] - 1)[0, 1] > 0.8
    editor = rholm.meshes.analyze_transfer(rough, at, plain, plain.vertices[:, 2] > 0.87)
    start = editor.mesh.vertices.copy()
    assert np.array_equal(start, plain.vertices)
    editor.height = 2
    editor.angle = 0.3
    assert not np.array_equal(editor.mesh.vertices, start)
    editor.height = 0
    assert np.array_equal(editor.mesh.vertices, start)
    with pytest.raises(TypeError, match="slider"):
        editor.set(hight=1)


def test_a_texture_is_taken_once_for_several_targets():
    plain = rholm.icosphere(5)
    rough = rholm.Mesh(plain.vertices * (1 + 0.01 * np.sin(40 * plain.vertices[:, :1])), plain.faces)
    at, other = "ball:0,0,1,0.5", "ball:0,1,0,0.6"
    texture = rholm.meshes.analyze_source(rough, at, from_degree=6)
    assert texture.from_degree == 6
    assert texture.wavelength == pytest.approx(4 * texture.radius / 6)
    assert texture.radius == pytest.approx(0.5, rel=0.02)
    for target, region in ((plain, at), (rough, other), (plain, other)):
        editor = texture.onto(target, region, scale=0.9)
        editor.height = 1
        at_once = rholm.transfer(rough, at, target, region, scale=0.9, from_degree=6)
        assert np.array_equal(editor.mesh.vertices, at_once.vertices)
        assert not np.array_equal(at_once.vertices, target.vertices)
        assert editor.report.source_rms == texture.rms > 0
        assert editor.report.source_edge == texture.edge


def test_distances(bumpy):
    assert rholm.compare(bumpy, bumpy).hausdorff < 1e-14
    larger = rholm.Mesh(2 * rholm.icosphere(4).vertices, rholm.icosphere(4).faces)
    c = rholm.compare(rholm.icosphere(4), larger, samples=2000)
    assert c.a_to_b.rms == pytest.approx(1, rel=0.01)
    assert c.to_dict()["a_to_b"]["rms"] == c.a_to_b.rms
    d = rholm.meshes.distances_to_surface([[0, 0, 3], [0, 0, 0]], rholm.box((2, 2, 2)))
    assert np.allclose(d, [2, 1])
    with pytest.raises(rholm.InvalidInputError):
        rholm.compare(bumpy, bumpy, samples=0)


def test_pictures(bumpy, tmp_path):
    picture = rholm.render(bumpy, (120, 80), path=tmp_path / "a.png")
    assert picture.shape == (80, 120, 3)
    assert picture.dtype == np.uint8
    assert picture.std() > 10  # the picture is not empty
    assert (tmp_path / "a.png").read_bytes() == picture.png() == rholm.figures.encode_png(picture)
    picture.save(tmp_path / "b.png")
    assert picture._repr_png_()[:4] == b"\x89PNG"
    s = rholm.expand(bumpy, 6)
    panels = [
        rholm.Panel(bumpy, "mesh", scalars=bumpy.vertices[:, 0]),
        s,
        rholm.Panel(s, colors=np.ones((2562, 3))),
    ]
    assert rholm.render(panels, (300, 100)).shape == (100, 300, 3)
    for thing in (bumpy, s):
        assert thing._repr_png_()[:4] == b"\x89PNG"
    assert "<svg" in s._repr_html_()
    with pytest.raises(rholm.InvalidInputError):
        rholm.render(rholm.Panel(bumpy, scalars=[1, 2]))
    with pytest.raises(rholm.InvalidInputError):
        rholm.render(bumpy, (1, 1))
    with pytest.raises(rholm.InvalidInputError):
        rholm.figures.write_png(tmp_path / "c.png", np.zeros((3, 3)))
    rholm.files.write_file(tmp_path / "d.txt", b"abc")
    assert (tmp_path / "d.txt").read_bytes() == b"abc"


def test_a_copy_stays_where_it_is(bumpy):
    mesh = bumpy.with_attributes(q=np.arange(len(bumpy.vertices)))
    copy = mesh.copy()
    assert np.array_equal(copy.vertices, mesh.vertices)
    assert np.array_equal(copy.faces, mesh.faces)
    assert np.array_equal(copy.attributes["q"], mesh.attributes["q"])
    assert not np.shares_memory(copy.vertices, mesh.vertices)
    editor = rholm.meshes.analyze_patch(mesh, "vertex:0,0.5", 0.6)
    before = editor.mesh.copy()
    editor.strength = 1
    assert np.array_equal(before.vertices, mesh.vertices)
    assert not np.array_equal(editor.mesh.vertices, mesh.vertices)


def test_points_are_drawn_as_balls(bumpy, tmp_path):
    cloud = rholm.sample_surface(bumpy, 3000)
    picture = rholm.render(cloud, (96, 80))
    assert (picture[40, 48] != 255).any()  # no gaps in front
    assert np.array_equal(rholm.render(cloud.points, (96, 80)), picture)
    cloud.save(tmp_path / "a.ply")
    assert np.array_equal(rholm.render(tmp_path / "a.ply", (96, 80)), picture)
    assert np.array_equal(cloud.render(size=(96, 80)), picture)
    small = rholm.render(cloud, (96, 80), point_radius=1e-3)
    assert (small == 255).sum() > (picture == 255).sum()
    red = rholm.clouds.as_points(cloud, attributes={"rgb": np.tile(np.uint8([255, 0, 0]), (3000, 1))})
    assert np.array_equal(red.colors, np.tile([1, 0, 0], (3000, 1)))
    assert cloud.colors is None
    drawn = rholm.render(red, (96, 80))
    assert drawn[40, 48, 0] > 100
    assert drawn[40, 48, 1] == 0
    assert np.array_equal(drawn, rholm.render(cloud, (96, 80), colors=red.colors))
    assert not np.array_equal(rholm.render(cloud, (96, 80), scalars=cloud.points[:, 0]), picture)
    assert red._repr_png_()[:4] == b"\x89PNG"
    assert rholm.PointCloud(np.empty((0, 3)))._repr_png_() is None
    both = rholm.render([rholm.Panel(cloud, "points"), rholm.Panel(bumpy, "mesh")], (200, 80))
    assert both.shape == (80, 200, 3)
    for wrong in (
        lambda: rholm.render(cloud, scalars=[1, 2]),
        lambda: rholm.render(cloud, colors=np.ones((2, 3))),
        lambda: rholm.render(cloud, point_radius=0),
        lambda: rholm.render(cloud, point_radius=np.nan),
        lambda: rholm.render(rholm.Panel(cloud), scalars=cloud.points[:, 0]),
        lambda: rholm.render(np.empty((0, 3))),
        lambda: rholm.render(np.array([[np.nan, 0, 0]])),
    ):
        with pytest.raises(rholm.InvalidInputError):
            wrong()


def test_a_sample_has_the_attributes_of_its_places(bumpy):
    linear = 1 + bumpy.vertices @ [1, -2, 3]
    colors = np.clip(np.round(128 + 60 * bumpy.vertices), 0, 255).astype(np.uint8)
    mesh = bumpy.with_attributes(linear=linear, rgb=colors)
    cloud = rholm.sample_surface(mesh, 2000, noise=0)
    assert np.array_equal(cloud.points, rholm.sample_surface(bumpy, 2000).points)
    # Values are below 16, with about ten roundings each.
    assert np.abs(cloud.attributes["linear"] - (1 + cloud.points @ [1, -2, 3])).max() < 160 * 2**-53
    assert cloud.attributes["red"].dtype == np.uint8
    assert np.abs(cloud.attributes["red"] - (128 + 60 * cloud.points[:, 0])).max() <= 1  # rounded twice
    assert "nx" not in rholm.sample_surface(rholm.expand(bumpy, 8).mesh(4), 10).attributes


def test_samples_in_patterns_and_of_scans(ring):
    slices = rholm.sample_surface(ring, 2000, pattern="slices", pattern_ratio=5, pattern_axis=[0, 0, 2])
    heights = np.unique(np.round(slices.points[:, 2], 9))
    assert 1500 < len(slices.points) < 2500
    assert len(heights) < 20
    assert np.allclose(np.diff(heights), heights[1] - heights[0])
    scans = rholm.sample_surface(ring, 500, scans=4, misalignment=0.01, scan_noise=0.001, sensor=True)
    assert set(scans.attributes["scan"]) == {0, 1, 2, 3}
    sensors = np.stack([scans.attributes[f"sensor_{axis}"] for axis in "xyz"], axis=1)
    assert len(np.unique(sensors, axis=0)) == 4
    for options in ({"pattern": "lines"}, {"pattern": "spiral"}, {"pattern_axis": (0, 0, 0)}):
        with pytest.raises(rholm.InvalidInputError):
            rholm.sample_surface(ring, 100, **options)


def wheel(teeth):
    """A disc with teeth: a prism over a polygon about the origin."""
    angles = (2 * np.pi / teeth * (np.arange(teeth)[:, None] + [0, 0.2, 0.3, 0.55, 0.65, 0.8])).ravel()
    radii = np.tile([1, 1, 1.25, 1.25, 1, 1], teeth)
    n = len(angles)
    ring = np.c_[radii * np.cos(angles), radii * np.sin(angles)]
    vertices = np.r_[
        np.c_[ring, np.full(n, -0.35)], np.c_[ring, np.full(n, 0.35)], [[0, 0, -0.35], [0, 0, 0.35]]
    ]
    k, zero = np.arange(n), np.zeros(n, dtype=int)
    after = (k + 1) % n
    sides = np.r_[np.c_[k, after, n + after], np.c_[k, n + after, n + k]]
    ends = np.r_[np.c_[after, k, zero + 2 * n], np.c_[n + k, n + after, zero + 2 * n + 1]]
    return rholm.Mesh(vertices, np.r_[sides, ends])


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_true_normals_of_few_points_do_no_harm(seed):
    # Normals turn by right angles between neighbours; no cap has such a slope everywhere.
    body = wheel(16)
    cloud = rholm.sample_surface(body, 1000, seed=seed)
    known = rholm.reconstruct(cloud.points, normals=cloud.normals)
    unknown = rholm.reconstruct(cloud.points)
    with_normals, without = (rholm.compare(x.mesh, body, samples=20000).a_to_b.rms for x in (known, unknown))
    assert with_normals < 1.3 * without
    assert with_normals < 0.3 * known.report.spacing


def test_columns_of_arrays_and_of_text_are_taken_for_the_same(tmp_path):
    cloud = rholm.sample_surface(rholm.icosphere(3), 60)
    colors = np.arange(180).reshape(60, 3)
    table = np.hstack([cloud.points, colors, cloud.normals])
    np.savetxt(tmp_path / "table.txt", table)
    taken = ("x", "y", "z", "r", "g", "b", "nx", "ny", "nz")
    file = rholm.read_shape(tmp_path / "table.txt")
    assert file.columns == file.shape.columns == taken
    assert "by their values" in file.note
    assert not file.unsure
    for read in (file.shape, rholm.PointCloud(table), rholm.clouds.as_points(table.tolist())):
        np.testing.assert_array_equal(read.points, cloud.points)
        np.testing.assert_array_equal(read.normals, cloud.normals)
        np.testing.assert_array_equal(read.attributes["green"], colors[:, 1])
        assert read.columns == taken
    assert rholm.PointCloud(cloud.points).columns == ()
    with_normals = table[:, [0, 1, 2, 6, 7, 8]]
    np.testing.assert_array_equal(rholm.PointCloud(with_normals).normals, cloud.normals)


def test_columns_can_be_said(tmp_path):
    cloud = rholm.sample_surface(rholm.icosphere(3), 60)
    table = np.hstack([cloud.normals, cloud.points, np.ones((60, 1))])
    np.savetxt(tmp_path / "table.csv", table, delimiter=";")
    columns = "nx,ny,nz,x,y,z,weight"
    for shape in (table, tmp_path / "table.csv"):
        read = rholm.clouds.as_points(shape, columns=columns.split(","))
        np.testing.assert_array_equal(read.points, cloud.points)
        np.testing.assert_array_equal(read.normals, cloud.normals)
        assert list(read.attributes) == ["weight"]
    oriented = rholm.orient(tmp_path / "table.csv", columns="-,-,-,x,y,z,-").cloud
    np.testing.assert_array_equal(oriented.points, cloud.points)
    for wrong in ("x,y", "x,y,z,x,a,b,c", "x,y,z"):
        with pytest.raises(rholm.InvalidInputError):
            rholm.PointCloud(table, columns=wrong)
    with pytest.warns(UserWarning, match=r"0 \.\.\. 1"):
        rholm.PointCloud(np.hstack([cloud.points, np.abs(cloud.points) ** 2 / 3]))


def test_points_without_a_place_are_dropped_and_counted(tmp_path):
    cloud = rholm.sample_surface(rholm.icosphere(3), 60)
    points = cloud.points.copy()
    points[::9] = np.nan
    np.savetxt(tmp_path / "gaps.xyz", points)
    file = rholm.read_shape(tmp_path / "gaps.xyz")
    assert file.dropped == 7
    assert len(file.shape) == 53
    with pytest.warns(UserWarning, match="7 points"):
        rholm.clouds.as_points(tmp_path / "gaps.xyz")


def test_single_precision_that_spoils_a_shape_warns(tmp_path):
    ball = rholm.icosphere(3)
    ball.save(tmp_path / "near.stl")
    far = rholm.Mesh(ball.vertices + np.array([0, 5155487, 0]), ball.faces)
    far.save(tmp_path / "text.stl", ascii=True)
    with pytest.warns(UserWarning, match=r"steps of 0\.5.*of 1280 faces"):
        far.save(tmp_path / "far.stl")
