"""The tables of libraries.py: data, contenders with their options, and judges of results."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import rholm

Array = npt.NDArray[Any]
Result = dict[str, Array]
#: Runs a job in the other packages' environment, without measuring it: contender, data, options.
Prepare = Callable[..., Result]


@dataclass
class Entry:
    """A contender with options."""

    label: str
    contender: str
    options: dict[str, Any] = field(default_factory=dict)
    data: str = ""
    """Name of the group's data that the contender gets."""
    choices: list[dict[str, Any]] = field(default_factory=list)
    """Sets of options; the set with the least error is measured."""

    @property
    def ours(self) -> bool:
        """Returns true if the entry measures rholm."""
        return self.contender.startswith("rholm")


@dataclass
class Group:
    """Contenders that do the same work on the same data."""

    title: str
    data: dict[str, Result]
    entries: list[Entry]
    judge: Callable[[Result, Entry], dict[str, float]]
    """Columns of a result; the first of them is the error that `choices` are chosen by."""


def read(data: Path | None, file: str, made: Callable[[], rholm.Mesh]) -> tuple[str, rholm.Mesh]:
    """Returns a real shape, welded, or the made shape if there is no folder."""
    if data is None:
        return "bumpy sphere", made()
    return Path(file).stem, rholm.meshes.weld(rholm.read_shape(data / file).shape).mesh


def arrays_of(mesh: rholm.Mesh, center: npt.ArrayLike = 0.0) -> Result:
    """Returns a mesh relative to a centre."""
    return {"vertices": mesh.vertices - np.asarray(center), "triangles": np.array(mesh.faces)}


def centered(mesh: rholm.Mesh) -> Result:
    """Returns a mesh about its centre, as the star transforms need it."""
    return arrays_of(mesh, rholm.harmonics.find_center(mesh, rays=0).center)


def fibonacci(n: int) -> Array:
    """Returns directions spread evenly over the sphere."""
    i = np.arange(n) + 0.5
    z, phi = 1 - 2 * i / n, np.pi * (1 + np.sqrt(5)) * i
    s = np.sqrt(1 - z * z)
    return np.stack([s * np.cos(phi), s * np.sin(phi), z], axis=1)


def grid_directions(n: int) -> Array:
    """Returns Driscoll and Healy's grid of n x 2n directions, from the north pole on."""
    theta, phi = np.meshgrid(np.pi * np.arange(n) / n, np.pi * np.arange(2 * n) / n, indexing="ij")
    s = np.sin(theta)
    return np.stack([s * np.cos(phi), s * np.sin(phi), np.cos(theta)], axis=-1).reshape(-1, 3)


def relative_error(found: Array, exact: Array) -> float:
    """Returns the l2 norm of the error of degrees 1 and above, relative to the norm of these degrees."""
    return float(np.linalg.norm((found - exact)[:, 1:]) / np.linalg.norm(exact[:, 1:]))


def exact_coefficients(mesh: Result, degree: int, **options: Any) -> Array:
    """Returns coefficients of the polyhedron itself, in pyshtools' default convention."""
    arrays = (mesh["vertices"], mesh["triangles"])
    return rholm.expand(arrays, degree, center=(0, 0, 0), rays=0, errors=False, **options).coeffs


def coefficients(data: Path | None, prepare: Prepare) -> Iterator[Group]:
    """Compares ways from a mesh to coefficients: by its faces, and from radii along rays."""
    name, mesh = read(data, "asteroid-bennu.ply", lambda: rholm.bumpy_sphere(5))
    arrays = centered(mesh)
    for degree in (32, 64):
        exact = exact_coefficients(arrays, degree, engine="direct", precision=1e-13)
        given = {"mesh": arrays}
        for factor in (2, 8):
            n = factor * (degree + 1)
            found = prepare("rays", {**arrays, "directions": grid_directions(n)})
            given[f"grid {factor}"] = {"radii": found["radii"].reshape(n, 2 * n)}
        scattered = fibonacci((4 if degree <= 32 else 2) * (degree + 1) ** 2)
        given["scattered"] = prepare("rays", {**arrays, "directions": scattered}) | {"directions": scattered}
        radii = np.linalg.norm(arrays["vertices"], axis=1)
        given["vertices"] = {"radii": radii, "directions": arrays["vertices"] / radii[:, None]}

        def judge(result: Result, _: Entry, exact: Array = exact) -> dict[str, float]:
            return {"error": relative_error(result["coeffs"], exact)}

        options = {"degree": degree}
        grids = [
            Entry(
                f"pyshtools, grid {k * (degree + 1)} x {2 * k * (degree + 1)}", "pyshtools_grid", options, g
            )
            for k, g in ((2, "grid 2"), (8, "grid 8"))
        ]
        fits = [
            Entry(
                f"pyshtools, least squares, {len(scattered)} rays",
                "pyshtools_least_squares",
                options,
                "scattered",
            )
        ]
        if degree <= 32:
            label = f"pyshtools, least squares, {len(radii)} vertices"
            fits.append(Entry(label, "pyshtools_least_squares", options, "vertices"))
        yield Group(
            f"{name}, {len(arrays['triangles'])} faces, degree {degree}",
            given,
            [
                *(
                    Entry(
                        f"rholm.expand, precision {p:g}", "rholm_expand", {**options, "precision": p}, "mesh"
                    )
                    for p in (1e-4, 1e-8, 1e-12)
                ),
                # The centre is given, so that the error can be measured.
                Entry(
                    "rholm.expand, defaults, with star check and errors",
                    "rholm_expand",
                    {**options, "whole": True, "center": [0, 0, 0]},
                    "mesh",
                ),
                *grids,
                *fits,
            ],
            judge,
        )


