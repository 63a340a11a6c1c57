"""Unusual closed meshes: one shape for each number, always the same.

Closed means that an even number of triangles meet at each edge once identical corners are joined. Meshes are
thin, flat, touching, crossing, doubled, inside out, far away, and of any size."""

import struct

import numpy as np

MOST_FACES = 2000


class Shape:
    """A shape. name: its number and kind; vertices (n, 3); faces (m, 3); kind: format of its file."""

    def __init__(self, number, name, vertices, faces, kind):
        self.number, self.name, self.kind = number, f"{number}-{name}", kind
        self.vertices = np.asarray(vertices, float)
        self.faces = np.asarray(faces, int)

    def diagonal(self):
        return float(np.linalg.norm(np.ptp(self.vertices, axis=0)))

    def mean_edge(self):
        corners = self.vertices[self.faces]
        return float(np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).mean())


# ---- parts ---------------------------------------------------------------------------------------

def joined(*parts):
    """Joins all parts into one mesh, without common vertices."""
    vertices, faces, n = [], [], 0
    for v, f in parts:
        vertices.append(v)
        faces.append(f + n)
        n += len(v)
    return np.concatenate(vertices), np.concatenate(faces)


def welded(mesh):
    """Joins identical corners, and leaves out triangles that lose their area by this."""
    vertices, index = np.unique(mesh[0], axis=0, return_inverse=True)
    faces = index.reshape(-1)[mesh[1]]
    keep = (faces != np.roll(faces, 1, axis=1)).all(axis=1)
    return vertices, faces[keep]


def turned_inside_out(mesh):
    return mesh[0], mesh[1][:, ::-1]


def moved(mesh, by=(0, 0, 0), size=1):
    return mesh[0] * size + np.asarray(by, float), mesh[1]


def turned(rng, mesh):
    """Applies a random rotation."""
    matrix, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    return mesh[0] @ (matrix * np.sign(np.linalg.det(matrix))), mesh[1]


def rings(rows, columns):
    """Returns faces of a net that is closed in both directions: vertex i, j has the index i columns + j."""
    i, j = np.meshgrid(np.arange(rows), np.arange(columns), indexing="ij")
    at = lambda di, dj: ((i + di) % rows * columns + (j + dj) % columns).ravel()
    return np.concatenate([np.stack([at(0, 0), at(1, 0), at(1, 1)], 1),
                           np.stack([at(0, 0), at(1, 1), at(0, 1)], 1)])


