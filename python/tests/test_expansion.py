"""Expansions: closed forms and identities."""

from __future__ import annotations

import copy
import pickle
import subprocess

import numpy as np
import pytest
import rholm
from rholm import harmonics


def test_a_sphere_has_only_degree_zero():
    s = rholm.from_array(np.pad([[[2.0]], [[0.0]]], ((0, 0), (0, 3), (0, 3))))
    assert s.degree == 3
    assert np.isclose(s.volume, 32 / 3 * np.pi, rtol=1e-13)
    assert np.isclose(s.area, 16 * np.pi, rtol=1e-12)
    assert np.allclose(s([[1, 2, 3], [0, 0, -5]]), 2, rtol=1e-14)
    assert np.allclose(s.gradient([1, 2, 3]), 0, atol=1e-13)
    assert np.allclose(np.linalg.norm(s.mesh(3).vertices, axis=1), 2, rtol=1e-13)
    assert np.allclose(s.spectrum(), [4, 0, 0, 0])
    assert np.allclose(s.spectrum("energy"), [16 * np.pi, 0, 0, 0])
    for wrong in ({"kind": "l2norm"}, {"unit": "per_m"}, {"base": 1.0}, {"base": np.nan}):
        with pytest.raises(rholm.InvalidInputError):
            s.spectrum(**wrong)
    assert s.mean_radius == 2


def test_coefficients_are_integrals_over_the_surface(bumpy):
    # Independent reference: radii along rays to Gauss-Legendre nodes, by exact closest triangles.
    s = rholm.expand(bumpy, 4, precision=1e-12)
    n = 120
    theta = harmonics.grid_colatitudes("gauss-legendre", n)
    _, weights = harmonics.gauss_legendre(n)
    phi = 2 * np.pi * np.arange(2 * n) / (2 * n)
    sines = np.sin(theta)[:, None]
    rays = np.stack(
        [sines * np.cos(phi), sines * np.sin(phi), np.broadcast_to(np.cos(theta)[:, None], (n, 2 * n))],
        axis=-1,
    ).reshape(-1, 3)
    a, b, c = (bumpy.vertices[bumpy.faces[:, k]] - s.center for k in range(3))
    normal = np.cross(b - a, c - a)
    radii = np.zeros(len(rays))
    for t in range(len(a)):  # rays that meet triangle t, and where
        inside = np.ones(len(rays), bool)
        for p, q in ((a, b), (b, c), (c, a)):
            inside &= rays @ np.cross(p[t], q[t]) >= 0
        radii[inside] = (normal[t] @ a[t]) / (rays[inside] @ normal[t])
    assert (radii > 0).all()
    # Y_00 = 1 and Y_20 in the 4 pi normalisation.
    mean = (radii.reshape(n, -1).mean(axis=1) * weights).sum() / 2
    cos2 = 1.5 * np.cos(theta) ** 2 - 0.5
    y20 = (radii.reshape(n, -1).mean(axis=1) * weights * cos2).sum() / 2 * np.sqrt(5)
    assert abs(s.coeffs[0, 0, 0] - mean) < 1e-4  # creases: the error is the grid's, not the library's
    assert abs(s.coeffs[0, 2, 0] - y20) < 1e-4


def test_a_direct_sum_agrees_with_the_fast_one(bumpy):
    fast = rholm.expand(bumpy, 30, precision=1e-10)
    direct = rholm.expand(bumpy, 30, engine="direct", center=fast.center)
    scale = np.linalg.norm(direct.coeffs[:, 1:])
    assert np.linalg.norm(fast.coeffs - direct.coeffs) <= 1e-10 * scale


def test_a_tolerance_is_kept(bumpy):
    for unit, norm in (("absolute", "rms"), ("diagonal", "rms"), ("radius", "max")):
        s = rholm.expand(bumpy, tolerance=3e-3, unit=unit, norm=norm)
        kept = s.expanded.tolerance
        assert kept.met
        assert kept.reached <= kept.allowed
        assert kept.degrees[-1] >= s.degree
    with pytest.raises(rholm.InvalidInputError, match="exclude"):
        rholm.expand(bumpy, 3, tolerance=0.1)


