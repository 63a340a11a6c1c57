"""Conversion of other packages' meshes in both directions."""

from __future__ import annotations

import importlib
import sys
import warnings

import numpy as np
import pytest
import rholm
from rholm import harmonics


def same_surface(a: rholm.Mesh, b: rholm.Mesh) -> bool:
    return np.array_equal(a.faces, b.faces) and np.allclose(a.vertices, b.vertices, rtol=1e-6)


def test_trimesh(bumpy):
    trimesh = pytest.importorskip("trimesh")
    colored = bumpy.with_attributes(
        rgb=np.full((len(bumpy.vertices), 3), [10, 20, 30], "u1"), q=bumpy.vertices[:, 0]
    )
    there = colored.to_trimesh()
    assert isinstance(there, trimesh.Trimesh)
    assert there.is_watertight
    assert np.isclose(there.volume, bumpy.volume, rtol=1e-12)
    back = rholm.meshes.as_mesh(there)
    assert same_surface(back, bumpy)
    assert back.attributes["green"][0] == 20
    assert np.array_equal(back.attributes["q"], bumpy.vertices[:, 0])
    assert np.array_equal(rholm.expand(there, 8).coeffs, rholm.expand(bumpy, 8).coeffs)
    with pytest.raises(rholm.InvalidInputError):
        rholm.expand(trimesh.PointCloud(bumpy.vertices), 8)
    assert np.array_equal(rholm.clouds.as_points(trimesh.PointCloud(bumpy.vertices)).points, bumpy.vertices)
    scene = trimesh.Scene([there])
    assert np.isclose(rholm.meshes.as_mesh(scene).volume, bumpy.volume, rtol=1e-12)
    synthesized = rholm.expand(bumpy, 8).mesh(3)
    assert np.allclose(synthesized.to_trimesh().vertex_normals, synthesized.normals)


def test_pyvista(bumpy):
    pyvista = pytest.importorskip("pyvista")
    there = rholm.expand(bumpy, 8).mesh(3).to_pyvista()
    assert "Normals" in there.point_data
    assert there.n_cells == 1280
    back = rholm.meshes.as_mesh(there)
    assert "nx" in back.attributes
    data = bumpy.to_pyvista()
    assert np.allclose(rholm.expand(data, 8).coeffs, rholm.expand(bumpy, 8).coeffs, rtol=1e-12)
    quads = pyvista.Cube()
    assert np.isclose(rholm.meshes.as_mesh(quads).volume, 1)
    assert np.isclose(rholm.meshes.weld(pyvista.Sphere()).mesh.volume, np.pi / 6, rtol=0.02)
    grid = pyvista.ImageData(dimensions=(3, 3, 3))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert np.isclose(rholm.meshes.as_mesh(grid).area, 24)  # a cube of side 2

    class Older:  # of a PyVista without the choice
        __module__ = "pyvista.core.grid"

        def extract_surface(self, pass_pointid=True):
            return quads

    assert np.isclose(rholm.meshes.as_mesh(Older()).volume, 1)
    cloud = rholm.sample_surface(bumpy, 500).to_pyvista()
    assert rholm.clouds.as_points(cloud).normals is not None


def test_the_accessor_of_pyvista(bumpy):
    pyvista = pytest.importorskip("pyvista")

    importlib.import_module("rholm._pyvista")  # PyVista does this by the entry point of an installed package
    data = bumpy.to_pyvista()
    assert data.rholm.expand(8).degree == 8
    assert isinstance(data.rholm.repair(), pyvista.PolyData)
    assert data.rholm.compare(bumpy).hausdorff <= 1e-6


def test_meshio(bumpy, tmp_path):
    meshio = pytest.importorskip("meshio")
    there = bumpy.with_attributes(q=bumpy.vertices[:, 0]).to_meshio()
    there.write(tmp_path / "a.vtk")
    back = rholm.meshes.as_mesh(meshio.read(tmp_path / "a.vtk"))
    assert same_surface(back, bumpy)
    assert np.array_equal(back.attributes["q"], bumpy.vertices[:, 0])
    with pytest.raises(rholm.InvalidInputError):
        rholm.meshes.as_mesh(meshio.Mesh(bumpy.vertices, [("line", [[0, 1]])]))


