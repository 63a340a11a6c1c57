"""Surfaces from points that are worked on in bricks."""

from __future__ import annotations

import subprocess

import numpy as np
import pytest
import rholm

PER_BRICK = 2000


@pytest.fixture(scope="module")
def cloud(ring):
    return rholm.sample_surface(ring, 6000)


@pytest.fixture(scope="module")
def known(cloud, tmp_path_factory):
    """The surface in bricks, as bytes."""
    path = tmp_path_factory.mktemp("known") / "s.ply"
    rholm.reconstruct_bricks(cloud, path, points_per_brick=PER_BRICK)
    return path.read_bytes()


def test_bricks_are_those_of_the_program(cloud, known, program, tmp_path):
    cloud.save(tmp_path / "p.ply")
    subprocess.run(
        [program, "reconstruct", "p.ply", "--tile-points", str(PER_BRICK), "-o", "s.ply", "--quiet"],
        cwd=tmp_path,
        check=True,
    )
    assert (tmp_path / "s.ply").read_bytes() == known


def test_options_and_meshes_are_those_of_the_program(program, tmp_path):
    rholm.torus(2, 0.7, 100, 60).save(tmp_path / "t.ply")
    words = ("--holes", "keep", "--simplify", "20%", "--min-component", "0", "--confidence")
    subprocess.run(
        [program, "reconstruct", "t.ply", "--tile-points", str(PER_BRICK), *words, "-o", "s.ply", "--quiet"],
        cwd=tmp_path,
        check=True,
    )
    rholm.reconstruct_bricks(
        tmp_path / "t.ply",
        tmp_path / "own.ply",
        points_per_brick=PER_BRICK,
        holes="keep",
        simplify={"share": 0.2},
        min_component=0,
        confidence=True,
    )
    assert (tmp_path / "own.ply").read_bytes() == (tmp_path / "s.ply").read_bytes()


@pytest.mark.nightly
def test_threads_folders_order_and_files_change_no_byte(cloud, known, random, tmp_path):
    cloud.save(tmp_path / "p.ply")
    order = random.permutation(len(cloud))
    mixed = rholm.PointCloud(cloud.points[order], cloud.normals[order])
    for points, options in (
        (tmp_path / "p.ply", {"threads": 1, "work_dir": tmp_path / "work"}),
        (mixed, {"threads": 3}),
        (cloud.points, {"normals": cloud.normals, "work_dir": str(tmp_path / "work")}),
    ):
        rholm.reconstruct_bricks(points, tmp_path / "s.ply", points_per_brick=PER_BRICK, **options)
        assert (tmp_path / "s.ply").read_bytes() == known, options
        assert not (tmp_path / "work").exists()


def test_what_is_said_is_what_is_in_the_files(cloud, tmp_path):
    seen = []
    height = cloud.points[:, 2]
    made = rholm.reconstruct_bricks(
        cloud,
        tmp_path / "s.ply",
        attributes={"height": height},
        points_per_brick=PER_BRICK,
        model=tmp_path / "caps.h5",
        foreseen=seen.append,
    )
    mesh = rholm.as_mesh(tmp_path / "s.ply")
    assert (made.vertices, made.triangles) == (len(mesh.vertices), len(mesh.triangles))
    assert np.isclose(made.report.volume, mesh.volume, rtol=1e-5)  # coordinates are single
    assert mesh.inspect().closed
    assert np.abs(mesh.attributes["height"] - mesh.vertices[:, 2]).max() < 4 * made.report.spacing
    assert made.bricks > 1
    assert made.stored > 0
    assert made.warnings == []
    assert np.array_equal(made.bounds.min, cloud.bounds.min)
    assert set(made.to_dict()) >= {"report", "bounds", "coefficients"}
    assert made.report.caps == len(rholm.load(tmp_path / "caps.h5"))
    (forecast,) = seen
    assert (forecast.points, forecast.bricks) == (len(cloud), made.bricks)
    assert forecast.memory == rholm.foresee_bricks(len(cloud), PER_BRICK).memory == made.report.memory