def test_errors_are_those_of_the_surface(bumpy):
    s = rholm.expand(bumpy, 12)
    there = s(bumpy.vertices - s.center)
    radii = np.linalg.norm(bumpy.vertices - s.center, axis=1)
    assert np.abs(there - radii).max() <= 1.0001 * s.errors.measured_max
    assert s.errors.rms_is_exact == (s.expanded.transform.truncation_rms is not None)
    assert harmonics.truncation_errors(bumpy, s).rms == pytest.approx(s.errors.rms, rel=1e-6)


def test_gradients_are_derivatives(bumpy, random):
    s = rholm.expand(bumpy, 16)
    u = random.normal(size=(20, 3))
    u /= np.linalg.norm(u, axis=1, keepdims=True)
    gradient = s.gradient(u)
    assert np.abs((gradient * u).sum(axis=1)).max() < 1e-10
    t = np.cross(u, [0.3, -0.2, 0.9])
    t /= np.linalg.norm(t, axis=1, keepdims=True)
    h = 1e-4
    numeric = (s(np.cos(h) * u + np.sin(h) * t) - s(np.cos(h) * u - np.sin(h) * t)) / (2 * h)
    # Third derivatives at degree L are at most about L^3 times the values.
    assert np.abs((gradient * t).sum(axis=1) - numeric).max() < 16**3 * h**2


def test_the_gauge_is_one_over_r(bumpy):
    gauge = rholm.expand(bumpy, 24, method="gauge")
    radius = rholm.expand(bumpy, 24, center=gauge.center)
    assert gauge.function == "gauge"
    u = [[0, 0, 1], [1, 1, 1]]
    assert np.allclose(gauge(u), radius(u), rtol=0.02)
    assert np.allclose(gauge.gradient(u), radius.gradient(u), atol=0.2)


def test_points_lie_on_the_mesh(bumpy):
    s = rholm.expand(bumpy, 10)
    mesh = s.mesh(3)
    sphere = rholm.icosphere(3).vertices
    assert np.abs(s.points(sphere) - mesh.vertices).max() < 1e-11
    assert s.points(np.ones((2, 5, 3))).shape == (2, 5, 3)
    like = s.mesh(like=bumpy)
    assert np.array_equal(like.faces, bumpy.faces)
    assert len(s.mesh(grid=(10, 20)).vertices) == 202
    levels = s.meshes([0, 5, 10], 2)
    assert np.allclose(np.linalg.norm(levels[0].vertices - s.center, axis=1), s.mean_radius)
    with pytest.raises(rholm.InvalidInputError, match="exclude"):
        s.mesh(3, grid=(10, 20))


def test_rotations_turn_points_and_functions_alike(bumpy, random):
    s = rholm.expand(bumpy, 12)
    turn = rholm.rotation_about((1, -2, 0.5), 1.1)
    turned = s.rotate(turn, about=(1, 2, 3))
    u = random.normal(size=(20, 3))
    assert np.allclose(turned(harmonics.rotate(u, turn)), s(u), rtol=1e-11)
    assert np.allclose(turned.center, harmonics.rotate(s.center, turn, about=(1, 2, 3)))
    matrix = harmonics.matrix_of(turn)
    assert np.allclose(matrix @ matrix.T, np.eye(3), atol=1e-15)
    assert harmonics.angle_between(harmonics.rotation_of(matrix), turn) < 1e-7
    assert harmonics.angle_between(harmonics.rotation_of(*harmonics.euler_angles_of(turn)), turn) < 1e-7
    axis, angle = harmonics.axis_angle_of(turn)
    assert np.isclose(angle, 1.1)
    assert np.allclose(axis, np.array([1, -2, 0.5]) / np.sqrt(5.25))
    identity = harmonics.compose(harmonics.inverse(turn), turn)
    assert harmonics.angle_between(identity, harmonics.Rotation()) < 1e-7
    assert np.allclose(harmonics.rotate(s.coeffs, turn), s.rotate(turn).coeffs, atol=1e-13)
    assert np.allclose(s.mirror("x").mirror("x").coeffs, s.coeffs)
    assert np.allclose(s.mirror("z")(u * [1, 1, -1]), s(u))
    scipy_rotation = pytest.importorskip("scipy.spatial.transform").Rotation.from_rotvec(1.1 * axis)
    assert harmonics.angle_between(scipy_rotation, turn) < 1e-7


