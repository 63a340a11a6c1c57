"""Point clouds from formulas: bodies with exact normals, ways to spoil normals, points without a surface.

The first arguments of every function are a random generator of NumPy and the number of points."""

import numpy as np


def unit(v):
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def directions(rng, n):
    return unit(rng.normal(size=(n, 3)))


# ---- bodies: points, outward normals -------------------------------------------------------------

def sphere(rng, n, radius=1.0, middle=(0, 0, 0)):
    d = directions(rng, n)
    return radius * d + middle, d


def ellipsoid(rng, n, axes=(1.3, 1.0, 0.7)):
    """Returns points that are uniform by area: a direction is kept with a probability proportional to its
    area."""
    axes, kept = np.asarray(axes), []
    while sum(map(len, kept)) < n:
        d = directions(rng, 2 * n)
        stretch = np.linalg.norm(d / axes, axis=1) * axes.min()
        kept.append(d[rng.random(2 * n) < stretch])
    d = np.concatenate(kept)[:n]
    return d * axes, unit(d / axes)


def torus(rng, n, ring=1.0, tube=0.4):
    v = rng.random(4 * n) * 2 * np.pi
    v = v[rng.random(4 * n) < (ring + tube * np.cos(v)) / (ring + tube)][:n]
    u = rng.random(len(v)) * 2 * np.pi
    normal = np.stack([np.cos(v) * np.cos(u), np.cos(v) * np.sin(u), np.sin(v)], 1)
    return tube * normal + ring * np.stack([np.cos(u), np.sin(u), 0 * u], 1), normal


def box(rng, n, size=(1.5, 1.0, 0.8)):
    size = np.asarray(size, float)
    areas = np.array([size[1] * size[2], size[2] * size[0], size[0] * size[1]])
    axis = rng.choice(3, n, p=areas / areas.sum())
    side = rng.choice([-1.0, 1.0], n)
    p = (rng.random((n, 3)) - 0.5) * size
    normal = np.zeros((n, 3))
    normal[np.arange(n), axis] = side
    p[np.arange(n), axis] = side * size[axis] / 2
    return p, normal


def plate(rng, n):
    return box(rng, n, (2.0, 2.0, 0.2))


def cylinder(rng, n, radius=0.5, height=2.0):
    caps = rng.random(n) < radius / (radius + height)
    u = rng.random(n) * 2 * np.pi
    side = np.stack([np.cos(u), np.sin(u), 0 * u], 1)
    z = (rng.random(n) - 0.5) * height
    top = rng.choice([-1.0, 1.0], n)
    inner = radius * np.sqrt(rng.random(n))
    p = np.where(caps[:, None], inner[:, None] * side, radius * side)
    p[:, 2] = np.where(caps, top * height / 2, z)
    normal = np.where(caps[:, None], np.stack([0 * u, 0 * u, top], 1), side)
    return p, normal


def bumps(rng, n, height=0.15, degree=4):
    """Returns a ball with waves: r = 1 + height sin(degree phi) sin(theta)^degree."""
    d = directions(rng, n)
    phi, s = np.arctan2(d[:, 1], d[:, 0]), np.hypot(d[:, 0], d[:, 1])
    wave, slope = np.sin(degree * phi), degree * np.cos(degree * phi)
    r = 1 + height * wave * s ** degree
    theta_hat = np.stack([d[:, 2] * np.cos(phi), d[:, 2] * np.sin(phi), -s], 1)
    phi_hat = np.stack([-np.sin(phi), np.cos(phi), 0 * phi], 1)
    by_theta = height * wave * degree * s ** (degree - 1) * d[:, 2]
    by_phi = height * slope * s ** (degree - 1)
    return r[:, None] * d, unit(d - (by_theta / r)[:, None] * theta_hat - (by_phi / r)[:, None] * phi_hat)


