"""Meshes of other packages, in and out."""

from __future__ import annotations

import importlib
import sys
import warnings

import numpy as np
import pytest
import rholm


def same_surface(a: rholm.Mesh, b: rholm.Mesh) -> bool:
    return np.array_equal(a.triangles, b.triangles) and np.allclose(a.vertices, b.vertices, rtol=1e-6)


def test_trimesh(bumpy):
    trimesh = pytest.importorskip("trimesh")
    colored = bumpy.with_attributes(
        rgb=np.full((len(bumpy.vertices), 3), [10, 20, 30], "u1"), q=bumpy.vertices[:, 0]
    )
    there = colored.to_trimesh()
    assert isinstance(there, trimesh.Trimesh)
    assert there.is_watertight
    assert np.isclose(there.volume, bumpy.volume, rtol=1e-12)
    back = rholm.as_mesh(there)
    assert same_surface(back, bumpy)
    assert back.attributes["green"][0] == 20
    assert np.array_equal(back.attributes["q"], bumpy.vertices[:, 0])
    assert np.array_equal(rholm.expand(there, 8).coeffs, rholm.expand(bumpy, 8).coeffs)
    with pytest.raises(rholm.InvalidInputError):
        rholm.expand(trimesh.PointCloud(bumpy.vertices), 8)
    assert np.array_equal(rholm.as_points(trimesh.PointCloud(bumpy.vertices)).points, bumpy.vertices)
    scene = trimesh.Scene([there])
    assert np.isclose(rholm.as_mesh(scene).volume, bumpy.volume, rtol=1e-12)
    synthesized = rholm.expand(bumpy, 8).mesh(3)
    assert np.allclose(synthesized.to_trimesh().vertex_normals, synthesized.normals)


def test_pyvista(bumpy):
    pyvista = pytest.importorskip("pyvista")
    there = rholm.expand(bumpy, 8).mesh(3).to_pyvista()
    assert "Normals" in there.point_data
    assert there.n_cells == 1280
    back = rholm.as_mesh(there)
    assert "nx" in back.attributes
    data = bumpy.to_pyvista()
    assert np.allclose(rholm.expand(data, 8).coeffs, rholm.expand(bumpy, 8).coeffs, rtol=1e-12)
    quads = pyvista.Cube()
    assert np.isclose(rholm.as_mesh(quads).volume, 1)
    assert np.isclose(rholm.weld(pyvista.Sphere()).mesh.volume, np.pi / 6, rtol=0.02)
    grid = pyvista.ImageData(dimensions=(3, 3, 3))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert np.isclose(rholm.as_mesh(grid).area, 24)  # a cube of side 2

    class Older:  # of a PyVista that does not have the choice
        __module__ = "pyvista.core.grid"

        def extract_surface(self, pass_pointid=True):
            return quads

    assert np.isclose(rholm.as_mesh(Older()).volume, 1)
    cloud = rholm.sample_surface(bumpy, 500).to_pyvista()
    assert rholm.as_points(cloud).normals is not None


def test_the_accessor_of_pyvista(bumpy):
    pyvista = pytest.importorskip("pyvista")

    importlib.import_module("rholm._pyvista")  # as PyVista does by the entry point of what is installed
    data = bumpy.to_pyvista()
    assert data.rholm.expand(8).degree == 8
    assert isinstance(data.rholm.repair(), pyvista.PolyData)
    assert data.rholm.compare(bumpy).hausdorff <= 1e-6


def test_meshio(bumpy, tmp_path):
    meshio = pytest.importorskip("meshio")
    there = bumpy.with_attributes(q=bumpy.vertices[:, 0]).to_meshio()
    there.write(tmp_path / "a.vtk")
    back = rholm.as_mesh(meshio.read(tmp_path / "a.vtk"))
    assert same_surface(back, bumpy)
    assert np.array_equal(back.attributes["q"], bumpy.vertices[:, 0])
    with pytest.raises(rholm.InvalidInputError):
        rholm.as_mesh(meshio.Mesh(bumpy.vertices, [("line", [[0, 1]])]))


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