def test_alignment_finds_the_turn_back(bumpy):
    s = rholm.expand(bumpy, 12)
    turn = rholm.rotation_about((1, 2, 0.5), 2)
    placement = rholm.align(s, s.rotate(turn))
    assert harmonics.angle_between(placement.alignment.best.rotation, turn) < 1e-6
    moved = rholm.placed(s, placement)
    assert harmonics.distance(moved, s.rotate(turn)) < 1e-6
    alignment = rholm.align(s.coeffs, s.rotate(turn).coeffs)
    assert harmonics.angle_between(alignment.best.rotation, turn) < 1e-6
    assert harmonics.descriptor_distance(s, s.rotate(turn)) < 1e-12


def test_filters(bumpy):
    s = rholm.expand(bumpy, 12)
    gains = rholm.low_pass(6, 12)
    assert gains.shape == (13,)
    assert np.allclose(s.filter(gains).coeffs[0, 3], s.truncate(6).coeffs[0, 3, :7] * gains[3])
    assert s.filter(gains, "soft").method.endswith("soft")
    assert np.allclose(rholm.low_pass(5, 12) + rholm.high_pass(6, 12), 1)
    assert np.allclose(rholm.band_pass(3, 7, 12), rholm.low_pass(7, 12) - rholm.low_pass(2, 12))
    assert np.allclose(harmonics.sharpened([1, 0.5], 2), [1, 2])
    assert harmonics.overshoot("ideal", 64).above == pytest.approx(0.088, abs=0.002)
    assert harmonics.overshoot("heat", 64).above == 0
    assert harmonics.overshoot(rholm.low_pass(64, 64)).above == harmonics.overshoot("lanczos", 64).above
    with pytest.raises(rholm.InvalidInputError):
        rholm.low_pass(3, 12, "triangle")


def test_a_surface_is_what_is_said_to_be_one():
    harmonics.require_surface(rholm.from_array([[[-1.0]], [[0.0]]]))  # a negative radius
    with pytest.raises(rholm.UnsupportedError):
        harmonics.require_surface(rholm.from_array([[[1.0]], [[0.0]]], function="other"))


def test_low_pass_knows_the_degree(bumpy):
    s = rholm.expand(bumpy, 12)
    assert s.low_pass(6) == s.filter(rholm.low_pass(6, 12))
    assert s.low_pass(6).degree == 6
    assert s.low_pass(6, "ideal") == s.truncate(6)
    assert s.low_pass(6).method.endswith("low-pass 6 lanczos")
    warm = s.low_pass(6, "heat", time=0.01)
    assert warm == s.filter(rholm.low_pass(0, 12, "heat", time=0.01))
    assert warm.method.endswith("heat 0.01")
    soft = s.low_pass(9, "exponential", order=2)
    assert soft == s.filter(rholm.low_pass(9, 12, "exponential", order=2))
    for wrong in (lambda: s.low_pass(-1), lambda: s.low_pass(6, "triangle")):
        with pytest.raises(rholm.InvalidInputError):
            wrong()


def test_sums_and_their_transpose(bumpy, random):
    s = rholm.expand(bumpy, 9)
    u = random.normal(size=(200, 3))
    w = random.normal(size=200)
    for normalization, csphase in (("orthonormal", 1), ("4pi", -1), ("schmidt", 1)):
        sums = harmonics.adjoint(u, w, degree=9, normalization=normalization, csphase=csphase)
        # <f(u), w> = <c, sums>
        assert np.isclose(w @ s(u), (s.to_array(normalization, csphase) * sums).sum(), rtol=1e-10)
    direct = harmonics.evaluate(s, u, engine="direct")
    assert np.abs(direct - harmonics.evaluate(s, u)).max() < 1e-10
    values, gradients = harmonics.evaluate_with_gradient(s, u.reshape(10, 20, 3))
    assert values.shape == (10, 20)
    assert gradients.shape == (10, 20, 3)
    g = random.normal(size=(200, 3))
    unit = u / np.linalg.norm(u, axis=1, keepdims=True)
    sums = harmonics.adjoint(u, degree=9, gradients=g)
    assert np.isclose((g * s.gradient(unit)).sum(), (s.to_array("orthonormal") * sums).sum(), rtol=1e-9)