def oracle(prepare: Prepare) -> dict[str, float]:
    """Compares the coefficients used as reference with an independent cubature."""
    degree, found = 16, {}
    bodies = {"ellipsoid 3 : 2 : 1": rholm.ellipsoid((3, 2, 1), 2), "bumpy sphere": rholm.bumpy_sphere(2)}
    for name, mesh in bodies.items():
        arrays = arrays_of(mesh)
        other = prepare("quadrature", arrays, degree=degree, n=20)["coeffs"]
        for engine, precision in (("direct", 1e-13), ("fast", 1e-13)):
            ours = exact_coefficients(arrays, degree, engine=engine, precision=precision)
            found[f"{name}, {engine}"] = relative_error(ours, other)
    return found


def surface_columns(result: Result, truth: rholm.Mesh, samples: int = 100_000) -> dict[str, float]:
    """Returns distances between a surface and the true one over the diagonal, and the volume's error."""
    mesh = rholm.Mesh(result["vertices"], result["triangles"])
    c = rholm.compare(truth, mesh, samples=samples)
    return {
        "rms from truth": c.a_to_b.rms / c.diagonal,
        "rms to truth": c.b_to_a.rms / c.diagonal,
        "max": c.hausdorff / c.diagonal,
        "volume": mesh.volume / truth.volume - 1,
    }


def voxels(data: Path | None, prepare: Prepare) -> Iterator[Group]:
    """Compares ways from a solid to coefficients and back to a surface: voxels, and the mesh."""
    name, mesh = read(data, "asteroid-bennu.ply", lambda: rholm.bumpy_sphere(5))
    arrays = arrays_of(mesh)
    given = {"mesh": arrays}
    for across in (64, 128):
        given[f"{across}"] = prepare("voxels", arrays, across=across)
    for degree in (16, 32):
        yield Group(
            f"{name}, {len(arrays['triangles'])} faces, degree {degree}",
            given,
            [
                Entry("rholm.expand(...).mesh()", "rholm_surface", {"degree": degree}, "mesh"),
                Entry(
                    "rholm.expand(...).mesh(subdivisions=6)",
                    "rholm_surface",
                    {"degree": degree, "subdivisions": 6},
                    "mesh",
                ),
                *(
                    Entry(
                        f"aicsshparam, {across} voxels across, sigma {sigma}{', finer mesh' * fine}",
                        "aicsshparam",
                        {"degree": degree, "sigma": sigma, "oversampled": fine},
                        f"{across}",
                    )
                    for across, sigma, fine in (
                        (64, 0, False),
                        (128, 0, False),
                        (128, 1, False),
                        (128, 0, True),
                    )
                ),
            ],
            lambda result, _: surface_columns(result, mesh),
        )


def sources(mesh: Result, points: int) -> Result:
    """Returns directions and weights of (M8) of docs/method.md: Gauss nodes of edges, nodes of faces.

    Parameters
    ----------
    mesh : arrays
        Closed, star-shaped about the origin.
    points : int
        1: one on each edge and face; 2: two on an edge, three on a face.
    """
    p = mesh["vertices"][mesh["triangles"].astype(np.int64)]
    normal = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
    d2 = np.einsum("ij,ij->i", normal, p[:, 0])
    halves = np.stack([mesh["triangles"], np.roll(mesh["triangles"], -1, axis=1)], axis=-1)
    along = np.roll(p, -1, axis=1) - p
    w = (np.einsum("ij,ikj->ik", normal, np.cross(p, along)) / d2[:, None]).ravel()
    edges, at = np.unique(np.sort(halves.reshape(-1, 2), axis=1), axis=0, return_inverse=True)
    w = np.bincount(at.ravel(), w, len(edges))
    f = -np.einsum("ij,ij->i", normal, normal) / d2
    shares = [0.5] if points == 1 else [0.5 - np.sqrt(1 / 12), 0.5 + np.sqrt(1 / 12)]
    corners = (
        [[1 / 3] * 3]
        if points == 1
        else [[2 / 3, 1 / 6, 1 / 6], [1 / 6, 2 / 3, 1 / 6], [1 / 6, 1 / 6, 2 / 3]]
    )
    a, b = mesh["vertices"][edges[:, 0]], mesh["vertices"][edges[:, 1]]
    places = [a + t * (b - a) for t in shares] + [np.einsum("c,fcx->fx", np.array(c), p) for c in corners]
    weights = [w / len(shares) for _ in shares] + [f / len(corners) for _ in corners]
    x = np.concatenate(places)
    return {"directions": x / np.linalg.norm(x, axis=1, keepdims=True), "weights": np.concatenate(weights)}