def test_polygons_of_meshio_are_cut_into_triangles():
    meshio = pytest.importorskip("meshio")
    for n in (3, 4, 5, 6, 9):
        angle = 2 * np.pi * np.arange(n) / n
        ring = np.stack([np.cos(angle), np.sin(angle)], axis=1)
        points = np.concatenate([np.c_[ring, np.zeros(n)], np.c_[ring, np.ones(n)]])
        sides = [[i, (i + 1) % n, (i + 1) % n + n, i + n] for i in range(n)]
        ends = [np.arange(n)[::-1], np.arange(n) + n]
        for name in {{3: "triangle", 4: "quad"}.get(n, "polygon"), "polygon"}:
            prism = rholm.meshes.as_mesh(meshio.Mesh(points, [(name, ends), ("quad", sides)]))
            assert rholm.inspect(prism).closed
            assert prism.volume == pytest.approx(n / 2 * np.sin(2 * np.pi / n), rel=1e-12)
    # A polygon that is not convex is cut inside of it, as polygons of files are.
    star = [[0, 0, 0], [4, 0, 0], [4, 4, 0], [2, 1, 0], [0, 4, 0]]
    flat = rholm.meshes.as_mesh(meshio.Mesh(star, [("polygon", [[2, 3, 4, 0, 1]])]))
    assert flat.area == pytest.approx(16 - 6, rel=1e-12)
    for cells, said in (
        ([("polygon", [[0, 1, 2, 3, 9]])], "names a point"),
        ([("triangle6", [[0, 1, 2, 3, 4, 0]])], "triangle6"),
        ([("triangle", [[0, 1, 2]]), ("quad8", [[0, 1, 2, 3, 4, 0, 1, 2]])], "quad8"),
        ([("tetra", [[0, 1, 2, 3]])], "no polygons; its cells: tetra"),
    ):
        with pytest.raises(rholm.InvalidInputError, match=said):
            rholm.meshes.as_mesh(meshio.Mesh(star, cells))


def kinds_of_mesh(mesh, tmp_path):
    """Returns a mesh in every form that functions accept."""
    arrays = np.array(mesh.vertices), np.array(mesh.faces)
    mesh.save(tmp_path / "m.ply")
    kinds = [mesh, arrays, list(arrays), (arrays[0].tolist(), arrays[1].tolist()), rholm.meshes.weld(mesh)]
    kinds += [tmp_path / "m.ply", str(tmp_path / "m.ply"), rholm.read_shape(tmp_path / "m.ply")]
    for package, to in (("trimesh", "to_trimesh"), ("pyvista", "to_pyvista"), ("meshio", "to_meshio")):
        if importlib.util.find_spec(package):
            kinds.append(getattr(mesh, to)())
    return kinds


