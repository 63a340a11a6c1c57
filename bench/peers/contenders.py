"""The contenders of libraries.py: each does one piece of work, in its own process.

libraries.py runs ``python contenders.py JOB.json`` with the interpreter of the contender's packages. The
last printed line is the measurement, as JSON. A contender takes arrays and options and returns a `Job`. Each
contender imports its own packages before anything is measured.
"""

from __future__ import annotations

import json
import resource
import statistics
import sys
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

Arrays = Mapping[str, npt.NDArray[Any]]


@dataclass
class Job:
    """A piece of work that can be repeated."""

    work: Callable[[Any], Any]
    """The work to measure; its argument is the result of `fresh`."""
    result: Callable[[Any], dict[str, npt.NDArray[Any]]]
    """Converts the result of `work` to arrays; not measured."""
    fresh: Callable[[], Any] = lambda: None
    """Input for one time, in the package's own types; not measured."""


CONTENDERS: dict[str, Callable[..., Job]] = {}


def contender(job: Callable[..., Job]) -> Callable[..., Job]:
    """Registers a contender under the name of its function."""
    CONTENDERS[job.__name__] = job
    return job


def mesh_arrays(vertices: Any, triangles: Any) -> dict[str, npt.NDArray[Any]]:
    """Returns a mesh as a result."""
    return {"vertices": np.array(vertices, np.float64), "triangles": np.array(triangles, np.int32)}


# rholm


@contender
def rholm_expand(data: Arrays, *, whole: bool = False, **options: Any) -> Job:
    """Expands a mesh; with `whole`, also finds centre, star check and truncation errors."""
    import rholm

    if not whole:
        options.update(center=(0, 0, 0), rays=0, errors=False)
    mesh = (data["vertices"], data["triangles"])
    return Job(
        lambda _: rholm.expand(mesh, threads=1, **options),
        lambda s: {"coeffs": s.coeffs, "center": s.center},
    )


@contender
def rholm_surface(data: Arrays, *, degree: int, subdivisions: int | None = None) -> Job:
    """Expands with all defaults, and makes a mesh from the coefficients."""
    import rholm

    mesh = (data["vertices"], data["triangles"])
    return Job(
        lambda _: rholm.expand(mesh, degree, threads=1).mesh(subdivisions, threads=1),
        lambda m: mesh_arrays(m.vertices, m.faces),
    )


@contender
def rholm_adjoint(data: Arrays, *, degree: int, precision: float) -> Job:
    """Adds weighted sums of harmonics at scattered directions."""
    import rholm

    directions, weights = data["directions"], data["weights"]
    return Job(
        lambda _: rholm.harmonics.adjoint(directions, weights, degree=degree, precision=precision, threads=1),
        lambda sums: {"sums": sums},
    )


@contender
def rholm_reconstruct(data: Arrays) -> Job:
    """Reconstructs a surface from points with normals."""
    import rholm

    return Job(
        lambda _: rholm.reconstruct(data["points"], data["normals"], threads=1),
        lambda r: mesh_arrays(r.mesh.vertices, r.mesh.faces),
    )


@contender
def rholm_orient(data: Arrays) -> Job:
    """Computes normals of points."""
    import rholm

    return Job(
        lambda _: rholm.orient(data["points"], threads=1), lambda r: {"normals": np.array(r.cloud.normals)}
    )


@contender
def rholm_smooth(data: Arrays, *, wavelength: float) -> Job:
    """Removes detail finer than a wavelength from the whole mesh."""
    import rholm

    mesh = rholm.Mesh(data["vertices"], data["triangles"])
    everywhere = np.ones(len(mesh.vertices), bool)
    return Job(
        lambda _: rholm.smooth(mesh, everywhere, wavelength, threads=1),
        lambda m: mesh_arrays(m.vertices, m.faces),
    )


@contender
def rholm_low_pass(data: Arrays, *, degree: int) -> Job:
    """Expands a star-shaped mesh to a degree, and evaluates it in the mesh's own directions."""
    import rholm

    mesh = rholm.Mesh(data["vertices"], data["triangles"])

    def work(_: Any) -> Any:
        s = rholm.expand(mesh, degree, center=(0, 0, 0), rays=0, errors=False, precision=1e-6, threads=1)
        return s.mesh(like=mesh, threads=1)

    return Job(work, lambda m: mesh_arrays(m.vertices, m.faces))


# Others: harmonics


