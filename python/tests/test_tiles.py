"""Surfaces from more points than a tile: the same as from the program, for any size."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import numpy as np
import pytest
import rholm

TILE = 1000


@pytest.fixture(scope="module")
def cloud(ring):
    return rholm.sample_surface(ring, 3000)


@pytest.fixture(scope="module")
def larger(ring):
    return rholm.sample_surface(ring, 6000)


@pytest.fixture(scope="module")
def known(cloud, tmp_path_factory):
    """The surface in tiles, as bytes."""
    path = tmp_path_factory.mktemp("known") / "s.ply"
    rholm.reconstruct(cloud, tile_points=TILE).save(path)
    return path.read_bytes()


def by_program(program: str, folder: Path, *words: str) -> bytes:
    """Returns the surface that the program makes of "p.ply" in that folder."""
    subprocess.run(
        [program, "reconstruct", "p.ply", *words, "-o", "program.ply", "--quiet"], cwd=folder, check=True
    )
    return (folder / "program.ply").read_bytes()


def check_sizes(program: str, folder: Path, ring: rholm.Mesh, sizes: list[tuple[int, int | None]]) -> None:
    """Arrays and files, in memory and written. Each size is a number of points and a tile_points."""
    for n, tile in sizes:
        cloud = rholm.sample_surface(ring, n)
        cloud.save(folder / "p.ply")
        words = () if tile is None else ("--tile-points", str(tile))
        options = {} if tile is None else {"tile_points": tile}
        expected = by_program(program, folder, *words)
        for points in (cloud, folder / "p.ply"):
            made = rholm.reconstruct(points, **options)
            assert (made.report.tiles > 1) == (n > (tile or 1 << 20)), (n, tile)
            made.save(folder / "s.ply")
            assert (folder / "s.ply").read_bytes() == expected, (n, tile)
        rholm.reconstruct(folder / "p.ply", output=folder / "s.ply", **options)
        assert (folder / "s.ply").read_bytes() == expected, (n, tile)


def test_the_surface_is_that_of_the_program(program, ring, tmp_path):
    check_sizes(program, tmp_path, ring, [(1000, None), (2000, 2000), (2000, 1000)])


@pytest.mark.nightly
def test_the_surface_of_many_points_is_that_of_the_program(program, ring, tmp_path):
    check_sizes(program, tmp_path, ring, [(30_000, 5000), (200_000, None), (2_000_000, None)])


def test_points_that_are_not_finite_are_in_no_tile(program, cloud, tmp_path):
    """The number of finite points decides whether there are several tiles, for files and arrays."""
    points, normals = np.array(cloud.points[:2100]), np.array(cloud.normals[:2100])
    points[::20] = np.nan
    rows = np.hstack([points, normals])
    np.savetxt(tmp_path / "p.xyz", rows)
    for tile in (1994, 1995):  # of 1995 finite points
        made = rholm.reconstruct(points, normals, tile_points=tile)
        assert (made.report.points, made.report.dropped_points) == (2100, 105)
        assert (made.report.tiles > 1) == (tile < 1995)
        made.save(tmp_path / "s.ply")
        words = ["reconstruct", "p.xyz", "--tile-points", str(tile), "-o", "program.ply", "--quiet"]
        subprocess.run([program, *words], cwd=tmp_path, check=True)
        assert (tmp_path / "s.ply").read_bytes() == (tmp_path / "program.ply").read_bytes()


def test_options_and_meshes_are_those_of_the_program(program, tmp_path):
    rholm.torus(2, 0.7, 60, 40).save(tmp_path / "p.ply")
    words = ("--holes", "keep", "--simplify", "20%", "--min-component", "0", "--confidence")
    for tile in (TILE, 1 << 20):
        rholm.reconstruct(
            tmp_path / "p.ply",
            output=tmp_path / "own.ply",
            tile_points=tile,
            holes="keep",
            simplify={"share": 0.2},
            min_component=0,
            confidence=True,
        )
        expected = by_program(program, tmp_path, *words, "--tile-points", str(tile))
        assert (tmp_path / "own.ply").read_bytes() == expected


@pytest.mark.nightly
def test_threads_folders_order_and_files_change_no_byte(cloud, known, random, tmp_path):
    cloud.save(tmp_path / "p.ply")
    order = random.permutation(len(cloud))
    mixed = rholm.PointCloud(cloud.points[order], cloud.normals[order])
    (tmp_path / "work").mkdir()
    for points, options in (
        (tmp_path / "p.ply", {"threads": 1, "work_dir": tmp_path / "work", "max_memory": 10 << 20}),
        (mixed, {"threads": 3}),
        (cloud.points, {"normals": cloud.normals, "work_dir": str(tmp_path / "work"), "resume": True}),
    ):
        rholm.reconstruct(points, output=tmp_path / "s.ply", tile_points=TILE, **options)
        assert (tmp_path / "s.ply").read_bytes() == known, options
        assert list((tmp_path / "work").iterdir()) == []


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no pipes with names")
@pytest.mark.parametrize("tile", [TILE, 1 << 20])
def test_pipes_are_read_once(cloud, tmp_path, tile):
    cloud.save(tmp_path / "p.ply")
    os.mkfifo(tmp_path / "pipe")
    with subprocess.Popen(["cp", "p.ply", "pipe"], cwd=tmp_path):
        rholm.reconstruct(tmp_path / "pipe", tile_points=tile).save(tmp_path / "s.ply")
    rholm.reconstruct(tmp_path / "p.ply", tile_points=tile).save(tmp_path / "file.ply")
    assert (tmp_path / "s.ply").read_bytes() == (tmp_path / "file.ply").read_bytes()


def test_what_is_said_is_what_is_there(cloud, tmp_path):
    seen: list[rholm.clouds.TileForecast] = []
    options = {"attributes": {"height": cloud.points[:, 2]}, "tile_points": TILE, "confidence": True}
    made = rholm.reconstruct(
        cloud, **options, output=tmp_path / "s.ply", model=tmp_path / "caps.h5", foreseen=seen.append
    )
    report, mesh = made.report, made.mesh
    assert made[:2] == (None, None)
    assert (report.vertices, report.faces) == (len(mesh.vertices), len(mesh.faces))
    assert np.isclose(report.volume, mesh.volume, rtol=1e-5)  # coordinates are single precision
    assert mesh.inspect().closed
    assert np.abs(mesh.attributes["height"] - mesh.vertices[:, 2]).max() < 4 * report.spacing
    assert report.tiles > 1
    assert report.stored > 0
    assert report.warnings == []
    assert np.array_equal(report.bounds.min, cloud.bounds.min)
    assert report.caps == len(made.atlas)
    (forecast,) = seen
    assert (forecast.points, forecast.tiles) == (len(cloud), report.tiles)
    assert forecast.memory == rholm.clouds.foresee_tiles(len(cloud), TILE).memory == report.memory
    # Run in memory, with the same results: the mesh with the points' attributes, the caps, the
    # report.
    kept = rholm.reconstruct(cloud, **options)
    kept.save(tmp_path / "kept.ply")
    assert (tmp_path / "kept.ply").read_bytes() == (tmp_path / "s.ply").read_bytes()
    assert set(kept.mesh.attributes) == {"nx", "ny", "nz", "height", "confidence"}
    assert np.array_equal(kept.atlas.coefficients_of(3), made.atlas.coefficients_of(3))
    assert kept.atlas.rules == made.atlas.rules
    assert (kept.report.area, kept.report.unseen_area) == (report.area, report.unseen_area)
    assert kept.atlas.mesh().inspect().genus == 1
    assert kept.atlas.rules.left_out == ["height", "confidence"]
    bare = rholm.reconstruct(cloud, output=tmp_path / "s.ply")
    assert len(bare.mesh.faces) == bare.report.faces
    with pytest.raises(rholm.InvalidInputError, match="model="):
        bare.atlas  # noqa: B018


def test_a_run_that_was_stopped_is_taken_up(cloud, known, tmp_path):
    work, path = tmp_path / "work", tmp_path / "s.ply"
    work.mkdir()
    options = {"tile_points": TILE, "work_dir": work, "output": path}
    folder = work / "s.ply.tiles"
    stops = {"after": "caps"}

    def stop(stage: str, fraction: float) -> bool:
        return stage != stops["after"]

    with pytest.raises(rholm.CancelledError):
        rholm.reconstruct(cloud, **options, progress=stop)
    assert list(work.iterdir()) == []
    stops["after"] = "grid"
    with pytest.raises(rholm.CancelledError):
        rholm.reconstruct(cloud, **options, resume=True, progress=stop)
    assert list(tmp_path.iterdir()) == [work]
    assert list(work.iterdir()) == [folder]
    with pytest.raises(rholm.InvalidInputError, match="another run"):
        rholm.reconstruct(cloud, **options, resume=True, noise=0)
    with pytest.raises(rholm.InvalidInputError, match="another run"):
        rholm.reconstruct(cloud, **{**options, "tile_points": 1500}, resume=True)
    other = rholm.PointCloud(2 * cloud.points, cloud.normals)
    with pytest.raises(rholm.InvalidInputError, match="another run"):  # the same number of points
        rholm.reconstruct(other, **options, resume=True)
    assert any((folder / "pieces" / "caps").glob("[0-9]*"))
    rholm.reconstruct(cloud, **options, resume=True, max_memory=1 << 30)
    assert path.read_bytes() == known
    assert list(work.iterdir()) == []


def test_scans_are_brought_together_as_by_the_program(program, larger, tmp_path):
    scan = np.arange(len(larger)) % 2
    scans = rholm.PointCloud(larger.points + 0.02 * scan[:, None], larger.normals, {"scan": scan})
    scans.save(tmp_path / "p.ply")
    made = rholm.reconstruct(tmp_path / "p.ply", tile_points=3000)
    assert made.report.tiles > 1
    assert made.report.scans.scans == 2
    assert made.report.scans.distance < 0.3 * made.report.scans.distance_before
    made.save(tmp_path / "s.ply")
    assert (tmp_path / "s.ply").read_bytes() == by_program(program, tmp_path, "--tile-points", "3000")


def test_what_the_forecast_raises_ends_the_run(cloud, tmp_path):
    def refuse(forecast: rholm.clouds.TileForecast) -> None:
        raise KeyError(forecast.tiles)

    with pytest.raises(KeyError):
        rholm.reconstruct(cloud, output=tmp_path / "s.ply", tile_points=TILE, foreseen=refuse)
    assert list(tmp_path.iterdir()) == []


def test_memory_is_refused_with_tiles_that_fit_and_never_changes_the_surface(larger):
    expected = rholm.reconstruct(larger)
    assert rholm.reconstruct(larger, max_memory=16 << 20).mesh == expected.mesh
    with pytest.raises(rholm.OutOfMemoryError, match="--tile-points 3100"):
        rholm.reconstruct(larger, max_memory=3 << 20)


def test_memory_for_the_surface_is_refused_with_an_output(larger, tmp_path):
    limit = 3 << 20  # enough for a tile of 1000 points, not for the surface of 6000
    with pytest.raises(rholm.OutOfMemoryError, match="output"):
        rholm.reconstruct(larger, tile_points=1000, max_memory=limit)
    rholm.reconstruct(larger, tile_points=1000, max_memory=limit, output=tmp_path / "s.ply")
    wide = rholm.reconstruct(larger, tile_points=1000)
    wide.save(tmp_path / "wide.ply")
    assert (tmp_path / "s.ply").read_bytes() == (tmp_path / "wide.ply").read_bytes()


def test_what_cannot_be_done_is_refused(cloud, tmp_path):
    def refused(error: type[Exception], match: str, points=cloud, **options) -> None:
        with pytest.raises(error, match=match):
            rholm.reconstruct(points, **{"tile_points": TILE, "output": tmp_path / "s.ply", **options})

    refused(rholm.UnsupportedError, "binary PLY", output=tmp_path / "s.obj")
    refused(rholm.InvalidInputError, "output", resume=True, output=None)
    refused(rholm.InvalidInputError, "1000", tile_points=999)
    refused(rholm.InvalidInputError, "points", points=cloud.points[:5])
    refused(rholm.InvalidInputError, "dig", holes="dig")
    refused(rholm.IoError, "none.xyz", points=tmp_path / "none.xyz")
    refused(rholm.IoError, "nowhere", output=tmp_path / "nowhere" / "s.ply")
    refused(TypeError, "foreseen", foreseen=3)
    refused(rholm.InvalidInputError, "tile_points", tile_points=-1)
    cloud.save(tmp_path / "p.ply")
    (tmp_path / "p.ply").write_bytes((tmp_path / "p.ply").read_bytes()[:-7])
    refused(rholm.InvalidInputError, "p.ply", points=tmp_path / "p.ply")
    (tmp_path / "s.ply.tiles").mkdir()
    (tmp_path / "s.ply.tiles" / "other").write_text("")
    refused(rholm.InvalidInputError, "other files", work_dir=tmp_path, resume=True)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["p.ply", "s.ply.tiles"]
    with pytest.raises(rholm.InvalidInputError, match="1000"):
        rholm.clouds.foresee_tiles(10**9, 0)
    assert rholm.clouds.foresee_tiles(10**9).tiles == -(-(10**9) // 2**20)


def test_names_of_the_version_before_say_what_they_are_now(cloud, known, tmp_path):
    assert "reconstruct_bricks" not in rholm.__all__
    with pytest.warns(
        DeprecationWarning, match=r"rholm\.foresee_bricks is rholm\.clouds\.foresee_tiles\(\) now"
    ):
        forecast = rholm.foresee_bricks(10**9)
    assert forecast.bricks == rholm.clouds.foresee_tiles(10**9).tiles
    with pytest.warns(DeprecationWarning, match="output="):
        made = rholm.reconstruct_bricks(
            cloud, tmp_path / "s.ply", points_per_brick=TILE, work_dir=tmp_path / "work"
        )
    assert (tmp_path / "s.ply").read_bytes() == known
    assert made.bricks == made.report.tiles
    with pytest.raises(AttributeError, match="bricks_of"):
        rholm.bricks_of  # noqa: B018
