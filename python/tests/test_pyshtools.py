"""Round trips with pyshtools: coefficients, spectrum, rotation, grids."""

from __future__ import annotations

import numpy as np
import pytest
import rholm
from rholm import harmonics

pysh = pytest.importorskip("pyshtools")

LIMIT = 1e-12  # relative to the largest coefficient or value


@pytest.fixture(scope="module")
def body() -> rholm.Expansion:
    return rholm.expand(rholm.bumpy_sphere(4, 0.3, seed=3), 20, precision=1e-12)


def test_coefficients_come_back_in_every_convention(body):
    for normalization in ("4pi", "orthonormal", "schmidt"):
        for csphase in (1, -1):
            clm = body.to_pyshtools(normalization, csphase)
            back = rholm.from_pyshtools(clm)
            assert np.abs(back.coeffs - body.coeffs).max() <= LIMIT
            again = rholm.from_array(clm.coeffs, normalization=normalization, csphase=csphase)
            assert np.abs(again.coeffs - body.coeffs).max() <= LIMIT


def test_conventions_are_those_of_pyshtools(body):
    clm = body.to_pyshtools()
    for ours, theirs in (("4pi", "4pi"), ("orthonormal", "ortho"), ("schmidt", "schmidt")):
        for csphase in (1, -1):
            expected = clm.convert(normalization=theirs, csphase=csphase).coeffs
            assert np.abs(body.to_array(ours, csphase) - expected).max() <= LIMIT


def test_complex_and_unnormalised_coefficients_are_understood(body):
    clm = body.truncate(8).to_pyshtools()
    for other in (clm.convert(kind="complex"), clm.convert(normalization="unnorm")):
        assert np.abs(rholm.from_pyshtools(other).coeffs - clm.coeffs).max() <= LIMIT


def test_spectra_agree(body):
    assert np.abs(body.spectrum() - body.to_pyshtools().spectrum()).max() <= LIMIT


def test_values_agree(body, random):
    directions = random.normal(size=(50, 3))
    unit = directions / np.linalg.norm(directions, axis=1, keepdims=True)
    lat = np.degrees(np.arcsin(unit[:, 2]))
    lon = np.degrees(np.arctan2(unit[:, 1], unit[:, 0]))
    expected = body.to_pyshtools().expand(lat=lat, lon=lon)
    assert np.abs(body(directions) - expected).max() <= LIMIT


def test_grids_agree(body):
    grid = body.to_pyshtools().expand(grid="GLQ")
    ours = harmonics.synthesize_grid(body, "gauss-legendre", *grid.data[:, :-1].shape)
    assert np.abs(ours - grid.data[:, :-1]).max() <= LIMIT
    back = harmonics.analyze_grid(grid.data[:, :-1], "gauss-legendre", body.degree)
    assert np.abs(back - body.coeffs).max() <= LIMIT
    driscoll_healy = body.to_pyshtools().expand(grid="DH2")
    assert np.abs(rholm.from_pyshtools(driscoll_healy).truncate(20).coeffs - body.coeffs).max() <= LIMIT
    assert (
        np.abs(
            harmonics.synthesize_grid(body, "equiangular-with-poles", 43, 84) - driscoll_healy.data[:, :-1]
        ).max()
        <= LIMIT
    )


@pytest.mark.parametrize("unit", ["per_l", "per_lm", "per_dlogl"])
@pytest.mark.parametrize("kind", ["power", "energy"])
def test_spectra_agree_in_every_unit(body, kind, unit):
    for base in (10.0, 2.0):
        expected = body.to_pyshtools().spectrum(convention=kind, unit=unit, base=base)
        assert np.allclose(body.spectrum(kind, unit, base), expected, rtol=1e-12, atol=0)


def test_rotations_agree(body):
    alpha, beta, gamma = 0.3, 0.7, -1.1
    # pyshtools rotates by Euler angles in the body frame: x -> R^T x of its angles.
    expected = body.to_pyshtools().rotate(alpha, beta, gamma, degrees=False, body=True)
    ours = body.rotate(harmonics.rotation_of(alpha, beta, gamma)).coeffs
    assert np.abs(ours - expected.coeffs).max() <= LIMIT


def test_arrays_are_taken_in_the_default_convention(body):
    clm = body.to_pyshtools()
    assert np.allclose(harmonics.power_spectrum(clm.coeffs), harmonics.power_spectrum(body), rtol=1e-14)
    assert np.allclose(
        harmonics.power_spectrum(clm, "power", "per_lm"), clm.spectrum(unit="per_lm"), rtol=1e-12
    )
    assert np.allclose(harmonics.evaluate(clm, [0, 0, 1]), body([0, 0, 1]), rtol=1e-13)
    assert harmonics.distance(clm, body) <= LIMIT


def test_a_gravity_field_is_read_as_one(tmp_path, random):
    values = np.stack([np.tri(6), np.tri(6)]) * random.normal(size=(2, 6, 6))
    values[1, :, 0] = 0
    values[0, 0, 0] = 1
    field = rholm.from_array(values, function="other")
    gm, r0 = 4.9028001781577922e12, 1738000.25
    path = tmp_path / "moon.gfc"
    field.save(path, gravity_constant=gm, reference_radius=r0)
    clm = pysh.SHGravCoeffs.from_file(str(path), format="icgem")
    assert clm.gm == gm
    assert clm.r0 == r0
    assert np.abs(clm.coeffs - values).max() <= LIMIT
    back = rholm.files.read_coefficients(path)
    assert back.product == "gravity_field"
    assert back.expansion.gravity == field.with_gravity(gm, r0).gravity
    assert (back.expansion.gravity.gravity_constant, back.expansion.gravity.reference_radius) == (gm, r0)
    assert back.expansion.function == "other"
    assert np.abs(back.expansion.coeffs - values).max() <= LIMIT
    clm.to_file(str(tmp_path / "theirs.gfc"), format="icgem")
    assert rholm.load(tmp_path / "theirs.gfc").gravity == back.expansion.gravity
    for wrong in (
        {"gravity_constant": gm},
        {"gravity_constant": gm, "reference_radius": 0},
        {"gravity_constant": np.nan, "reference_radius": r0},
    ):
        with pytest.raises(rholm.InvalidInputError):
            field.save(path, **wrong)
    both = {"gravity_constant": gm, "reference_radius": r0}
    for name in ("moon.json", "moon.h5", "moon.sh"):
        field.save(tmp_path / name, **both)
        assert rholm.load(tmp_path / name).gravity == back.expansion.gravity
    with pytest.raises(rholm.UnsupportedError):
        field.save(tmp_path / "moon.npy", **both)
    with pytest.raises(rholm.InvalidInputError):
        rholm.from_array(values).save(path, **both)