def touching(rng, n):
    """Returns two balls that touch in a point."""
    return np.concatenate([sphere(rng, n // 2)[0], sphere(rng, n - n // 2, 1, (2, 0, 0))[0]])


def tee(rng, n):
    """Returns a square, and half of another square that ends at it."""
    p, up = 2 * rng.random((n, 3)) - 1, rng.random(n) < 0.5
    p[up, 0], p[up, 2] = 0, np.abs(p[up, 2])
    p[~up, 2] = 0
    return p


def thin(rng, n):
    """Returns a plate whose walls are about as near to each other as the points."""
    return box(rng, n, (2.0, 2.0, 0.05))[0]


def joined(*parts):
    return np.concatenate([p for p, _ in parts]), np.concatenate([m for _, m in parts])


def turned(part):
    return part[0], -part[1]


def shell(rng, n, inner=0.6):
    """Returns a ball with a cavity: normals of the inner wall point to the middle."""
    k = int(n / (1 + inner ** 2))
    return joined(sphere(rng, k), turned(sphere(rng, n - k, inner)))


def two_balls(rng, n, size=0.6, gap=0.3):
    k = int(n / (1 + size ** 2))
    return joined(sphere(rng, k), sphere(rng, n - k, size, (1 + gap + size, 0, 0)))


def bowl(rng, n, wall=0.25):
    """Returns half of a shell with a flat rim."""
    inner = 1 - wall
    areas = np.array([2 * np.pi, 2 * np.pi * inner ** 2, np.pi * (1 - inner ** 2)])
    part = rng.choice(3, n, p=areas / areas.sum())
    d = directions(rng, n)
    d[:, 2] = -np.abs(d[:, 2])
    u = rng.random(n) * 2 * np.pi
    r = np.sqrt(inner ** 2 + rng.random(n) * (1 - inner ** 2))
    rim = np.stack([r * np.cos(u), r * np.sin(u), 0 * u], 1)
    up = np.tile([0.0, 0.0, 1.0], (n, 1))
    at = part[:, None]
    return (np.where(at == 0, d, np.where(at == 1, inner * d, rim)),
            np.where(at == 0, d, np.where(at == 1, -d, up)))


# Function, volume and genus of each body.
BODIES = {
    "sphere": (sphere, 4 / 3 * np.pi, 0),
    "ellipsoid": (ellipsoid, 4 / 3 * np.pi * 1.3 * 0.7, 0),
    "torus": (torus, 2 * np.pi ** 2 * 0.4 ** 2, 1),
    "box": (box, 1.2, 0),
    "plate": (plate, 0.8, 0),
    "cylinder": (cylinder, np.pi / 2, 0),
    "bumps": (bumps, None, 0),
    "shell": (shell, 4 / 3 * np.pi * (1 - 0.6 ** 3), 0),
    "two_balls": (two_balls, 4 / 3 * np.pi * (1 + 0.6 ** 3), 0),
    "bowl": (bowl, 2 / 3 * np.pi * (1 - 0.75 ** 3), 0),
}


# ---- ways to spoil normals: which points are turned ----------------------------------------------

def at_random(rng, points, share):
    return rng.random(len(points)) < share


def in_patch(rng, points, share):
    """Chooses the points nearest to one of them."""
    far = np.linalg.norm(points - points[rng.integers(len(points))], axis=1)
    return far <= np.quantile(far, share)


def in_caps(rng, points, share, n=5):
    """Chooses several patches of equally many points."""
    chosen = np.zeros(len(points), bool)
    for _ in range(n):
        chosen |= in_patch(rng, points, share / n)
    return chosen


def in_half(rng, points, share):
    """Chooses the points on one side of a plane."""
    height = points @ directions(rng, 1)[0]
    return height >= np.quantile(height, 1 - share)


def in_band(rng, points, share):
    """Chooses the points between two planes."""
    height = points @ directions(rng, 1)[0]
    return (height >= np.quantile(height, 0.5 - share / 2)) & (height <= np.quantile(height, 0.5 + share / 2))


def in_clumps(rng, points, share):
    """Chooses points at random, but all points of a small cell alike."""
    cell = 0.15 * np.ptp(points, axis=0).max()
    keys = np.floor(points / cell).astype(int) @ [73856093, 19349663, 83492791] % 9973
    return (np.random.default_rng(int(rng.integers(1 << 30))).random(9973) < share)[keys]


SPOILED = {"random": at_random, "patch": in_patch, "caps": in_caps, "half": in_half, "band": in_band,
           "clumps": in_clumps}


# ---- points of no surface: what they look like ---------------------------------------------------

def ball(rng, n):
    return directions(rng, n) * rng.random((n, 1)) ** (1 / 3)


def cube(rng, n):
    return rng.random((n, 3))


def lattice(rng, n, size=(1, 1, 1)):
    """Returns the voxels of a box."""
    size = np.asarray(size, float)
    step = (size.prod() / n) ** (1 / 3)
    axes = [np.arange(max(1, round(s / step))) * step for s in size]
    return np.stack(np.meshgrid(*axes), -1).reshape(-1, 3)


def voxel_ball(rng, n):
    p = lattice(rng, int(n * 6 / np.pi), (2, 2, 2)) - 1
    return p[np.linalg.norm(p, axis=1) <= 1]


def blob(rng, n):
    return rng.normal(size=(n, 3))


def slab(rng, n, thickness=0.3):
    return rng.random((n, 3)) * [1, 1, thickness]


def slab_lattice(rng, n, thickness=0.2):
    return lattice(rng, n, (1, 1, thickness))


def thick_shell(rng, n, inner=0.5):
    return directions(rng, n) * (inner ** 3 + (1 - inner ** 3) * rng.random((n, 1))) ** (1 / 3)


def rod(rng, n, thickness=0.1):
    return rng.random((n, 3)) * [thickness, thickness, 1]


def tetrahedron(rng, n):
    weights = rng.exponential(size=(n, 4))
    corners = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]])
    return weights / weights.sum(axis=1)[:, None] @ corners