@contender
def pyshtools_grid(data: Arrays, *, degree: int) -> Job:
    """Expands radii on a grid of Driscoll and Healy; finer grids are truncated at the degree."""
    import pyshtools

    radii = data["radii"]
    return Job(
        lambda _: pyshtools.SHGrid.from_array(radii, grid="DH", copy=False).expand(lmax_calc=degree),
        lambda clm: {"coeffs": clm.to_array()},
    )


@contender
def pyshtools_least_squares(data: Arrays, *, degree: int) -> Job:
    """Fits radii at scattered directions."""
    import pyshtools

    x, y, z = data["directions"].T
    latitude, longitude = np.degrees(np.arcsin(z)), np.degrees(np.arctan2(y, x)) % 360
    return Job(
        lambda _: pyshtools.SHCoeffs.from_least_squares(data["radii"], latitude, longitude, degree),
        lambda clm: {"coeffs": clm.to_array()},
    )


@contender
def aicsshparam(data: Arrays, *, degree: int, sigma: float, oversampled: bool) -> Job:
    """Expands a solid in voxels, and makes a mesh from the coefficients, in the mesh's coordinates."""
    from aicsshparam import shparam, shtools
    from vtk.util.numpy_support import vtk_to_numpy

    image, origin, pitch = data["image"], data["origin"], float(data["pitch"])

    def work(_: Any) -> Any:
        (named, grid), (*_rest, center) = shparam.get_shcoeffs(
            image=image, lmax=degree, sigma=sigma, alignment_2d=False
        )
        if oversampled:
            matrix = np.array(list(named.values())).reshape(2, degree + 1, degree + 1)
            _mesh, grid = shtools.get_reconstruction_from_coeffs(matrix, lrec=4 * (degree + 1))
        return shtools.get_reconstruction_from_grid(grid, centroid=center)

    def result(mesh: Any) -> dict[str, npt.NDArray[Any]]:
        triangles = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)
        return mesh_arrays(origin + pitch * vtk_to_numpy(mesh.GetPoints().GetData()), triangles)

    return Job(work, result)


@contender
def ducc0_adjoint(data: Arrays, *, degree: int, epsilon: float, single: bool = False) -> Job:
    """Adds weighted sums of harmonics at scattered directions."""
    import ducc0

    x, y, z = data["directions"].T
    places = np.stack([np.arctan2(np.hypot(x, y), z), np.arctan2(y, x) % (2 * np.pi)], axis=1)
    weights = data["weights"].astype(np.float32 if single else np.float64)[None]

    def result(alm: Any) -> dict[str, npt.NDArray[Any]]:
        sums = np.zeros((2, degree + 1, degree + 1))
        start = 0
        for m in range(degree + 1):
            row = alm[0, start : start + degree + 1 - m]
            factor = (-1) ** m * (np.sqrt(2) if m else 1)  # docs/method.md 1: real, without the phase
            sums[0, m:, m], sums[1, m:, m] = factor * row.real, -factor * row.imag
            start += degree + 1 - m
        return {"sums": sums}

    return Job(
        lambda _: ducc0.sht.adjoint_synthesis_general(
            map=weights, spin=0, lmax=degree, loc=places, epsilon=epsilon, nthreads=1
        ),
        result,
    )


# Others: points


def _open3d_cloud(data: Arrays) -> Any:
    import open3d

    cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(data["points"]))
    if "normals" in data:
        cloud.normals = open3d.utility.Vector3dVector(data["normals"])
    return cloud


@contender
def open3d_poisson(data: Arrays, *, depth: int) -> Job:
    """Screened Poisson reconstruction."""
    import open3d

    cloud = _open3d_cloud(data)
    return Job(
        lambda _: open3d.geometry.TriangleMesh.create_from_point_cloud_poisson(
            cloud, depth=depth, n_threads=1
        )[0],
        lambda mesh: mesh_arrays(mesh.vertices, mesh.triangles),
    )


@contender
def open3d_normals(data: Arrays, *, k: int) -> Job:
    """Computes normals by 30 neighbours, oriented along a tree through k neighbours each."""
    points = {"points": data["points"]}

    def work(cloud: Any) -> Any:
        cloud.estimate_normals()
        cloud.orient_normals_consistent_tangent_plane(k)
        return cloud

    return Job(work, lambda c: {"normals": np.array(c.normals)}, lambda: _open3d_cloud(points))