def test_grids_come_back(bumpy):
    s = rholm.expand(bumpy, 9)
    for kind in ("gauss-legendre", "equiangular", "equiangular-with-poles"):
        grid = harmonics.synthesize_grid(s, kind)
        assert grid.shape == harmonics.smallest_grid(kind, 9)
        assert harmonics.exact_degree(kind, *grid.shape) >= 9
        assert np.abs(harmonics.analyze_grid(grid, kind, 9) - s.coeffs).max() < 1e-13
        rings = harmonics.evaluate_rings(s, harmonics.grid_colatitudes(kind, grid.shape[0]), grid.shape[1])
        assert np.abs(rings - grid).max() < 1e-12


def test_centres_have_names(bumpy):
    kernel, slope = (rholm.expand(bumpy, 4, center=kind) for kind in ("kernel", "slope"))
    assert not np.allclose(kernel.center, slope.center)
    assert np.all(rholm.expand(bumpy, 4).center == slope.center)
    assert kernel.expanded.star.min_d >= slope.expanded.star.min_d > 0
    with pytest.raises(rholm.InvalidInputError, match="kernel"):
        rholm.expand(bumpy, 4, center="middle")


def test_recentering_keeps_the_surface():
    s = rholm.expand(rholm.ellipsoid((1.2, 1, 0.9), 4), 12, center=(0.05, 0, 0))
    moved = s.recenter()
    assert np.allclose(moved.center, s.centroid, atol=1e-12)
    assert np.isclose(moved.volume, s.volume, rtol=1e-6)
    assert np.allclose(harmonics.recentered(s, (0, 0, 0.05)).center, (0, 0, 0.05))
    with pytest.raises(rholm.NotStarShapedError):
        s.recenter((5, 0, 0))


def test_units_scale(bumpy):
    s = rholm.expand(bumpy, 5, length_unit="km")
    metres = s.scale(harmonics.metres_of("km"), "m")
    assert metres.unit == "m"
    assert np.isclose(metres.volume, 1e9 * s.volume, rtol=1e-12)
    assert harmonics.metres_of("parsnip") is None
    with pytest.raises(rholm.InvalidInputError):
        s.with_unit("a\nb")


@pytest.mark.parametrize("name", ["m.h5", "m.sh", "m.gfc", "m.json", "m.npy"])
def test_files_come_back(bumpy, tmp_path, name):
    s = rholm.expand(bumpy, 7, length_unit="km")
    s.save(tmp_path / name)
    back = rholm.load(tmp_path / name)
    assert np.abs(back.coeffs - s.coeffs).max() <= 1e-15
    if name != "m.npy":
        assert back.unit == "km"
        assert np.allclose(back.center, s.center, rtol=1e-15)
    if name == "m.h5":
        assert back == s
        assert back.errors.rms == s.errors.rms
        assert rholm.files.is_model_file(tmp_path / name)
    else:
        read = rholm.files.read_coefficients(tmp_path / name)
        assert read.normalization == "4pi"
        data = (tmp_path / name).read_bytes()
        assert np.array_equal(rholm.files.parse_coefficients(data, name).expansion.coeffs, back.coeffs)


def test_the_program_gives_the_same_bits(program, bumpy, tmp_path):
    bumpy.save(tmp_path / "b.ply")
    run = [program, "expand", tmp_path / "b.ply", "--degree", "20", "-o", tmp_path / "m.h5", "--quiet"]
    subprocess.run(run, check=True)
    theirs = rholm.load(tmp_path / "m.h5")
    ours = rholm.expand(tmp_path / "b.ply", 20)
    assert theirs == ours
    assert theirs.errors.rms == ours.errors.rms
    subprocess.run(
        [program, "synthesize", tmp_path / "m.h5", "-o", tmp_path / "s.ply", "--quiet"], check=True
    )
    surface = rholm.read_shape(tmp_path / "s.ply").shape
    assert np.array_equal(surface.vertices, ours.mesh().vertices)
    assert np.array_equal(surface.faces, ours.mesh().faces)


def test_what_is_not_star_shaped_is_refused_or_signed(ring):
    with pytest.raises(rholm.NotStarShapedError, match="min d") as refusal:
        rholm.expand(ring, 4)
    assert isinstance(refusal.value, ValueError)
    assert isinstance(refusal.value, rholm.InvalidInputError)
    assert rholm.expand(ring, 4, signed=True, center=(2, 0, 0)).degree == 4