def thin_slab(rng, n):
    return slab(rng, n, 0.15)


def layers(rng, n):
    """Returns a lattice of three layers."""
    k = round((n / 3) ** 0.5)
    return np.stack(np.meshgrid(range(k), range(k), range(3)), -1).reshape(-1, 3).astype(float)


def jittered_layers(rng, n):
    p = layers(rng, n)
    return p + rng.uniform(-0.2, 0.2, p.shape)


def bar(rng, n):
    """Returns the voxels of a bar of 3 x 3."""
    return np.stack(np.meshgrid(range(max(4, n // 9)), range(3), range(3)), -1).reshape(-1, 3).astype(float)


def round_rod(rng, n, radius=0.05):
    angle, r = rng.random(n) * 2 * np.pi, radius * np.sqrt(rng.random(n))
    return np.stack([r * np.cos(angle), r * np.sin(angle), rng.random(n)], 1)


def wall_of_shell(rng, n):
    """Returns points that fill a shell of 0.85 ... 1; from 2000 points on they form several layers."""
    return thick_shell(rng, n, 0.85)


def line(rng, n, noise=0.001):
    return np.stack([rng.random(n), 0 * np.arange(n), 0 * np.arange(n)], 1) + noise * rng.normal(size=(n, 3))


def circle(rng, n, noise=0.0):
    u = rng.random(n) * 2 * np.pi
    return np.stack([np.cos(u), np.sin(u), 0 * u], 1) + noise * rng.normal(size=(n, 3))


def helix(rng, n, noise=0.003):
    u = rng.random(n) * 6 * np.pi
    return np.stack([np.cos(u), np.sin(u), 0.2 * u], 1) + noise * rng.normal(size=(n, 3))


def knot(rng, n, noise=0.0):
    u = rng.random(n) * 2 * np.pi
    return np.stack([np.sin(u) + 2 * np.sin(2 * u), np.cos(u) - 2 * np.cos(2 * u), -np.sin(3 * u)], 1) + \
        noise * rng.normal(size=(n, 3))


def wires(rng, n):
    """Returns the edges of a cube."""
    axis, t = rng.integers(3, size=n), rng.random(n)
    p = rng.integers(2, size=(n, 3)).astype(float)
    p[np.arange(n), axis] = t
    return p


def crossing_planes(rng, n):
    p = 2 * rng.random((n, 3)) - 1
    p[np.arange(n), rng.integers(2, size=n)] = 0
    return p


def crossing_spheres(rng, n):
    return np.concatenate([sphere(rng, n // 2)[0], sphere(rng, n - n // 2, 1, (0.8, 0, 0))[0]])


NO_SURFACE = {
    "ball": (ball, "volume"), "cube": (cube, "volume"), "lattice": (lattice, "volume"),
    "voxel_ball": (voxel_ball, "volume"), "blob": (blob, "volume"), "slab": (slab, "volume"),
    "slab_lattice": (slab_lattice, "volume"), "thick_shell": (thick_shell, "volume"),
    "rod": (rod, "volume"), "thin_slab": (thin_slab, "volume"), "tetrahedron": (tetrahedron, "volume"),
    "layers": (layers, "volume"), "jittered_layers": (jittered_layers, "volume"), "bar": (bar, "volume|curve"),
    "round_rod": (round_rod, "volume"), "line": (line, "curve"), "circle": (circle, "curve"),
    "helix": (helix, "curve"), "knot": (knot, "curve"), "wires": (wires, "curve"),
    "crossing_planes": (crossing_planes, None), "crossing_spheres": (crossing_spheres, None),
}


def text(points, normals=None):
    rows = points if normals is None else np.concatenate([points, normals], 1)
    return "".join(" ".join(f"{x:.9g}" for x in row) + "\n" for row in rows)
