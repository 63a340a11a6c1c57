"""Arguments of wrong types and values: the message names the argument, its value and what it must be."""

from __future__ import annotations

import contextlib
import inspect
import re
import threading
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
import rholm
from conftest import public_names
from rholm import _arguments, _coefficients, _core, _filters, _sums, harmonics

BINDING = re.compile(r"incompatible function arguments|rholm\._core|std::|nanobind")


def test_first_calls_at_once(monkeypatch):
    at_once = threading.Barrier(4)
    checks_of = _arguments._checks_of

    def checks_of_all(function):
        at_once.wait(timeout=60)
        return checks_of(function)

    def twice(number: int) -> int:
        return 2 * number

    monkeypatch.setattr(_arguments, "_checks_of", checks_of_all)
    checked = _arguments.checked(twice)
    with ThreadPoolExecutor(4) as pool:
        assert list(pool.map(checked, range(4))) == [0, 2, 4, 6]
    assert checked(4) == 8


def public_functions():
    for name, thing in public_names().items():
        if inspect.isfunction(thing):
            yield name, thing
        elif inspect.isclass(thing) and thing.__module__ != "rholm._core":
            for method, function in vars(thing).items():
                if inspect.isfunction(function) and not method.startswith("_"):
                    yield f"{name}.{method}", function


#: A value of the wrong type, and the expected message, for each kind of argument.
WRONG = [
    (_arguments.whole, "eight", "a whole number"),
    (_arguments.number, "1e-3", "a number"),
    (_arguments.flag, "yes", "True or False"),
    (_arguments.text, 3, "a text"),
    (_arguments.path, 3, "a path"),
]


def test_every_function_names_an_argument_of_the_wrong_type():
    seen = set()
    for name, function in public_functions():
        positional, named = _arguments._checks_of(function.__wrapped__)
        for kind, wrong, wanted in WRONG:
            for argument, check in named.items():
                if check is not kind and not _is_optional(check, kind):
                    continue
                # Arguments before it are not checked: only the wrong one is given.
                places = [one for one, _ in positional]
                before = places[: places.index(argument)] if argument in places else []
                args = [_accepted(named.get(one)) for one in before]
                kwargs = {} if argument in places else {argument: wrong}
                if any(arg is NOTHING for arg in args):
                    continue  # one of them would be refused first
                with pytest.raises(TypeError) as refusal:
                    function(*args, *([wrong] if not kwargs else []), **kwargs)
                text = str(refusal.value)
                if "missing" in text:
                    continue
                assert f"{argument} is {wrong!r}" in text, (name, text)
                assert wanted in text, (name, text)
                assert not BINDING.search(text), (name, text)
                seen.add(name)
    assert len(seen) > 100  # most functions take a number, a text or a path


def _is_optional(check, kind):
    cells = (getattr(check, "__closure__", None) or ()) if "_optional" in check.__qualname__ else ()
    return any(cell.cell_contents is kind for cell in cells)


#: Stands for an argument that no value below is right for.
NOTHING = object()


def _accepted(check):
    """Returns a value that a check lets pass, or NOTHING."""
    for value in (None, object(), 1, "x"):
        with contextlib.suppress(TypeError, ValueError):
            if check is not None:
                check(value, "x")
            return value
    return NOTHING


def test_whole_numbers_of_any_type_are_taken(bumpy):
    expected = rholm.expand(bumpy, 8)
    for eight in (8.0, np.int8(8), np.uint64(8), np.float32(8), np.array(8), np.array(8.0)):
        assert rholm.expand(bumpy, eight) == expected
        assert rholm.expand(bumpy, degree=eight, threads=np.int64(1)) == expected
    assert rholm.expand(bumpy, tolerance=np.float32(0.5), norm=np.str_("rms")).degree >= 0
    assert len(expected.mesh(2.0).vertices) == 162
    for wrong in (8.5, "8", None, True, 1j, [8], np.nan, b"8"):
        with pytest.raises(TypeError, match=r"expand\(\): max_degree is .*; it must be a whole number"):
            rholm.expand(bumpy, tolerance=0.1, max_degree=wrong)


def test_numbers_out_of_range_are_named(bumpy):
    with pytest.raises(rholm.InvalidInputError, match="degree"):
        rholm.expand(bumpy, degree=10**20)
    with pytest.raises(rholm.InvalidInputError, match="seed is -1"):
        rholm.bumpy_sphere(2, seed=-1)
    with pytest.raises((rholm.InvalidInputError, TypeError), match="samples is -5"):
        rholm.compare(bumpy, bumpy, samples=-5)
    with pytest.raises((rholm.InvalidInputError, TypeError), match="max_hole is -1"):
        rholm.repair(bumpy, max_hole=-1)
    with pytest.raises((rholm.InvalidInputError, TypeError), match="faces is -3"):
        rholm.simplify(bumpy, faces=-3)