def sums(data: Path | None, prepare: Prepare) -> Iterator[Group]:
    """Compares sums over given sources with a transform that places its own sources."""
    del prepare
    shapes: list[tuple[str, int, int, dict[str, Any], tuple[str, ...]]] = [
        ("asteroid-bennu.ply", 180, 6, {}, ("1", "2")),
        ("igea.ply", 256, 7, {} if data is None else {"signed": True}, ("1", "2")),
        ("", 480, 9, {}, ("1",)),
    ]
    for file, degree, subdivisions, options, rules in shapes:
        name, mesh = read(data if file else None, file, partial(rholm.bumpy_sphere, subdivisions))
        arrays = centered(mesh)
        exact = exact_coefficients(arrays, degree, precision=1e-13, **options)
        l_values = np.maximum(np.arange(degree + 1), 1)[:, None]
        given, direct = {"mesh": arrays}, {}
        for rule in rules:
            given[rule] = sources(arrays, int(rule))
            u, w = given[rule]["directions"], given[rule]["weights"]
            # Direct sums over millions of sources take hours; fast sums of far higher precision are used.
            engine = "direct" if len(w) < 5_000_000 else "fast"
            direct[rule] = rholm.harmonics.adjoint(u, w, degree=degree, engine=engine, precision=1e-13)

        def judge(
            result: Result,
            entry: Entry,
            exact: Array = exact,
            direct: dict[str, Array] = direct,
            l_values: Array = l_values,
        ) -> dict[str, float]:
            if "coeffs" in result:
                return {"error": relative_error(result["coeffs"], exact)}
            found = result["sums"] / (l_values * (l_values + 1)) / np.sqrt(4 * np.pi)
            of_sums = relative_error(result["sums"], direct[entry.data])
            return {"error": relative_error(found, exact), "error of the sums": of_sums}

        entries = [
            Entry(
                f"rholm.expand of the mesh, precision {p:g}",
                "rholm_expand",
                {"degree": degree, "precision": p, **options},
                "mesh",
            )
            for p in (1e-4, 1e-6, 1e-8)
        ]
        for rule in direct:
            n = len(given[rule]["weights"])
            for label, single, epsilon in (
                ("single, 1e-4", True, 1e-4),
                ("1e-6", False, 1e-6),
                ("1e-12", False, 1e-12),
            ):
                how = {"degree": degree, "epsilon": epsilon, "single": single}
                entries.append(Entry(f"ducc0, {n} sources, {label}", "ducc0_adjoint", how, rule))
            for precision in (1e-6, 1e-12):
                how = {"degree": degree, "precision": precision}
                entries.append(
                    Entry(f"rholm.adjoint, {n} sources, {precision:g}", "rholm_adjoint", how, rule)
                )
        yield Group(f"{name}, {len(arrays['triangles'])} faces, degree {degree}", given, entries, judge)


CLOUDS = ("igea.ply", "armadillo-43k.obj", "stanford-dragon.ply")


def clouds(data: Path | None) -> Iterator[tuple[str, rholm.Mesh, Result]]:
    """Yields points with normals of surfaces, and the surfaces."""
    for file in CLOUDS if data else ("",):
        name, mesh = read(data, file, lambda: rholm.bumpy_sphere(6, 0.4))
        for n in (50_000, 200_000):
            cloud = rholm.sample_surface(mesh, n)
            arrays = {"points": np.array(cloud.points), "normals": np.array(cloud.normals)}
            yield f"{name} (genus {rholm.inspect(mesh).genus}), {n} points", mesh, arrays


