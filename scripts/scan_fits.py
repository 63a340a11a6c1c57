"""Local fits with known sheets of points, for scan-figures --angles and --bound."""

import math

import numpy as np
from scipy.spatial import cKDTree

SIZES = (6, 8, 10, 12, 16, 20, 24, 32, 48)  # sizes of neighbourhoods, with the point itself
FITS = {"plane": (1, False), "weighted plane": (1, True), "quadric": (2, False)}  # degree, weights
MORE = {"weighted quadric": (2, True), "cubic": (3, False), "weighted cubic": (3, True)}
SAME = math.cos(math.radians(60))  # the least cosine between normals of neighbours
AT_ONCE = 1_000_000  # pairs of points


def angles(a, b):
    """Returns angles between lines (N, 3) in degrees, exact where small."""
    return np.degrees(np.arctan2(np.linalg.norm(np.cross(a, b), axis=-1), np.abs((a * b).sum(-1))))


def neighbours(tree, points, normals, seeds, k, wanted, planes=None, scale=None, stretch=1):
    """Returns the k + 1 nearest points of each seed on its own sheet: offsets (S, k + 1, 3) and distances
    (S, k + 1), where infinite distances mark missing points.

    Points of the same sheet have normals within 60 degrees, and an offset as flat as a circle allows for
    this angle. Thus folds and teeth that face the same way are other sheets. Nearest means in space or, with
    planes (S, 3) of rows, with distances across them divided by `stretch`. Candidates are the `wanted`
    nearest in space. The seed is the first point."""
    ways, lengths = [], []
    for part in np.array_split(np.arange(len(seeds)), math.ceil(len(seeds) * wanted / AT_ONCE)):
        here, n = points[seeds[part]], normals[seeds[part]]
        near = tree.query(here, wanted)[1]
        way = points[near] - here[:, None]
        both = normals[near] + n[:, None]
        length = np.linalg.norm(way, axis=2)
        same = np.einsum("skj,sj->sk", normals[near], n) > SAME
        same &= np.abs((way * both).sum(2)) <= 0.5 * length * np.linalg.norm(both, axis=2)
        if planes is not None:
            along = np.cross(planes[part], n)
            along /= np.maximum(np.linalg.norm(along, axis=1), 1e-12)[:, None]
            step = np.einsum("skj,sj->sk", way, planes[part]) * scale[part, None] / stretch
            length = np.hypot(np.einsum("skj,sj->sk", way, along), step)
        length[~same] = np.inf
        order = np.argsort(length, axis=1)[:, :k + 1]
        length = np.take_along_axis(length, order, 1)
        way = np.where(np.isfinite(length)[..., None], np.take_along_axis(way, order[..., None], 1), 0)
        ways.append(way), lengths.append(length)
    return np.concatenate(ways), np.concatenate(lengths)


def falling(length):
    """Returns weights (1 - (d / R)^2)^2 of the first k of (S, k + 1) distances; R is the last. Infinite
    distances are missing points."""
    there = np.isfinite(length)
    reach = np.where(there[:, -1], length[:, -1], 1.001 * np.where(there, length, 0).max(1))
    part = np.where(there[:, :-1], length[:, :-1], 0) / np.maximum(reach, 1e-300)[:, None]
    return np.where(there[:, :-1], np.maximum(1 - part ** 2, 0) ** 2, 0)


def frames(ways, weights):
    """Fits planes by total least squares; returns axes as columns (S, 3, 3), the normal last."""
    mean = np.einsum("sk,skj->sj", weights, ways) / np.maximum(weights.sum(1), 1e-300)[:, None]
    apart = ways - mean[:, None]
    return np.linalg.eigh(np.einsum("sk,ski,skj->sij", weights, apart, apart))[1][:, :, ::-1]