def test_every_function_takes_every_kind_of_mesh_and_mends_it(tmp_path):
    body = rholm.bumpy_sphere(2, 0.2, seed=5)
    inside_out = rholm.meshes.flip(body)
    corners = inside_out.faces.ravel()
    soup = rholm.Mesh(inside_out.vertices[corners], np.arange(len(corners)).reshape(-1, 3))
    quick = [
        lambda m: rholm.expand(m, 6).volume,
        lambda m: rholm.expand(m, degree=6, errors=False).expanded.transform.expansion.coefficients.degree,
        lambda m: harmonics.find_center(m, rays=100).star_shaped,
        lambda m: harmonics.check_star(m, (0, 0, 0), rays=100).star_shaped,
        lambda m: harmonics.make_star_chart(m, rays=100).report.star_shaped,
        lambda m: harmonics.vertex_error_strengths(m, (0, 0, 0)).radius > 0,
        lambda m: round(harmonics.truncation_errors(m, rholm.from_array([[[1.0]], [[0.0]]])).rms, 12),
        lambda m: rholm.clouds.as_points(m).normals.shape,
        lambda m: rholm.meshes.validate(m),
        lambda m: rholm.meshes.vertex_colors(m),
        lambda m: rholm.files.attributes_left_out(m, "stl"),
        lambda m: rholm.files.write_shape(m, tmp_path / "w.off"),
        lambda m: rholm.repair(m).mesh.volume,
        lambda m: rholm.inspect(m).faces,
        lambda m: len(rholm.sample_surface(m, 50)),
        lambda m: rholm.compare(m, body, samples=50).hausdorff < 1e-6,
    ]
    slow = [
        lambda m: rholm.render(m, (16, 16)).shape,  # render() takes a list as several shapes
        lambda m: rholm.compress(m, 0.3, samples=1000, max_numbers=10**6).mesh().volume > 0,
        lambda m: harmonics.patch_atlas(m, 2).mesh.volume > 0,
        lambda m: rholm.figures.patch_picture(m).area > 0,
        lambda m: rholm.reconstruct(m).mesh.volume > 0,
        lambda m: rholm.orient(m).report.points,
        lambda m: len(rholm.figures.view_data(rholm.expand(m, 4), shape=m)) > 0,
    ]
    kinds = kinds_of_mesh(soup, tmp_path)
    for function, some in [*((f, kinds) for f in quick), *((f, kinds[:2]) for f in slow)]:
        expected = function(kinds[0])
        assert expected is not False
        for kind in some[1:]:
            if isinstance(kind, tuple) and hasattr(kind, "merged_vertices"):
                function(kind)  # weld() returns fewer vertices
            else:
                assert repr(function(kind)) == repr(expected), type(kind)


def test_pairs_of_arrays_are_meshes_or_points_by_their_numbers(ring):
    cloud = rholm.sample_surface(ring, 1000)
    points, normals = np.array(cloud.points), np.array(cloud.normals)
    for pair in ((points, normals), [points, normals], (points.tolist(), normals.tolist())):
        assert len(rholm.compress(pair, 0.2)) > 0
        assert np.array_equal(rholm.clouds.as_points(pair).normals, normals)
    two = [[0.0, 0, 0], [1, 0, 0]]  # a list of points, not a pair
    assert len(rholm.clouds.as_points(two)) == 2
    assert len(rholm.clouds.as_points(np.array(two))) == 2


def test_xarray(bumpy):
    pytest.importorskip("xarray")
    s = rholm.expand(bumpy, 6, length_unit="km")
    array = s.to_xarray()
    assert array.dims == ("kind", "l", "m")
    assert float(array.sel(kind="s", l=3, m=2)) == s.coeffs[1, 3, 2]
    assert array.attrs["units"] == "km"


def test_matplotlib(bumpy):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    s = rholm.expand(bumpy, 12)
    _, ax = plt.subplots()
    assert s.plot_spectrum(ax=ax, label="body") is ax
    assert len(ax.lines) == 2  # with the predicted tail
    assert np.array_equal(ax.lines[0].get_ydata(), s.spectrum("energy")[1:])
    assert [text.get_text() for text in ax.get_legend().get_texts()] == ["body", "predicted tail"]
    plt.close("all")


def test_what_is_not_installed_is_asked_for_by_name(monkeypatch, bumpy):
    def fail(name: str) -> None:
        raise ImportError(name)

    monkeypatch.setattr(importlib, "import_module", fail)
    with pytest.raises(ImportError, match=r"pip install 'rholm\[trimesh\]'"):
        bumpy.to_trimesh()


def test_a_package_that_is_missing_is_named(bumpy, monkeypatch):
    monkeypatch.setitem(sys.modules, "meshio", None)
    with pytest.raises(ImportError, match=r"pip install 'rholm\[meshio\]'") as refusal:
        bumpy.to_meshio()
    assert refusal.value.name == "meshio"