def test_a_signed_sum_has_no_figures_of_the_body(ring):
    s = rholm.expand(ring, 4, signed=True, center=(0, 0, 0))
    assert s.signed_sum
    for figure in (s.volume, s.area, s.centroid, s.sphericity, s.mean_radius, s.errors, s.norm_squared):
        assert figure is None
    measures = s.measure()
    assert all(value is None for value in measures.to_dict().values())
    assert measures == pickle.loads(pickle.dumps(measures))
    for of_the_body in (s.inertia, s.recenter, lambda: harmonics.volume_centroid(s)):
        with pytest.raises(rholm.UnsupportedError, match="signed sum"):
            of_the_body()
    with pytest.raises(rholm.UnsupportedError, match="the volume"):
        harmonics.require_star_shaped(s, "the volume")
    assert "not known" in s._repr_html_()
    for kept in (
        s.with_unit("km"),
        s.rotate(rholm.rotation_about((0, 0, 1), 0.5)),
        s.low_pass(3),
        s.truncate(2),
        s.scale(2),
        2 * s,
        s + s,
        pickle.loads(pickle.dumps(s)),
    ):
        assert kept.signed_sum
    assert not rholm.expand(rholm.icosphere(2), 4, signed=True).signed_sum


def test_what_is_left_out_is_known_or_nan(bumpy):
    s = rholm.expand(bumpy, 8)
    beyond = harmonics.rms_beyond(s)
    assert np.isclose(beyond[-1], s.errors.rms, rtol=1e-6)
    energy = s.spectrum("energy")
    assert np.allclose(beyond[:-1] ** 2 - beyond[1:] ** 2, energy[1:] / (4 * np.pi))
    sphere = rholm.expand(rholm.icosphere(6), 8)  # its faces have almost no truncation error
    assert np.isnan(harmonics.rms_beyond(sphere)[-1])
    assert np.isnan(harmonics.rms_beyond(rholm.from_array(s.coeffs))).all()


def test_the_centroid_or_a_point_on_the_way_is_seen(bumpy):
    s = rholm.expand(bumpy, 8)
    assert np.all(harmonics.seen_center(s, s.centroid) == s.centroid)
    assert np.allclose(s.recenter().center, s.centroid)
    far = harmonics.seen_center(s, s.center + np.array([9.0, 0, 0]))
    assert 0.1 < np.linalg.norm(far - s.center) < 2
    assert np.allclose(s.recenter(far).volume, s.volume, rtol=0.01)


def test_charts_and_methods(bumpy):
    chart = harmonics.make_star_chart(bumpy)
    assert chart.report.star_shaped
    assert np.allclose(chart.mesh.vertices + chart.report.center, bumpy.vertices)
    edge = harmonics.expand_chart(chart, 6)
    for method in ("curl", "area"):
        other = harmonics.expand_chart(chart, 6, method=method).expansion
        assert np.abs(other.coeffs - edge.expansion.coeffs).max() < 1e-6
    # Parseval's identity: the norm in closed form bounds the energy of the coefficients.
    norm = harmonics.radius_norm_squared(chart)
    assert 0 < norm - edge.expansion.spectrum("energy").sum() < 1e-2 * norm
    found = harmonics.expand_chart(chart, tolerance=1e-2)
    assert found.tolerance.met
    assert harmonics.tail_strength(chart) == pytest.approx(edge.expansion.tail_strength, rel=1e-9)
    assert harmonics.vertex_error_strengths(bumpy, chart.report.center).radius == pytest.approx(
        harmonics.vertex_error_strength(chart), rel=1e-9
    )
    assert harmonics.gauge_norm_squared(chart) > 0
    sampled = harmonics.monte_carlo(chart, 4, samples=64)
    error = np.abs(sampled.expansion.coeffs - edge.expansion.truncate(4).coeffs)
    assert (error <= 5 * sampled.deviation + 1e-12).mean() > 0.95
    assert harmonics.find_center(bumpy).star_shaped
    assert not harmonics.check_star(bumpy, (10, 0, 0)).star_shaped


