"""Twelve bodies and the inputs sampled from them, which scan-figures and scan-limits measure."""

import math

import numpy as np

import rholm

# Numbers of points and ratios between directions. Each body has the inputs SIXTY, unless others are
# requested.
INPUTS = {"1k": (1000, 1), "3k": (3000, 1), "10k": (10000, 1), "100k": (100000, 1),
          "r5": (30000, 5), "r20": (60000, 20)}
SIXTY = ("1k", "10k", "100k", "r5", "r20")
AXIS = (0.3, 0.5, 1)  # axis of slices; rings of the torus have its own axis


def tube(curve, radius, n=600, m=48):
    """Returns a tube around a closed curve, with a frame moved along it and closed by an even twist."""
    c = curve(np.linspace(0, 2 * math.pi, n, endpoint=False))
    along = np.roll(c, -1, 0) - np.roll(c, 1, 0)
    along /= np.linalg.norm(along, axis=1)[:, None]
    u = np.zeros_like(c)
    u[-1] = (0.3, 0.5, 0.81)
    for i in range(n):
        v = u[i - 1] - u[i - 1] @ along[i] * along[i]
        u[i] = v / np.linalg.norm(v)
    v = u[-1] - u[-1] @ along[0] * along[0]
    v /= np.linalg.norm(v)
    twist = math.atan2(np.cross(v, u[0]) @ along[0], v @ u[0]) * np.arange(n)[:, None] / n
    w = np.cross(along, u)
    u = np.cos(twist) * u + np.sin(twist) * w
    w = np.cross(along, u)
    phi = np.linspace(0, 2 * math.pi, m, endpoint=False)[None, :, None]
    vertices = c[:, None] + radius * (np.cos(phi) * u[:, None] + np.sin(phi) * w[:, None])
    i, j = (x.ravel() for x in np.meshgrid(np.arange(n), np.arange(m), indexing="ij"))
    a, b = i * m + j, (i + 1) % n * m + j
    c, d = (i + 1) % n * m + (j + 1) % m, i * m + (j + 1) % m
    return rholm.Mesh(vertices.reshape(-1, 3), np.r_[np.c_[a, c, b], np.c_[a, d, c]])


def gear(teeth=16, root=1.0, tip=1.25, bore=0.45, half=0.35):
    """Returns a spur gear with a bore."""
    part = np.array([0, 0.2, 0.3, 0.55, 0.65, 0.8])
    angle = (2 * math.pi / teeth * (np.arange(teeth)[:, None] + part)).ravel()
    radius = np.tile([root, root, tip, tip, root, root], teeth)
    n = len(angle)
    ring = [np.c_[r * np.cos(angle), r * np.sin(angle), np.full(n, z)]
            for r in (radius, np.full(n, bore)) for z in (-half, half)]
    k, l = np.arange(n), np.arange(1, n + 1) % n
    quads = [(k, l, n + l, n + k), (n + k, n + l, 3 * n + l, 3 * n + k),
             (3 * n + k, 3 * n + l, 2 * n + l, 2 * n + k), (2 * n + k, 2 * n + l, l, k)]
    faces = [np.c_[q[0], q[1], q[2]] for q in quads] + [np.c_[q[0], q[2], q[3]] for q in quads]
    return rholm.Mesh(np.concatenate(ring), np.concatenate(faces))


def joined(first, second, turned=False):
    a, b = np.asarray(first.faces), np.asarray(second.faces)
    return rholm.Mesh(np.r_[first.vertices, second.vertices],
                      np.r_[a, (b[:, ::-1] if turned else b) + len(first.vertices)])


def scaled(mesh, factors):
    return rholm.Mesh(np.asarray(mesh.vertices) * np.asarray(factors), np.asarray(mesh.faces))


def circle(middle, u, v):
    return lambda t: np.asarray(middle) + np.cos(t)[:, None] * u + np.sin(t)[:, None] * v


def trefoil(t):
    r = 2 + np.cos(3 * t)
    return np.c_[r * np.cos(2 * t), r * np.sin(2 * t), -np.sin(3 * t)]


def bodies(folder, names=""):
    """Returns {name: (body, components, Euler characteristic)} for `names`, separated by commas, or for
    all."""
    ball = rholm.icosphere(6)
    links = [tube(circle(m, np.array(u), np.array(v)), 0.3)
             for m, u, v in (((0, 0, 0), (2, 0, 0), (0, 2, 0)), ((2, 0, 0), (2, 0, 0), (0, 0, 2)))]
    made = {"torus": (rholm.torus(2, 0.7, 400, 200), 1, 0), "knot": (tube(trefoil, 0.35), 1, 0),
            "links": (joined(*links), 2, 0), "blade": (scaled(ball, (3, 1, 0.12)), 1, 2),
            "shell": (joined(ball, scaled(ball, (0.85,) * 3), turned=True), 2, 4), "gear": (gear(), 1, 0)}
    files = {"igea": ("igea.ply", 2), "armadillo": ("armadillo-43k.obj", 2),
             "bunny": ("bunny-closed-cgal.off", 2), "bennu": ("asteroid-bennu.ply", 2),
             "rocker": ("rocker-arm.obj", 0), "fandisk": ("fandisk.obj", 2)}
    chosen = names.split(",") if names else [*made, *files]
    if unknown := set(chosen) - {*made, *files}:
        raise SystemExit(f"no such body: {', '.join(sorted(unknown))}")
    return {name: made[name] if name in made else (rholm.meshes.as_mesh(folder / files[name][0]), 1, files[name][1])
            for name in (*made, *files) if name in chosen}


def sample(name, mesh, points, ratio, seed=1):
    """Samples random points, or rows whose distance is `ratio` times the step along them."""
    rows = {"pattern": "rings" if name == "torus" else "slices", "pattern_ratio": ratio,
            "pattern_axis": (0, 0, 1) if name == "torus" else AXIS}
    return rholm.sample_surface(mesh, points, seed=seed, **(rows if ratio > 1 else {}))


def planes_of_rows(name, points):
    """Returns for points (N, 3) the unit normals of the planes of rows (N, 3), and factors (N,). A length
    along a normal times its factor gives equal steps between rows everywhere."""
    if name == "torus":
        around = np.cross((0, 0, 1), points)
        radius = np.linalg.norm(around, axis=1)
        return around / radius[:, None], radius.mean() / radius
    return np.tile(np.divide(AXIS, np.linalg.norm(AXIS)), (len(points), 1)), np.ones(len(points))


def with_smooth_normals(mesh):
    """Adds attributes smooth_x, smooth_y, smooth_z: the mean normal of the faces at each vertex, weighted
    by area."""
    vertices, triangles = np.asarray(mesh.vertices), np.asarray(mesh.faces).astype(int)
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    sums = np.zeros_like(vertices)
    for k in range(3):
        np.add.at(sums, triangles[:, k], np.cross(b - a, c - a))
    sums /= np.maximum(np.linalg.norm(sums, axis=1), 1e-300)[:, None]
    return rholm.Mesh(vertices, triangles, {f"smooth_{x}": sums[:, k] for k, x in enumerate("xyz")})