def _meshlab_set(vertices: Any, **options: Any) -> Any:
    import pymeshlab

    meshes = pymeshlab.MeshSet()
    meshes.add_mesh(pymeshlab.Mesh(vertices, **options))
    return meshes


@contender
def pymeshlab_poisson(data: Arrays, *, depth: int) -> Job:
    """Screened Poisson reconstruction."""

    def work(meshes: Any) -> Any:
        meshes.generate_surface_reconstruction_screened_poisson(depth=depth, threads=1)
        return meshes  # a mesh of it is valid only while it exists

    return Job(
        work,
        lambda made: mesh_arrays(made.current_mesh().vertex_matrix(), made.current_mesh().face_matrix()),
        lambda: _meshlab_set(data["points"], v_normals_matrix=data["normals"]),
    )


@contender
def pymeshlab_normals(data: Arrays, *, k: int) -> Job:
    """Computes normals by k neighbours, oriented consistently."""

    def work(meshes: Any) -> Any:
        meshes.compute_normal_for_point_clouds(k=k)
        return meshes

    return Job(
        work,
        lambda made: {"normals": np.array(made.current_mesh().vertex_normal_matrix())},
        lambda: _meshlab_set(data["points"]),
    )


# Others: smoothing


@contender
def trimesh_smooth(data: Arrays, *, filter: str, **options: Any) -> Job:
    """Applies one of trimesh's filters, in place."""
    import trimesh

    smooth = getattr(trimesh.smoothing, f"filter_{filter}")

    def fresh() -> Any:
        return trimesh.Trimesh(data["vertices"].copy(), data["triangles"].copy(), process=False)

    def work(mesh: Any) -> Any:
        smooth(mesh, **options)
        return mesh

    return Job(work, lambda mesh: mesh_arrays(mesh.vertices, mesh.faces), fresh)


@contender
def pyvista_taubin(data: Arrays, *, n_iter: int, pass_band: float) -> Job:
    """Applies VTK's windowed sinc filter."""
    import pyvista

    mesh = pyvista.PolyData.from_regular_faces(data["vertices"], data["triangles"])
    return Job(
        lambda _: mesh.smooth_taubin(n_iter=n_iter, pass_band=pass_band, normalize_coordinates=True),
        lambda m: mesh_arrays(m.points, m.regular_faces),
    )


# Input that other packages get for free, and an oracle that is not rholm


@contender
def rays(data: Arrays) -> Job:
    """Computes radii of a star-shaped mesh in directions from the origin, exact to rounding."""
    from scipy.spatial import cKDTree

    corners = data["vertices"][data["triangles"]]
    inverse = np.linalg.inv(corners.transpose(0, 2, 1))  # direction to coordinates in the corners
    places = corners / np.linalg.norm(corners, axis=2, keepdims=True)
    places = places.sum(axis=1) / np.linalg.norm(places.sum(axis=1), axis=1, keepdims=True)

    def work(_: Any) -> npt.NDArray[np.float64]:
        radii = np.empty(len(data["directions"]))
        tree = cKDTree(places)
        for start in range(0, len(radii), 20_000):
            u = data["directions"][start : start + 20_000]
            _, near = tree.query(u, 16)
            inside = np.einsum("nkij,nj->nki", inverse[near], u)
            best = inside.min(axis=2).argmax(axis=1)
            found = inside[np.arange(len(u)), best]
            for i in np.flatnonzero(found.min(axis=1) < -1e-12 * np.abs(found).max(axis=1)):
                every = inverse @ u[i]
                found[i] = every[every.min(axis=1).argmax()]
            radii[start : start + 20_000] = 1 / found.sum(axis=1)
        return radii

    return Job(work, lambda radii: {"radii": radii})


@contender
def voxels(data: Arrays, *, across: int) -> Job:
    """Returns the voxels whose centres lie within a mesh, `across` along its longest side, z slowest."""
    import pyvista

    mesh = pyvista.PolyData.from_regular_faces(data["vertices"], data["triangles"])
    pitch = float(np.ptp(data["vertices"], axis=0).max()) / across

    def result(grid: Any) -> dict[str, npt.NDArray[Any]]:
        mask = np.asarray(grid["mask"]).reshape(grid.dimensions[::-1])
        image = np.pad((mask > 0).astype(np.uint8), 3)
        return {"image": image, "origin": np.array(grid.origin) - 3 * pitch, "pitch": np.array(pitch)}

    return Job(lambda _: mesh.voxelize_binary_mask(spacing=(pitch,) * 3), result)