def test_reports(bumpy, tmp_path):
    flipped = rholm.meshes.flip(bumpy)
    assert rholm.expand(flipped, degree=4).expanded.flipped
    s = rholm.expand(bumpy, 6)
    page = s.report_html(tmp_path / "r.html", title="Body", picture_size=64)
    assert page.startswith("<!DOCTYPE html>")
    assert (tmp_path / "r.html").read_text() == page
    assert "Body" in page
    assert "<svg" in s.spectrum_svg()
    assert s._repr_html_().count("<?xml") == 0  # a part of a page
    assert repr(s).startswith("<rholm.Expansion: radius to degree 6")


def lower(n):
    """Ones at the places of coefficients."""
    ones = np.stack([np.tri(n), np.tri(n)])
    ones[1, :, 0] = 0
    return ones


def test_expansions_about_one_centre_can_be_added(bumpy, random):
    s = rholm.expand(bumpy, 8, center=(0.01, 0, 0), length_unit="km")
    t = rholm.expand(rholm.ellipsoid((1, 1.1, 1.2), 3), 5, center=(0.01, 0, 0), length_unit="km")
    u = random.normal(size=(40, 3))
    for made, expected in (
        (s + t, s(u) + t(u)),
        (s - t, s(u) - t(u)),
        (2 * s, 2 * s(u)),
        (s * np.float32(0.5), 0.5 * s(u)),
        (np.float64(2) * s, 2 * s(u)),
        (s / 4, s(u) / 4),
        (-s, -s(u)),
        ((s + t) / 2, (s(u) + t(u)) / 2),
        (s + 0.25 * (t - s), 0.75 * s(u) + 0.25 * t(u)),
    ):
        assert np.allclose(made(u), expected, atol=1e-13)
        assert made.unit == "km"
        assert np.array_equal(made.center, s.center)
        assert made.errors is None
    assert ((s + t) / 2).function == "radius"
    assert (s + 0.25 * (t - s)).function == "radius"
    assert (s + t).degree == 8
    for no_surface in (s - t, -s, 0 * s):  # their radius may be negative
        assert no_surface.function == "other"
        with pytest.raises(rholm.UnsupportedError):
            no_surface.volume  # noqa: B018
    gauge = rholm.expand(bumpy, 4, method="gauge")
    for wrong, said in (
        (lambda: s + rholm.expand(bumpy, 4, length_unit="km"), "about other centres"),
        (lambda: s + t.with_unit("m"), "in km and one in m"),
        (lambda: gauge + gauge, "gauge"),
        (lambda: 2 * gauge, "not linear in the radius"),
    ):
        with pytest.raises((rholm.InvalidInputError, rholm.UnsupportedError), match=said):
            wrong()
    for wrong in (lambda: s + 1, lambda: s * t, lambda: s * "2", lambda: s * np.ones(3), lambda: s * 1j):
        with pytest.raises(TypeError):
            wrong()
    with pytest.raises(ZeroDivisionError):
        s / 0


def test_truncation_cuts_off_and_never_pads(bumpy):
    s = rholm.expand(bumpy, 12)
    for degree in (0, 5, 11):
        assert s.truncate(degree).degree == degree
        assert np.array_equal(s.truncate(degree).coeffs, s.coeffs[:, : degree + 1, : degree + 1])
    for degree in (12, 13, 500):
        assert s.truncate(degree) == s
        assert s.truncate(degree).errors == s.errors
    with pytest.raises(rholm.InvalidInputError):
        s.truncate(-1)


def test_errors_that_follow_are_those_of_the_shape(bumpy):
    s = rholm.expand(bumpy, 12, precision=1e-12)
    for degree in (0, 3, 8):
        measured = harmonics.truncation_errors(bumpy, s.truncate(degree), precision=1e-12)
        assert s.truncate(degree).errors.rms == pytest.approx(measured.rms, rel=1e-7)
        assert s.truncate(degree).errors.diagonal == s.errors.diagonal
    # Measured along rays of the shape: the part that a filter removes is an error of the radius,
    # too.
    soft = s.low_pass(8)
    u = rholm.icosphere(5).vertices
    fine = rholm.expand(bumpy, 200, errors=False)
    seen = np.sqrt(np.mean((soft(u) - fine(u)) ** 2))
    assert soft.errors.rms == pytest.approx(seen, rel=1e-2)
    assert soft.errors.measured_max is None
    moved = s.recenter((0.01, 0, 0)).errors
    assert moved.rms is None
    assert moved.diagonal == s.errors.diagonal
    assert s.recenter(s.center).errors == s.errors