def test_a_run_that_was_stopped_is_taken_up(cloud, known, tmp_path):
    work, path = tmp_path / "work", tmp_path / "s.ply"
    options = {"points_per_brick": PER_BRICK, "work_dir": work}

    def stop(stage: str, fraction: float) -> bool:
        return not any((work / "pieces" / "caps").glob("[0-9]*"))

    with pytest.raises(rholm.CancelledError):
        rholm.reconstruct_bricks(cloud, path, **options, progress=stop)
    assert list(tmp_path.iterdir()) == []
    with pytest.raises(rholm.CancelledError):
        rholm.reconstruct_bricks(cloud, path, **options, resume=True, progress=stop)
    assert list(tmp_path.iterdir()) == [work]
    with pytest.raises(rholm.InvalidInputError, match="earlier run"):
        rholm.reconstruct_bricks(cloud, path, **options)
    with pytest.raises(rholm.InvalidInputError, match="another run"):
        rholm.reconstruct_bricks(cloud, path, **options, resume=True, noise=0)
    other = rholm.PointCloud(2 * cloud.points, cloud.normals)
    with pytest.raises(rholm.InvalidInputError, match="another run"):  # as many points
        rholm.reconstruct_bricks(other, path, **options, resume=True)
    assert any((work / "pieces" / "caps").glob("[0-9]*"))
    rholm.reconstruct_bricks(cloud, path, **options, resume=True)
    assert path.read_bytes() == known
    assert list(tmp_path.iterdir()) == [path]


def test_what_the_forecast_raises_ends_the_run(cloud, tmp_path):
    def refuse(forecast: rholm.BrickForecast) -> None:
        raise KeyError(forecast.bricks)

    with pytest.raises(KeyError):
        rholm.reconstruct_bricks(
            cloud,
            tmp_path / "s.ply",
            points_per_brick=PER_BRICK,
            work_dir=tmp_path / "work",
            foreseen=refuse,
        )
    assert list(tmp_path.iterdir()) == []


def test_what_cannot_be_done_in_bricks_is_refused(cloud, tmp_path):
    def refused(error: type[Exception], match: str, points=cloud, name: str = "s.ply", **options) -> None:
        with pytest.raises(error, match=match):
            rholm.reconstruct_bricks(points, tmp_path / name, **options)

    refused(rholm.UnsupportedError, "binary PLY", name="s.obj")
    refused(rholm.InvalidInputError, "work_dir", resume=True)
    refused(rholm.InvalidInputError, "1000", points_per_brick=999)
    refused(rholm.OutOfMemoryError, "smaller tiles", max_memory=1 << 20)
    refused(rholm.InvalidInputError, "points", points=cloud.points[:5])
    refused(rholm.InvalidInputError, "dig", holes="dig")
    refused(rholm.IoError, "none.xyz", points=tmp_path / "none.xyz")
    refused(rholm.IoError, "nowhere", name="nowhere/s.ply")
    refused(TypeError, "foreseen", foreseen=3)
    refused(rholm.InvalidInputError, "points_per_brick", points_per_brick=-1)
    scans = rholm.PointCloud(cloud.points, cloud.normals, {"scan": np.arange(len(cloud)) % 2})
    refused(rholm.UnsupportedError, "scans", points=scans)
    cloud.save(tmp_path / "p.ply")
    (tmp_path / "p.ply").write_bytes((tmp_path / "p.ply").read_bytes()[:-7])
    refused(rholm.InvalidInputError, "p.ply", points=tmp_path / "p.ply")
    refused(rholm.InvalidInputError, "other files", work_dir=tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["p.ply"]
    with pytest.raises(rholm.InvalidInputError, match="1000"):
        rholm.foresee_bricks(10**9, 0)
    assert rholm.foresee_bricks(10**9).bricks == -(-(10**9) // 2**20)