@contender
def quadrature(data: Arrays, *, degree: int, n: int) -> Job:
    """Computes coefficients by cubature of r over each spherical triangle: an independent oracle.

    Harmonics are SciPy's. The rule of Gauss and Legendre has n x n points per triangle, folded as by Duffy.
    """
    from scipy.special import sph_harm_y

    x, w = np.polynomial.legendre.leggauss(n)
    s, t = np.meshgrid((x + 1) / 2, (x + 1) / 2, indexing="ij")
    weight = (np.outer(w, w) / 4 * s).ravel()
    bary = np.stack([1 - s, s * (1 - t), s * t], axis=-1).reshape(-1, 3)

    def work(_: Any) -> npt.NDArray[np.float64]:
        corners = data["vertices"][data["triangles"]]
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        d = np.einsum("ij,ij->i", normal, corners[:, 0])
        points = np.einsum("qc,fcx->fqx", bary, corners).reshape(-1, 3)
        r2 = np.einsum("ij,ij->i", points, points)
        values = (d[:, None] * weight).ravel() / r2  # r dOmega = d dS / |x|^2
        theta = np.arccos(points[:, 2] / np.sqrt(r2))
        phi = np.arctan2(points[:, 1], points[:, 0])
        coeffs = np.zeros((2, degree + 1, degree + 1))
        for m in range(degree + 1):
            factor = (-1) ** m * (np.sqrt(2) if m else 1) / np.sqrt(4 * np.pi)
            for degree_l in range(m, degree + 1):
                c = factor * (values @ sph_harm_y(degree_l, m, theta, phi).conj())
                coeffs[:, degree_l, m] = c.real, -c.imag
        return coeffs

    return Job(work, lambda coeffs: {"coeffs": coeffs})


# Measuring


def _status(name: str) -> float:
    """Returns a line of this process's status, in MB, or 0 if there is none."""
    path = Path("/proc/self/status")
    lines = path.read_text().splitlines() if path.exists() else []
    return next((int(line.split()[1]) / 1e3 for line in lines if line.startswith(name + ":")), 0.0)


def _forget_peak() -> None:
    """Resets the peak of the resident set to its present size.

    ru_maxrss cannot be reset. In a process started by another one, it begins with the other's value.
    """
    path = Path("/proc/self/clear_refs")
    if path.exists():
        path.write_text("5")


def _peak() -> float:
    """Returns the peak of the resident set since the reset, in MB."""
    return _status("VmHWM") or resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e3


def _once(job: Job, given: Any) -> tuple[float, float, Any]:
    wall, cpu = time.perf_counter(), time.process_time()
    made = job.work(given)
    return time.perf_counter() - wall, time.process_time() - cpu, made


def measure(job: Job, seconds: float) -> tuple[dict[str, float], Any]:
    """Measures time and memory of a job.

    Parameters
    ----------
    job : Job
        Run once; if that takes less than half of `seconds`, repeated until they have passed.
    seconds : float
        Total time.

    Returns
    -------
    figures : dict
        Wall and processor seconds, medians without the first run if there are others. MB above the size
        of the process with its packages and its input, in the first run.
    result
        Result of the first run.
    """
    given = job.fresh()
    _forget_peak()
    before = _status("VmRSS") or _peak()
    wall, cpu, result = _once(job, given)
    figures = {"wall": wall, "cpu": cpu, "memory": max(_peak() - before, 0.0)}
    times: list[tuple[float, float]] = []
    end = time.perf_counter() + seconds - wall
    while wall < seconds / 2 and (len(times) < 2 or time.perf_counter() < end):
        again = _once(job, job.fresh())
        times.append(again[:2])
    if times:
        figures["wall"], figures["cpu"] = (statistics.median(column) for column in zip(*times, strict=True))
    return figures, result


def main() -> None:
    """Runs the job of a file and prints its figures."""
    job = json.loads(Path(sys.argv[1]).read_text())
    with np.load(job["data"]) as file:
        data = {name: file[name] for name in file.files}
    work = CONTENDERS[job["contender"]](data, **job["options"])
    figures, result = measure(work, job["seconds"])
    if job["result"]:
        made: dict[str, Any] = work.result(result)
        np.savez(job["result"], **made)
    print(json.dumps(figures))


if __name__ == "__main__":
    main()
