"""Random calls: any input gives a result or an exception. RHOLM_RANDOM_CALLS sets the number of
calls (default 60). scripts/python-sanitized runs the tests under AddressSanitizer.
"""

from __future__ import annotations

import itertools
import os

import numpy as np
import rholm
from hypothesis import HealthCheck, event, given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from rholm import harmonics

CALLS = int(os.environ.get("RHOLM_RANDOM_CALLS", "60"))

DTYPES = st.sampled_from(["f4", "f8", "f2", ">f8", "i4", "i8", "u1", "u4", "?", "c16", "O", "U1"])
SHAPES = st.one_of(
    st.tuples(st.integers(0, 40), st.just(3)),
    hnp.array_shapes(min_dims=0, max_dims=4, min_side=0, max_side=6),
    st.sampled_from([(2, 3, 3), (2, 5, 5), (2, 0, 0), (2, 1, 1), (3, 3), (4,), (3,)]),
)
NUMBERS = st.one_of(
    st.floats(allow_nan=True, allow_infinity=True, width=32),
    st.sampled_from([0.0, 1.0, -1.0, 1e300, -0.0, 1e-300]),
)


@st.composite
def arrays(draw):
    """Arrays of any type, shape and layout."""
    dtype = np.dtype(draw(DTYPES))
    shape = draw(SHAPES)
    if dtype.kind in "OU":
        return np.full(shape, "x" if dtype.kind == "U" else None, dtype)
    values = np.zeros(shape, "f8")
    if values.size:
        pattern = draw(st.lists(NUMBERS, min_size=1, max_size=12))
        values.flat[:] = np.resize(pattern, values.size)
    with np.errstate(all="ignore"):
        array = values.astype(dtype)
    layout = draw(st.sampled_from(["C", "F", "reversed", "read-only", "every second"]))
    if layout == "F":
        array = np.asfortranarray(array)
    elif layout == "reversed" and array.ndim:
        array = array[::-1]
    elif layout == "every second" and array.ndim:
        array = np.repeat(array, 2, axis=0)[::2]
    elif layout == "read-only":
        array.flags.writeable = False
    return array


@st.composite
def meshes(draw):
    """Vertices and triangles that usually form a mesh: a body, damaged or not."""
    body = draw(st.sampled_from([rholm.icosphere(1), rholm.box((1, 2, 3), 2), rholm.torus(2, 1, 8, 6)]))
    vertices, triangles = np.array(body.vertices), np.array(body.faces)
    damage = draw(
        st.sampled_from(["none", "none", "number", "index", "hole", "flat", "large", "double", "flip"])
    )
    at = draw(st.integers(0, len(triangles) - 1))
    if damage == "number":
        vertices[at % len(vertices), 1] = draw(NUMBERS)
    elif damage == "index":
        triangles[at, 0] = draw(st.integers(0, 2**32 - 1))
    elif damage == "hole":
        triangles = np.delete(triangles, at, axis=0)
    elif damage == "flat":
        vertices[:, 2] = 0
    elif damage == "large":
        vertices *= draw(st.sampled_from([1e-300, 1e-30, 1e30, 1e300]))
    elif damage == "double":
        triangles = np.concatenate([triangles, triangles[at:]])
    elif damage == "flip":
        triangles[at] = triangles[at, ::-1]
    floats = draw(st.sampled_from(["f4", "f8"]))
    ints = draw(st.sampled_from(["i4", "i8", "u4"]))
    with np.errstate(all="ignore"):
        return vertices.astype(floats), triangles.astype(ints)


ANYTHING = st.one_of(
    arrays(),
    meshes(),
    st.tuples(arrays(), arrays()),
    st.none(),
    st.integers(-3, 20),
    st.text(max_size=8),
    st.lists(NUMBERS, max_size=4),
    NUMBERS,
)


def mostly(valid):
    """Valid arguments of a function, and in one draw of ten any other value."""
    return st.integers(0, 9).flatmap(lambda k: ANYTHING if k == 0 else valid)


def among(*values):
    """Usually one of some values."""
    return mostly(st.sampled_from(values))


def number(low, high):
    """Usually a number in a range."""
    return mostly(st.floats(low, high))


def count(low, high):
    """Usually a whole number in a range."""
    return mostly(st.integers(low, high))


SOME = st.integers(1, 30)


def rows(n=SOME):
    """Vectors."""
    return mostly(
        n.flatmap(lambda k: hnp.arrays("f8", (k, 3), elements=st.floats(-2, 2).map(lambda x: x or 0.5)))
    )


def list_of(n):
    """Numbers."""
    return mostly(hnp.arrays("f8", (n,), elements=st.floats(-2, 2)))


