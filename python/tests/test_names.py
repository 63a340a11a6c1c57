"""Contents of the package: every public function of the library, with a docstring and types."""

from __future__ import annotations

import inspect
import os
import re
import subprocess
import sys
import types
import typing
from pathlib import Path

import pytest
import rholm
from conftest import MODULES, ROOT, public_names
from rholm import _core, harmonics

FUNCTION = re.compile(
    r"^(?!using|inline|template|struct|class|enum|return|namespace|#|//)"
    r"[A-Za-z_][\w:<>,&* ]*[ &*>](\w+)\([^;{}]*(?:\{[^;{}]*\}[^;{}]*)*([;{])",
    re.MULTILINE,
)
#: Functions of the library without a Python function of the same name: what replaces them, and why.
ELSEWHERE = {
    "triangulate_polygon": "as_mesh",  # for polygons of meshio
    "outward": "expand",  # and every other function that needs it
    "truncated": "Expansion.truncate",
    "windows": "low_pass",  # its choices and its documentation
    "window_info": "low_pass",
    "descriptors": "Expansion.measure",  # one property each
    "names_of": "",  # choices of options, which annotations list
    "find_name": "",
    "check_gravity": "Expansion.with_gravity",
    "add_dropped": "reconstruct",
    "add_adjoint": "adjoint",  # returns the sums
    "batch_columns": "BatchTable.columns",
    "column_before": "BatchTable.columns",  # are in that order
    "fingerprint": "batch",  # of a journal
    "gather_batch": "batch",
    "is_batch_column": "",  # for manifests, which the program reads
    "write_batch": "BatchTable.to_hdf5",
    "discard_unfinished_files": "",  # for signal handlers of programs: Python's raise exceptions
    "expand_file": "expand",  # for a path
    "expand_mapped": "expand",  # for a path
    "find_attribute": "Mesh.attributes",
    "attribute_warnings": "map_mesh",
    "described_attributes": "map_mesh",
    "in_place": "map_mesh",
    "error_infos": "Error",
    "error_info": "Error",
    "snake_case_name": "Error.code",
    "shape_format_info": "shape_formats",
    "coefficients_format_info": "coefficients_formats",
    "held_by": "FileFormat.holds",
    "extension_of": "FileFormat.extensions",
    "shape_format_of": "shape_formats",
    "is_shape_file": "load",
    "is_model_name": "coefficients_formats",
    "check_columns": "read_shape",  # refuses columns that do not fit
    "points_of_rows": "PointCloud",  # for an array with more than three columns
    "convert_mesh": "write_shape",  # after reading; the program converts files larger than memory
    "convert_points": "write_shape",
    "has_attributes": "map_mesh",  # the arrays of a mapped file are NumPy's
    "has_triangles_only": "map_mesh",
    "release_vertices": "",  # the system does it if memory is short
    "survey_mesh": "inspect",
    "set_attribute": "Mesh.attributes",  # a dict
    "mesh_of": "Mesh",  # for arrays
    "view_of": "Mesh.vertices",  # an array over the mesh's memory
}

public = pytest.mark.skipif(not (ROOT / "include" / "rholm").exists(), reason="the headers are not here")


def functions_of_headers() -> set[str]:
    names = set()
    for header in sorted((ROOT / "include" / "rholm").glob("*.h")):
        text = re.sub(r"//.*", "", header.read_text())
        names |= {name for name, end in FUNCTION.findall(text) if end == ";"}
    return {name for name in names if name != "to_string" and not name.startswith("parse_")} | {
        name for name in names if name in ("parse_shape", "parse_coefficients")
    }


@public
def test_every_public_function_of_the_library_is_there():
    names = functions_of_headers()
    assert len(names) > 100  # the pattern finds them
    missing = []
    known = public_names()
    for name in sorted(names):
        place = ELSEWHERE.get(name, name)
        first, *parts = place.split(".")
        owner: object = known.get(first) if first else rholm
        for part in parts:
            owner = getattr(owner, part, None)
        if owner is None:
            missing.append(name)
    assert not missing


@public
def test_exceptions_of_the_list_are_functions_of_the_library():
    assert set(ELSEWHERE) <= functions_of_headers()


def public_things() -> list[tuple[str, object]]:
    things = []
    for name, thing in public_names().items():
        if isinstance(thing, types.FunctionType):
            things.append((name, thing))
        elif (
            inspect.isclass(thing)
            and thing.__module__.startswith("rholm._")
            and "_core" not in thing.__module__
        ):
            things += [
                (f"{name}.{method}", f)
                for method, f in vars(thing).items()
                if isinstance(f, types.FunctionType) and not method.startswith("_")
            ]
    return things


@pytest.mark.parametrize(("name", "function"), public_things())
def test_docstrings_name_every_parameter(name, function):
    text = inspect.getdoc(function)
    assert text, f"{name} has no docstring"
    if "see `" in text.lower() and "Parameters" not in text:
        return
    for parameter in inspect.signature(function).parameters.values():
        if parameter.name in ("self", "cls"):
            continue
        stars = {parameter.VAR_POSITIONAL: "*", parameter.VAR_KEYWORD: "**"}.get(parameter.kind, "")
        assert re.search(
            rf"^\s*(\w+, )*{re.escape(stars + parameter.name)}(, [\w*]+)* ?(:|$)", text, re.MULTILINE
        ), f"{name}: nothing is said of {parameter.name}"
    assert "Parameters" in text or len(inspect.signature(function).parameters) <= 1