def test_what_an_expansion_is_not():
    field = rholm.from_array(lower(3), function="other")
    with pytest.raises(rholm.UnsupportedError):
        field.mesh()
    with pytest.raises(rholm.UnsupportedError):
        harmonics.require_surface(field)
    assert "function" in field._repr_html_()
    order, sine = lower(3), lower(3)
    order[0, 1, 2] = 1e-9
    sine[1, 2, 0] = 1
    for array, said in ((order, r"\[0, 1, 2\] has an order m above"), (sine, r"\[1, 2, 0\] is of sin\(0\)")):
        with pytest.raises(rholm.InvalidInputError, match=said):
            rholm.from_array(array)
    rounded = lower(3)  # as in sums over principal components
    rounded[0, 1, 2] = 1e-17
    assert np.array_equal(rholm.from_array(rounded).coeffs, rholm.from_array(lower(3)).coeffs)
    for wrong in (np.ones((2, 3, 4)), np.ones((3, 3)), np.full((2, 2, 2), np.nan), np.zeros((2, 0, 0))):
        with pytest.raises(rholm.InvalidInputError):
            rholm.from_array(wrong)
    with pytest.raises(TypeError):
        rholm.from_array(np.ones((2, 2, 2), complex))
    with pytest.raises(TypeError):
        harmonics.as_rotation(np.eye(3, dtype=complex))
    with pytest.raises(rholm.InvalidInputError):
        rholm.from_array(lower(2), normalization="quantum")
    with pytest.raises(rholm.InvalidInputError):
        field([0, 0, 0])


def test_inertia_is_that_of_the_solid_about_its_centroid(bumpy):
    trimesh = pytest.importorskip("trimesh")
    s = rholm.expand(bumpy, 24)
    mesh = s.mesh(7)
    solid = mesh.to_trimesh()
    tensor = s.inertia()
    # The chords of the icosphere cut off a share of the edge's square, 2e-4, in 5 powers.
    assert np.allclose(tensor, solid.moment_inertia, atol=1e-3 * np.trace(tensor))
    assert np.array_equal(tensor, tensor.T)
    assert np.array_equal(harmonics.inertia(s), tensor)
    ball = rholm.from_array([[[2.0]], [[0.0]]], center=(5, 0, 0))
    assert np.allclose(ball.inertia(), 0.4 * ball.volume * 4 * np.eye(3), rtol=1e-14)
    assert trimesh
    with pytest.raises(rholm.UnsupportedError):
        rholm.from_array(s.coeffs, function="other").inertia()


def test_what_a_gravity_field_is_relative_to_stays(tmp_path, random):
    values = np.stack([np.tri(5), np.tri(5)]) * random.normal(size=(2, 5, 5))
    values[1, :, 0] = 0
    plain = rholm.from_array(values, function="other")
    field = plain.with_gravity(4.9e12, 1738e3)
    assert plain.gravity is None
    assert field != plain
    assert "GM 4.9e+12, R 1.738e+06" in repr(field)
    kept = [
        field.truncate(3),
        field.low_pass(2),
        field.rotate(np.eye(3)),
        field.mirror("x"),
        field.with_unit("m"),
        field + field,
        field - 0.5 * field,
        copy.deepcopy(field),
        pickle.loads(pickle.dumps(field)),
    ]
    for name in ("f.h5", "f.json", "f.sh", "f.gfc"):
        field.truncate(3).save(tmp_path / name)
        kept.append(rholm.load(tmp_path / name))
    assert all(one.gravity == field.gravity for one in kept)
    assert (field + plain).gravity is None
    with pytest.raises(rholm.InvalidInputError, match="different units"):
        field + plain.with_gravity(5e12, 1738e3)
    for wrong in ((0, 1), (1, -1), (np.inf, 1), (1, np.nan)):
        with pytest.raises(rholm.InvalidInputError):
            plain.with_gravity(*wrong)
    with pytest.raises(rholm.InvalidInputError, match="'radius'"):
        rholm.from_array(values).with_gravity(1, 1)