def sphere(faces):
    """Returns a sphere of meridians and parallels, with about `faces` faces (8 at least)."""
    rows = max(2, round((faces / 4)**0.5))
    columns = max(3, round(faces / (2 * (rows - 1))))
    theta = np.pi * np.arange(rows + 1) / rows
    phi = 2 * np.pi * np.arange(columns) / columns
    net = np.stack([np.outer(np.sin(theta), np.cos(phi)), np.outer(np.sin(theta), np.sin(phi)),
                    np.outer(np.cos(theta), np.ones(columns))], axis=2)
    net[0], net[-1] = (0, 0, 1), (0, 0, -1)
    net = net.reshape(-1, 3)
    inner = rings(rows + 1, columns)
    inner = inner[(np.ptp(inner // columns, axis=1) <= 1)]  # without triangles from pole to pole
    return welded((net, inner))


def torus(rows, columns, radius, tube):
    u, v = np.meshgrid(2 * np.pi * np.arange(rows) / rows,
                       2 * np.pi * np.arange(columns) / columns, indexing="ij")
    out = radius + tube * np.cos(v)
    return np.stack([out * np.cos(u), out * np.sin(u), tube * np.sin(v)], 2).reshape(-1, 3), \
        rings(rows, columns)


def box(size, cells=1):
    """Returns a box with `cells` squares along each edge, of two triangles each."""
    i, j = (x.ravel() for x in np.meshgrid(np.arange(cells), np.arange(cells), indexing="ij"))
    corners = np.array([(0, 0), (1, 0), (1, 1), (0, 0), (1, 1), (0, 1)])
    flat = (np.stack([i, j], 1)[:, None] + corners).reshape(-1, 2)
    vertices = []
    for axis in range(3):
        for side in (0, cells):
            places = np.empty((len(flat), 3))
            places[:, axis] = side
            places[:, [(axis + 1) % 3, (axis + 2) % 3]] = flat if side else flat[:, ::-1]
            vertices.append(places)
    vertices = np.concatenate(vertices)
    mesh = welded((vertices, np.arange(len(vertices)).reshape(-1, 3)))
    return (mesh[0] / cells - 0.5) * np.asarray(size, float), mesh[1]


def prism(corners, length, width):
    angle = 2 * np.pi * np.arange(corners) / corners
    ring = np.stack([width * np.cos(angle), width * np.sin(angle)], 1)
    top, bottom = (np.column_stack([ring, np.full(corners, z)]) for z in (length / 2, -length / 2))
    k, next_k = np.arange(corners), (np.arange(corners) + 1) % corners
    fan = np.stack([np.zeros(corners - 2, int), k[1:-1], k[2:]], 1)
    return np.concatenate([bottom, top]), np.concatenate(
        [np.stack([k, next_k, next_k + corners], 1),
         np.stack([k, next_k + corners, k + corners], 1), fan + corners, fan[:, ::-1]])


def tetrahedra(corners):
    """Returns tetrahedra from corners (n, 4, 3), all oriented outwards."""
    a, b, c, d = corners.transpose(1, 0, 2)
    inward = np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) < 0
    corners = corners.copy()
    corners[inward, :2] = corners[inward, 1::-1]
    faces = np.array([(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)])
    faces = 4 * np.arange(len(corners))[:, None, None] + faces
    return corners.reshape(-1, 3), faces.reshape(-1, 3)


def bumpy(rng, faces):
    vertices, triangles = sphere(faces)
    waves = rng.normal(size=(6, 3)) * rng.uniform(1, 5)
    bumps = np.cos(vertices @ waves.T + rng.uniform(0, 6, 6)).sum(1) / 6
    return vertices * (1 + rng.uniform(0.05, 0.6) * bumps)[:, None], triangles


def small_or_large(rng, least, most):
    """Returns a random number, uniform over decades."""
    return float(np.exp(rng.uniform(np.log(least), np.log(most))))


def some_faces(rng, most=MOST_FACES):
    return round(small_or_large(rng, 8, most))


# ---- kinds: each makes a mesh of random numbers --------------------------------------------------

def boxes(rng):
    """Boxes with ratios of edges up to 1e9."""
    edges = [1, small_or_large(rng, 1e-9, 1), small_or_large(rng, 1e-9, 1)]
    return box(rng.permutation(edges), int(rng.integers(1, 13)))


def plates(rng):
    """Very thin boxes, down to no thickness at all."""
    thickness = rng.choice([0, 1e-9, 1e-6, 1e-3, 2e-3, 1e-2])
    return box((1, rng.uniform(0.2, 1), thickness), int(rng.integers(1, 13)))


def two_sided(rng):
    """A square of two sheets in one place that share their border."""
    n = int(rng.integers(1, 20))
    vertices, faces = box((1, 1, 1), n)
    level = np.abs(vertices[faces][:, :, 2])
    sheets = (level == 0.5).all(1) & (np.ptp(vertices[faces][:, :, 2], axis=1) == 0)
    return welded((vertices * (1, 1, 0), faces[sheets]))


def needles(rng):
    width = small_or_large(rng, 1e-9, 0.1)
    if rng.random() < 0.5:
        return prism(int(rng.integers(3, 40)), 1, width)
    corners = rng.normal(size=(1, 4, 3)) * (width, width, 0.01)
    corners[0, 0, 2], corners[0, 1, 2] = -0.5, 0.5
    return tetrahedra(corners)


def soups(rng):
    n = some_faces(rng) // 4 + 1
    sizes = np.exp(rng.uniform(np.log(1e-3), 0, (n, 1, 1)))
    vertices, faces = tetrahedra(rng.uniform(size=(n, 1, 3)) + sizes * rng.normal(size=(n, 4, 3)))
    inside_out = np.repeat(rng.random(n) < rng.choice([0, 0.5]), 4)
    return vertices, np.where(inside_out[:, None], faces[:, ::-1], faces)


def solid(rng, faces):
    """A small part for other shapes: round, bumpy, with corners or with a hole."""
    which = rng.integers(4)
    if which == 0:
        return sphere(faces)
    if which == 1:
        return bumpy(rng, faces)
    if which == 2:
        return box((2, 2, 2), max(1, round((faces / 12)**0.5)))
    side = max(3, round((faces / 4)**0.5))
    return torus(2 * side, side, 1, rng.uniform(0.1, 0.9))


def nested(rng):
    """Shells in shells: cavities, or all oriented outwards."""
    n = int(rng.integers(2, 6))
    shell = bumpy(rng, some_faces(rng, MOST_FACES // n))
    parts = [moved(shell, size=0.3 + 0.7 * (n - k) / n) for k in range(n)]
    if rng.random() < 0.5:
        parts = [turned_inside_out(part) if k % 2 else part for k, part in enumerate(parts)]
    return joined(*parts)


def crossing(rng):
    """Parts that intersect each other."""
    n = int(rng.integers(2, 5))
    return joined(*[moved(turned(rng, solid(rng, some_faces(rng, MOST_FACES // n))),
                          rng.uniform(-0.7, 0.7, 3)) for _ in range(n)])


def touching(rng):
    """Boxes that share a corner, an edge or a whole face."""
    steps = np.array([(1, 1, 1), (1, 1, 0), (1, 0, 0)])
    place, parts = np.zeros(3), []
    cells = int(rng.integers(1, 6))
    for _ in range(int(rng.integers(2, 6))):
        parts.append(moved(box((1, 1, 1), cells), place))
        place = place + steps[rng.integers(3)]
    return welded(joined(*parts))


def pinched(rng):
    """A surface that touches itself at a point: two of its vertices are joined."""
    vertices, faces = solid(rng, max(60, some_faces(rng)))
    a = int(rng.integers(len(vertices)))
    near = set(faces[(faces == a).any(1)].ravel())
    near |= set(faces[np.isin(faces, list(near)).any(1)].ravel())  # joining these would fold a triangle
    others = [k for k in range(len(vertices)) if k not in near]
    faces = faces.copy()
    if others:
        faces[faces == a] = rng.choice(others)
    return vertices, faces


def mixed(rng):
    """Some triangles are flipped."""
    vertices, faces = solid(rng, some_faces(rng))
    back = rng.random(len(faces)) < rng.choice([0.01, 0.1, 0.5])
    return vertices, np.where(back[:, None], faces[:, ::-1], faces)


def one_triangle_doubled(rng):
    """Repeats a triangle twice, as it is and flipped, so that an even number meets at each of its edges."""
    vertices, faces = solid(rng, some_faces(rng))
    one = faces[rng.integers(len(faces))]
    return vertices, np.concatenate([faces, [one, one[::-1]]])


def doubled(rng):
    """The whole body twice in the same place."""
    once = solid(rng, some_faces(rng, MOST_FACES // 2))
    return joined(once, turned_inside_out(once) if rng.random() < 0.5 else once)


def huge_or_tiny(rng):
    return moved(bumpy(rng, some_faces(rng)), size=small_or_large(rng, *rng.choice([(1e-30, 1e30), (1e-100, 1e100)])))


def far_away(rng):
    direction = rng.normal(size=3)
    distance = small_or_large(rng, 10, 1e9)
    return moved(bumpy(rng, some_faces(rng)), distance * direction / np.linalg.norm(direction))


def different_sizes(rng):
    """One body and many tiny ones."""
    n = int(rng.integers(1, 12))
    parts = [solid(rng, 500)]
    for _ in range(n):
        size = small_or_large(rng, 1e-6, 0.3)
        parts.append(moved(solid(rng, 60), rng.uniform(-3, 3, 3), size))
    return joined(*parts)


def tori(rng):
    """Tori from thin rings to tori that intersect themselves."""
    side = max(3, round((some_faces(rng) / 4)**0.5))
    return torus(2 * side, side, 1, small_or_large(rng, 1e-3, 1.5))


def unwelded(rng):
    """Every triangle has its own corners, as in STL."""
    vertices, faces = solid(rng, some_faces(rng))
    return vertices[faces].reshape(-1, 3), np.arange(faces.size).reshape(-1, 3)


def stars(rng):
    """Steep and coarse: radii of neighbours differ by orders of magnitude."""
    vertices, faces = sphere(some_faces(rng, 300))
    steepness = rng.uniform(0.1, 3)
    return vertices * np.exp(steepness * rng.normal(size=(len(vertices), 1))), faces


def tetrahedron(rng):
    """The smallest closed mesh."""
    return tetrahedra(rng.normal(size=(1, 4, 3)))


def squashed(rng):
    """A solid flattened by up to 1e9."""
    vertices, faces = solid(rng, some_faces(rng))
    return vertices * (1, 1, small_or_large(rng, 1e-9, 1e-1)), faces


KINDS = (boxes, stars, soups, nested, needles, mixed, touching, one_triangle_doubled, plates,
         crossing, huge_or_tiny, tori, far_away, unwelded, doubled, different_sizes, two_sided,
         pinched, tetrahedron, squashed)


def random_shape(number, seed=1):
    """Returns the shape of that number: kinds in turn, everything else random."""
    rng = np.random.default_rng([seed, number])
    make = KINDS[number % len(KINDS)]
    mesh = make(rng)
    if rng.random() < 0.5:
        mesh = turned(rng, mesh)
    # Single precision, as in STL, changes thin or distant shapes.
    formats = ["stl"] if make is unwelded else ["off", "ply", "obj"]
    return Shape(number, make.__name__, *mesh, formats[rng.integers(len(formats))])


# ---- files ---------------------------------------------------------------------------------------

def content(shape):
    """Returns the file of a shape in its format."""
    v, f = shape.vertices, shape.faces
    if shape.kind == "stl":
        records = np.zeros(len(f), dtype=[("floats", "<f4", 12), ("none", "<u2")])
        records["floats"][:, 3:] = v[f].reshape(-1, 9)
        return b"\0" * 80 + struct.pack("<I", len(f)) + records.tobytes()
    if shape.kind == "ply":
        head = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(v)}\n"
                + "".join(f"property double {x}\n" for x in "xyz")
                + f"element face {len(f)}\nproperty list uchar int vertex_indices\nend_header\n")
        records = np.zeros(len(f), dtype=[("count", "u1"), ("corners", "<i4", 3)])
        records["count"], records["corners"] = 3, f
        return head.encode() + v.astype("<f8").tobytes() + records.tobytes()
    if shape.kind == "obj":
        lines = ["v %r %r %r" % tuple(p) for p in v.tolist()]
        lines += ["f %d %d %d" % tuple(t) for t in (f + 1).tolist()]
    else:
        lines = ["OFF", f"{len(v)} {len(f)} 0"] + ["%r %r %r" % tuple(p) for p in v.tolist()]
        lines += ["3 %d %d %d" % tuple(t) for t in f.tolist()]
    return ("\n".join(lines) + "\n").encode()