def test_results_have_documented_fields():
    for name, thing in public_names().items():
        if inspect.isclass(thing) and hasattr(thing, "to_dict"):
            for field, value in vars(thing).items():
                if isinstance(value, property):
                    assert value.__doc__, f"{name}.{field}"


def test_names_are_listed_once_and_exist():
    for module in MODULES:
        assert len(set(module.__all__)) == len(module.__all__)
        assert all(hasattr(module, name) for name in module.__all__)
        assert module.__doc__


@public
def test_the_stub_is_that_of_the_module(tmp_path):
    stubgen = pytest.importorskip("nanobind.stubgen", reason="nanobind is needed to write the stub again")
    assert stubgen
    made = tmp_path / "_core.pyi"
    subprocess.run(
        [sys.executable, "-m", "nanobind.stubgen", "-q", "-m", "rholm._core", "-o", made], check=True
    )
    committed = ROOT / "python" / "rholm" / "_core.pyi"
    assert made.read_text() == committed.read_text(), "run scripts/python-stub and commit what it wrote"


@public
def test_the_types_of_tables_are_those_of_the_library(tmp_path):
    subprocess.run([sys.executable, ROOT / "scripts" / "tables-stub", tmp_path], check=True)
    for name in ("_tables.pyi", "_keywords.py"):
        committed = (ROOT / "python" / "rholm" / name).read_text()
        assert (tmp_path / name).read_text() == committed, "run scripts/python-stub and commit what it wrote"


@pytest.mark.parametrize(
    ("kind", "function"),
    [
        (_core.ReconstructOptions, rholm.reconstruct),
        (_core.RepairOptions, rholm.repair),
        (_core.CompressOptions, rholm.compress),
        (_core.PatchAtlasOptions, harmonics.patch_atlas),
        (_core.AtlasSynthesisOptions, rholm.Atlas.mesh),
        (_core.MonteCarloOptions, harmonics.monte_carlo),
        (_core.PatchOptions, rholm.smooth),
        (_core.PatchOptions, rholm.meshes.analyze_patch),
        (_core.TransferOptions, rholm.meshes.analyze_transfer),
        (_core.TransferOptions, rholm.transfer),
        (_core.TransferUpdate, rholm.transfer),
        (_core.RenderOptions, rholm.render),
        (_core.ReportOptions, rholm.report_html),
    ],
)
def test_options_are_arguments_with_their_defaults_and_documents(kind, function):
    parameters = inspect.signature(function).parameters
    for field in (field for field in kind.FIELDS if field["keyword"]):
        parameter = parameters[field["name"]]
        assert parameter.kind is parameter.KEYWORD_ONLY
        missing = field["kind"].startswith("optional ") or field["kind"] == "path"
        assert parameter.default == (None if missing else field["default"])
        words = " ".join(inspect.getdoc(function).split())
        assert field["help"][1:] in words


def test_bounds_of_options_are_in_the_documents():
    words = " ".join(inspect.getdoc(rholm.compress).split())
    assert "Within 2 ... 24." in words
    assert "Within 1000 ... 100000000, or 0." in words
    assert "Within 1e-08 ... 1." in " ".join(inspect.getdoc(harmonics.monte_carlo).split())


@public
def test_options_are_in_the_program_and_on_the_reference_page(program):
    said = subprocess.run(
        [program, "reconstruct", "--help", "all"], check=True, capture_output=True, text=True
    )
    words = " ".join(said.stdout.split())
    page = (ROOT / "docs" / "reference.md").read_text()
    # --resolution, --max-memory in GiB, -o; --work-dir and --model have their own help
    elsewhere = {"step", "max_memory", "output", "work_dir", "model"}
    for field in _core.ReconstructOptions.FIELDS:
        assert f"| `{field['name']}` |" in page
        assert field["help"] in page
        if field["name"] not in elsewhere:
            assert f"--{field['name'].replace('_', '-')}" in words
            assert field["help"] in words


def test_an_option_that_there_is_not_is_refused_by_its_name():
    with pytest.raises(TypeError, match=r"reconstruct\(\).*'tolerence'"):
        rholm.reconstruct(rholm.bumpy_sphere(3).vertices, tolerence=1)
    with pytest.raises(TypeError, match=r"transfer\(\).*'hight'"):
        rholm.transfer(rholm.bumpy_sphere(3), None, rholm.bumpy_sphere(3), None, hight=1)


def test_a_field_that_a_function_says_another_way_is_no_argument_of_it():
    with pytest.raises(TypeError, match=r"render\(\).*'width'"):
        rholm.render(rholm.icosphere(1), width=16)


def test_nothing_optional_is_imported():
    code = (
        "import rholm, sys; rholm.expand(rholm.icosphere(2), 4).mesh(2);"
        "print([m for m in sys.modules if m.split('.')[0] in"
        " ('trimesh', 'pyvista', 'vtkmodules', 'meshio', 'pyshtools', 'xarray', 'matplotlib', 'tqdm')])"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], check=True, capture_output=True, text=True, env=os.environ
    )
    assert done.stdout.strip() == "[]"


def test_what_stands_for_arguments_can_be_annotated_with():
    names = ("MeshLike", "PointsLike", "RegionLike", "CoefficientsLike", "RotationLike")

    def takes_all(a, b, c, d, e): ...

    takes_all.__annotations__ = dict(zip("abcde", names, strict=True))
    hints = typing.get_type_hints(takes_all, public_names())
    assert list(hints.values()) == [public_names()[name] for name in names]


def test_the_package_says_that_it_is_typed():
    assert (Path(rholm.__file__).parent / "py.typed").exists()