def heights(ways, weights, axes, degree=2):
    """Fits heights over planes by least squares: coefficients of 1, x, y, x^2, xy, y^2, ... at the seed (S,
    6 or 10)."""
    x, y, z = np.moveaxis(np.einsum("ski,sij->skj", ways, axes), 2, 0)
    columns = np.stack([x ** (n - m) * y ** m for n in range(degree + 1) for m in range(n + 1)], 2)
    weighted = columns * weights[..., None]
    size = np.sqrt((weighted * columns).sum(1))
    size[size == 0] = 1
    square = weighted.transpose(0, 2, 1) @ columns / size[:, :, None] / size[:, None]
    right = (weighted.transpose(0, 2, 1) @ z[..., None])[..., 0] / size
    return (np.linalg.pinv(square, rcond=1e-13, hermitian=True) @ right[..., None])[..., 0] / size


def fitted(ways, lengths, degree, weighted):
    """Returns normals of fits to the first k of (S, k + 1) neighbours (S, 3)."""
    ways = ways[:, :-1]
    flat = np.isfinite(lengths[:, :-1]).astype(float)
    weights = falling(lengths) if weighted else flat
    axes = frames(ways, weights if degree == 1 else flat)
    if degree == 1:
        return axes[:, :, 2]
    c = heights(ways, weights, axes, degree)
    normal = axes[:, :, 2] - c[:, 1:2] * axes[:, :, 0] - c[:, 2:3] * axes[:, :, 1]
    return normal / np.linalg.norm(normal, axis=1)[:, None]


def fits(points, normals, seeds, planes, scale, ratio):
    """Yields normals of all fits at the seeds: fit, k, metric, (S, 3).

    The metric "space" has k points. For rows with a ratio between steps there are three more metrics. "rows"
    has k points by steps along rows and between them. "disc" has ratio k points in space, which reach
    equally many rows. "oval" has sqrt(ratio) k points, between the two."""
    tree, most, middle = cKDTree(points), max(SIZES), math.sqrt(ratio)
    ways = {"space": (1, None)}
    if ratio > 1:
        ways |= {"disc": (ratio, None), "oval": (middle, middle), "rows": (1, ratio)}
    for metric, (factor, stretch) in ways.items():
        rows = (planes[seeds], scale[seeds], stretch) if stretch else ()
        wanted = min(len(points), math.ceil((4 * ratio if stretch else 4 * factor) * most))
        way, length = neighbours(tree, points, normals, seeds, round(factor * most), wanted, *rows)
        for k in SIZES:
            n = round(factor * k)
            for fit, (degree, weighted) in (FITS | MORE).items():
                if n >= (degree + 1) * (degree + 2) / 2:
                    yield fit, n, metric, fitted(way[:, :n + 1], length[:, :n + 1], degree, weighted)


def curvatures(points, normals, seeds, planes, radius):
    """Returns normal curvatures at the seeds across the planes of rows (S,). They belong to weighted
    quadrics fitted to all points within a radius except for opposite sheets. Edges have the curvature
    that rows at this distance can resolve."""
    tree, found = cKDTree(points), []
    for i, near in zip(seeds, tree.query_ball_point(points[seeds], radius)):
        near = np.array(near)[normals[near] @ normals[i] > -0.2]
        way = (points[near] - points[i])[None]
        weights = (1 - (way ** 2).sum(2) / radius ** 2) ** 2
        axes = frames(way, weights)
        c = heights(way, weights, axes)[0]
        along = np.cross(planes[len(found)], axes[0, :, 2])
        across = np.cross(axes[0, :, 2], along / max(np.linalg.norm(along), 1e-12))
        x, y = across @ axes[0, :, 0], across @ axes[0, :, 1]
        slope, bend = c[1] * x + c[2] * y, 2 * (c[3] * x * x + c[4] * x * y + c[5] * y * y)
        found.append(bend / (math.sqrt(1 + c[1] ** 2 + c[2] ** 2) * (1 + slope ** 2)))
    return np.array(found)


def edges(points, normals, seeds, radius):
    """Returns seeds with points within a radius whose normals differ by more than 60 degrees: edges, thin
    places."""
    near = cKDTree(points).query_ball_point(points[seeds], radius)
    return np.array([(normals[j] @ normals[i]).min() < SAME for i, j in zip(seeds, near)])