def points(data: Path | None, prepare: Prepare) -> Iterator[Group]:
    """Compares ways from points with exact normals to a surface."""
    del prepare
    for title, mesh, arrays in clouds(data):

        def judge(result: Result, _: Entry, mesh: rholm.Mesh = mesh) -> dict[str, float]:
            found = rholm.inspect((result["vertices"], result["triangles"]))
            columns = surface_columns(result, mesh)
            columns.update(faces=found.triangles, components=found.components, genus=found.genus)
            columns["border edges"] = found.boundary_edges
            return columns

        entries = [Entry("rholm.reconstruct", "rholm_reconstruct")]
        for package in ("open3d", "pymeshlab"):
            for depth in (8, 9, 10) if len(arrays["points"]) > 50_000 else (8, 9):
                label = f"{'Open3D' if package == 'open3d' else package}, Poisson, depth {depth}"
                entries.append(Entry(label, f"{package}_poisson", {"depth": depth}))
        yield Group(title, {"": arrays}, entries, judge)


def normals(data: Path | None, prepare: Prepare) -> Iterator[Group]:
    """Compares ways from points to normals that point outwards."""
    del prepare
    for title, _, arrays in clouds(data):

        def judge(result: Result, _: Entry, true: Array = arrays["normals"]) -> dict[str, float]:
            found = result["normals"] / np.maximum(np.linalg.norm(result["normals"], axis=1), 1e-300)[:, None]
            cosine = np.einsum("ij,ij->i", found, true)
            angle = np.degrees(np.arccos(np.clip(np.abs(cosine), 0, 1)))
            wrong = float(np.mean(cosine < 0))
            return {"wrong side": wrong, "inside out": float(wrong > 0.5), "mean angle": float(angle.mean())}

        entries = [
            Entry("rholm.orient", "rholm_orient"),
            Entry("Open3D, 30 neighbours, tree of 15", "open3d_normals", {"k": 15}),
            Entry("pymeshlab, 10 neighbours", "pymeshlab_normals", {"k": 10}),
            Entry("pymeshlab, 30 neighbours", "pymeshlab_normals", {"k": 30}),
        ]
        if len(arrays["points"]) <= 50_000:
            entries.append(Entry("Open3D, 30 neighbours, tree of 100", "open3d_normals", {"k": 100}))
        yield Group(title, {"": {"points": arrays["points"]}}, entries, judge)


WAVELENGTHS = (0.005, 0.007, 0.01, 0.015, 0.025, 0.04, 0.06, 0.1, 0.15, 0.25, 0.4)  # over the diagonal


def smoothing(data: Path | None, prepare: Prepare) -> Iterator[Group]:
    """Compares smoothing of noise on known surfaces; each contender has its best options here."""
    del prepare
    shapes: list[tuple[str, rholm.Mesh, float, bool]] = [("bumpy sphere", rholm.bumpy_sphere(6), 2e-3, True)]
    if data is not None:
        shapes.append((*read(data, "igea.ply", lambda: rholm.bumpy_sphere(6)), 5e-4, False))
    for name, mesh, noise, star in shapes:
        diagonal = mesh.bounds.diagonal
        moved = np.random.default_rng(1).normal(0, noise * diagonal, len(mesh.vertices))
        vertices = mesh.vertices + moved[:, None] * mesh.normals
        arrays: Result = {"vertices": vertices, "triangles": np.array(mesh.faces)}

        def judge(result: Result, _: Entry, mesh: rholm.Mesh = mesh) -> dict[str, float]:
            return surface_columns(result, mesh)

        steps = (2, 4, 8, 16, 32, 64, 128, 256, 512)
        waves = [{"wavelength": w * diagonal} for w in WAVELENGTHS]
        entries = [Entry("rholm.smooth, all of it", "rholm_smooth", choices=waves)]
        if star:
            degrees = [{"degree": degree} for degree in (8, 12, 16, 24, 32)]
            entries.append(Entry("rholm.expand, mesh(like=...)", "rholm_low_pass", choices=degrees))
        for name_, more in (
            ("laplacian", {"lamb": 0.5}),
            ("taubin", {"lamb": 0.5, "nu": 0.53}),
            ("humphrey", {}),
            ("mut_dif_laplacian", {"lamb": 0.5}),
        ):
            most = 64 if "laplacian" in name_ else steps[-1]  # these are slow, and worse again at more steps
            choices = [{"filter": name_, **more, "iterations": n} for n in steps if n <= most]
            entries.append(Entry(f"trimesh, filter_{name_}", "trimesh_smooth", choices=choices))
        bands = [
            {"n_iter": n, "pass_band": b} for b in (0.002, 0.005, 0.01, 0.03, 0.1, 0.3) for n in (20, 100)
        ]
        entries.append(Entry("PyVista, smooth_taubin", "pyvista_taubin", choices=bands))
        title = f"{name}, {len(arrays['triangles'])} faces, noise {noise:g} of the diagonal"
        yield Group(title, {"": arrays}, entries, judge)


TABLES: dict[str, Callable[[Path | None, Prepare], Iterator[Group]]] = {
    "coefficients": coefficients,
    "voxels": voxels,
    "sums": sums,
    "points": points,
    "normals": normals,
    "smoothing": smoothing,
}