def test_choices_are_listed_and_the_nearest_is_named(bumpy):
    s = rholm.expand(bumpy, 4)
    for call, said in (
        (lambda: rholm.expand(bumpy, 4, method="egde"), r"method is 'egde'.*'edge'.*did you mean 'edge'\?"),
        (lambda: s.low_pass(2, "lanczoz"), "window is 'lanczoz'.*did you mean 'lanczos'"),
        (lambda: s.to_array("4 pi"), "normalization is '4 pi'.*did you mean '4pi'"),
        (lambda: s.mirror("w"), "axis is 'w'.*'x', 'y' or 'z'"),
        (lambda: rholm.reconstruct(bumpy.vertices, holes="close"), "holes is 'close'.*'fill' or 'keep'"),
    ):
        with pytest.raises(rholm.InvalidInputError, match=said):
            call()


def test_every_choice_is_one_of_the_library(bumpy):
    s = rholm.expand(bumpy, 4)
    for window in _filters.Window.__args__:
        assert s.low_pass(2, window).degree <= 4
    for function in _coefficients.Function.__args__:
        assert rholm.from_array(s.coeffs, function=function).function == function
    for normalization in _coefficients.Normalization.__args__:
        assert s.to_array(normalization).shape == (2, 5, 5)
    choices = {
        field["name"]: field["choices"]
        for kind in (_core.TransformOptions, _core.Tolerance)
        for field in kind.FIELDS
    }
    for method in choices["method"]:
        assert rholm.expand(bumpy, 2, method=method).degree == 2
    for unit in choices["unit"]:
        assert rholm.expand(bumpy, tolerance=0.5, unit=unit).degree >= 0
    for kind in _sums.GridKind.__args__:
        assert harmonics.synthesize_grid(s, kind).ndim == 2


def test_properties_and_classes_are_checked_too(bumpy):
    editor = rholm.meshes.analyze_patch(bumpy, None, 1.0)
    with pytest.raises(TypeError, match=r"SmoothEditor.strength is 'much'"):
        editor.strength = "much"
    with pytest.raises(TypeError, match=r"Rotation\(\): x is 'a'"):
        harmonics.Rotation(x="a")
    with pytest.raises(TypeError, match=r"editor is 5; it must be a SmoothEditor"):
        rholm.meshes.update(5)
    with pytest.raises(TypeError, match="placement is 5"):
        rholm.placed(rholm.expand(bumpy, 2), 5)
    with pytest.raises(TypeError, match=r"size is 64"):
        rholm.render(bumpy, 64)
    with pytest.raises(TypeError, match=r"size\[1\] is 'x'"):
        rholm.render(bumpy, (64, "x"))
    with pytest.raises(TypeError, match="faces is 'x'"):
        rholm.simplify(bumpy, faces="x")
    with pytest.raises(TypeError, match="share is 'x'"):
        rholm.compress(bumpy, 0.1).mesh(simplify={"share": "x"})


def test_what_passes_options_on_is_checked_behind(bumpy):
    with pytest.raises(TypeError, match="degree is '8'"):
        rholm.expand(bumpy, degree="8")
    with pytest.raises(TypeError, match="subdivisions is '2'"):
        harmonics.synthesize(rholm.expand(bumpy, 2), subdivisions="2")


def test_negative_indices_are_shown_as_they_were(bumpy):
    for triangles in (bumpy.faces - np.uint32(1), bumpy.faces.astype(int) - 1):
        with pytest.raises(rholm.InvalidInputError, match="-1") as refusal:
            rholm.expand((bumpy.vertices, triangles), 4)
        assert "4294967295" not in str(refusal.value)


def test_a_shape_is_not_taken_for_coefficients(tmp_path, bumpy):
    bumpy.save(tmp_path / "m.ply")
    (tmp_path / "m.txt").write_bytes((tmp_path / "m.ply").read_bytes())
    for name in ("m.ply", "m.txt"):
        with pytest.raises(rholm.InvalidInputError, match=r"is a file of a shape.*expand\(\)"):
            rholm.load(tmp_path / name)
    with pytest.raises(TypeError, match=r"path is .*Mesh.*; it must be a path"):
        rholm.load(bumpy)


def test_no_file_is_written_under_the_name_of_another_format(tmp_path, bumpy):
    s = rholm.expand(bumpy, 2)
    atlas = rholm.compress(bumpy, 0.1)
    for write in (
        lambda path: bumpy.render(size=(16, 16), path=path),
        lambda path: rholm.figures.write_png(path, np.zeros((4, 4, 3), np.uint8)),
        lambda path: atlas.save(path),
        lambda path: s.save(path, format="hdf5"),
        lambda path: s.report_html(path),
        lambda path: s.save(path),
    ):
        with pytest.raises(rholm.UnsupportedError, match="jpg"):
            write(tmp_path / "x.jpg")
    assert not list(tmp_path.iterdir())
    bumpy.render(size=(16, 16), path=tmp_path / "no-ending")
    bumpy.render(size=(16, 16), path=tmp_path / "X.PNG")