SEED = st.integers(0, 20)
MESH = mostly(meshes())
CLOUD = mostly(
    SEED.map(lambda k: rholm.sample_surface(rholm.torus(2, 0.8, 12, 8), 60 + 20 * k, seed=k + 1).points)
)
BODY = mostly(SEED.map(lambda k: rholm.expand(rholm.bumpy_sphere(1, 0.2, seed=k), 1 + k % 7)))
COEFFICIENTS = mostly(
    SEED.map(lambda k: np.random.default_rng(k).normal(size=(2, 1 + k % 6, 1 + k % 6)))
    .map(lambda c: np.tril(c))
    .map(lambda c: np.stack([c[0], np.where(np.arange(len(c[1])) > 0, c[1], 0)]))
)
POINT = mostly(hnp.arrays("f8", (3,), elements=st.floats(-0.2, 0.2)))
DEGREE = count(0, 12)
THREADS = among(0, 1, 2)
REGION = mostly(
    st.one_of(
        st.just("ball:0,0,1,0.8"), st.just("vertex:0,0.9"), hnp.arrays(bool, (162,)), st.just([0, 1, 2])
    )
)
FINE = mostly(SEED.map(lambda k: rholm.bumpy_sphere(2, 0.1, seed=k)))

#: Each function with its required and optional arguments.
FUNCTIONS = [
    (
        rholm.expand,
        {"shape": MESH},
        {
            "degree": DEGREE,
            "center": mostly(st.one_of(st.sampled_from(["auto", "none", "volume"]), POINT)),
            "precision": number(1e-12, 1e-2),
            "signed": st.booleans(),
            "weld": number(0, 1e-3),
            "threads": THREADS,
            "method": among("edge", "gauge", "curl", "area"),
        },
    ),
    (rholm.expand, {"shape": MESH, "tolerance": number(1e-2, 1)}, {"max_degree": count(1, 20)}),
    (
        rholm.compress,
        {"shape": MESH, "tolerance": number(0.02, 0.2)},
        {"unit": among("diagonal", "absolute")},
    ),
    (
        rholm.reconstruct,
        {"points": CLOUD},
        {"normals": rows(), "step": number(0.1, 1), "noise": number(0, 0.1)},
    ),
    (rholm.clouds.foresee_tiles, {"points": count(0, 10**12)}, {"tile_points": count(0, 1 << 20)}),
    (rholm.orient, {"points": CLOUD}, {"center": POINT, "neighbors": count(3, 20), "sensor": POINT}),
    (rholm.clouds.clean, {"points": CLOUD}, {}),
    (rholm.inspect, {"mesh": MESH}, {}),
    (rholm.repair, {"mesh": MESH}, {"weld": number(0, 0.1), "max_hole": count(0, 50)}),
    (
        rholm.simplify,
        {"mesh": MESH},
        {"faces": count(4, 50), "share": number(0.1, 1), "max_error": number(0, 1)},
    ),
    (rholm.meshes.weld, {"mesh": MESH}, {"tolerance": number(0, 0.3)}),
    (rholm.meshes.pair_edges, {"mesh": MESH}, {}),
    (rholm.meshes.flip, {"mesh": MESH}, {}),
    (rholm.meshes.largest_component, {"mesh": MESH}, {}),
    (rholm.meshes.closing_tolerance, {"mesh": MESH}, {}),
    (harmonics.find_center, {"mesh": MESH}, {"rays": count(0, 100)}),
    (harmonics.check_star, {"mesh": MESH, "center": POINT}, {"rays": count(0, 100)}),
    (
        rholm.sample_surface,
        {"mesh": MESH},
        {"points": count(1, 50), "noise": number(0, 1), "outliers": number(0, 1)},
    ),
    (rholm.compare, {"a": MESH, "b": MESH, "samples": count(1, 50)}, {}),
    (rholm.meshes.distances_to_surface, {"points": rows(), "mesh": MESH}, {}),
    (
        rholm.from_array,
        {"values": COEFFICIENTS},
        {"center": POINT, "function": among("radius", "gauge", "other")},
    ),
    (harmonics.power_spectrum, {"coefficients": COEFFICIENTS}, {}),
    (
        harmonics.evaluate,
        {"coefficients": COEFFICIENTS, "directions": rows()},
        {"precision": number(1e-13, 1e-2)},
    ),
    (
        harmonics.evaluate_with_gradient,
        {"coefficients": BODY, "directions": rows()},
        {"engine": among("fast", "direct")},
    ),
    (
        harmonics.adjoint,
        {"directions": rows(st.just(7)), "degree": DEGREE},
        {"weights": list_of(7), "gradients": rows(st.just(7)), "hessians": mostly(hnp.arrays("f8", (7, 6)))},
    ),
    (
        harmonics.synthesize_grid,
        {"coefficients": COEFFICIENTS},
        {"n_theta": count(1, 30), "n_phi": count(12, 30)},
    ),
    (
        harmonics.analyze_grid,
        {"values": mostly(hnp.arrays("f8", (9, 17), elements=st.floats(-2, 2)))},
        {"degree": DEGREE},
    ),
    (
        harmonics.evaluate_rings,
        {"coefficients": COEFFICIENTS, "colatitudes": list_of(5), "n_phi": count(12, 30)},
        {},
    ),
    (
        harmonics.rotate,
        {"thing": BODY, "rotation": mostly(rows(st.just(1)).map(np.ravel))},
        {"about": POINT},
    ),
    (rholm.rotation_about, {"axis": POINT, "angle": number(-9, 9)}, {}),
    (harmonics.as_rotation, {"rotation": list_of(4)}, {}),
    (harmonics.mirror, {"thing": BODY, "axis": among("x", "y", "z")}, {"about": POINT}),
    (harmonics.filter, {"thing": BODY, "gains": list_of(5)}, {}),
    (rholm.align, {"a": BODY, "b": BODY, "bandwidth": count(1, 6)}, {"mirror": st.booleans()}),
    (harmonics.principal_axes, {"coefficients": COEFFICIENTS}, {}),
    (harmonics.distance, {"a": COEFFICIENTS, "b": BODY}, {}),
    (harmonics.scaled, {"expansion": BODY, "factor": number(0.1, 10)}, {}),
    (harmonics.recentered, {"expansion": BODY, "center": POINT}, {}),
    (
        harmonics.synthesize,
        {"model": BODY},
        {"degree": DEGREE, "subdivisions": count(0, 3), "like": MESH},
    ),
    (
        rholm.smooth,
        {"mesh": FINE, "region": REGION, "wavelength": number(0.5, 2)},
        {"strength": number(-1, 2)},
    ),
    (rholm.meshes.region_weights, {"mesh": FINE, "region": REGION}, {"transition": number(0, 1)}),
    (
        rholm.transfer,
        {"source": FINE, "source_region": REGION, "target": FINE, "target_region": REGION},
        {"from_degree": count(2, 8), "height": number(-2, 2), "angle": number(-4, 4)},
    ),
    (
        rholm.render,
        {"shape": MESH, "size": st.just((20, 20))},
        {"scalars": list_of(42), "view": POINT, "up": POINT},
    ),
    (
        rholm.render,
        {"shape": CLOUD, "size": st.just((20, 20))},
        {"point_radius": number(0, 1), "colors": rows()},
    ),
    (harmonics.inertia, {"expansion": BODY}, {}),
    (rholm.figures.encode_png, {"image": mostly(hnp.arrays("u1", (4, 5, 3)))}, {}),
    (rholm.clouds.as_points, {"shape": CLOUD}, {"normals": rows()}),
    (rholm.meshes.bounds, {"points": rows()}, {}),
    (
        rholm.files.parse_shape,
        {"data": mostly(st.binary(max_size=200))},
        {"name": among("a.ply", "a.xyz", "a.stl")},
    ),
    (
        rholm.files.parse_coefficients,
        {"data": mostly(st.binary(max_size=200))},
        {"name": among("a.sh", "a.npy")},
    ),
    (
        rholm.low_pass,
        {"cutoff": count(0, 9), "degree": count(0, 20)},
        {"window": among("heat", "ideal", "plateau"), "order": count(1, 64), "time": number(1e-4, 1)},
    ),
    (harmonics.overshoot, {"gains_or_window": list_of(9)}, {"degree": DEGREE}),
    (
        rholm.Mesh,
        {"vertices": rows(), "triangles": mostly(hnp.arrays("i4", (5, 3)))},
        {"attributes": ANYTHING},
    ),
]

#: Exceptions that a call may raise; any other one is a defect.
ALLOWED = (rholm.Error, TypeError, ValueError, IndexError, OverflowError)

#: Number of calls; long runs report every thousandth (visible with -s).
calls_made = itertools.count(1)


@settings(
    max_examples=CALLS,
    deadline=None,
    derandomize=CALLS <= 60,
    database=None,
    suppress_health_check=list(HealthCheck),
)
@given(data=st.data())
def test_random_calls_are_answered_or_refused(data):
    function, required, options = data.draw(st.sampled_from(FUNCTIONS))
    arguments = {name: data.draw(values, label=name) for name, values in required.items()}
    arguments |= {
        name: data.draw(values, label=name) for name, values in options.items() if data.draw(st.booleans())
    }
    if (made := next(calls_made)) % 1000 == 0:
        print(f"{made} random calls", flush=True)
    try:
        function(**arguments)
        event("answered")
    except ALLOWED:
        event("refused")
