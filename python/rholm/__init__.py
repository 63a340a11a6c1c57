"""rholm: spherical harmonics of 3D objects.

Computes coefficients from files or arrays, and surfaces from coefficients. Smooths, textures and
reconstructs objects. Errors are measured and reported:

    import rholm
    s = rholm.expand("bennu.ply", degree=64)
    s.coeffs, s.errors, s.volume
    s.mesh(subdivisions=6).save("bennu-64.ply")

The names here are for daily work. Their modules have them too, and all others:

    rholm.harmonics    expansions, atlases, filters, sums, grids, rotations
    rholm.meshes       meshes, repair, comparison, smoothing, transfer of detail
    rholm.clouds       points, normals, reconstruction
    rholm.files        files and tables
    rholm.figures      pictures, reports, notebooks

Arrays of coefficients are in pyshtools' layout and default convention (4 pi-normalised, without
Condon-Shortley phase) unless said otherwise. Lengths are in the unit of the shape; angles are in
radians.

Functions that compute take `threads`: a number, or 0 for one thread per processor. Results are the
same bits for any number. They also take `progress`: a callable f(stage, fraction), called at most
about 50 times a second, which stops the computation by returning False (`CancelledError`). True
shows a bar, False shows none. None, the default, shows a bar on a terminal and in notebooks. These
functions release the interpreter's lock, and Ctrl-C stops them.
"""

from __future__ import annotations

import importlib

TYPE_CHECKING = False  # as type checkers know it; importing typing would take longer than all else here
if TYPE_CHECKING:
    from . import clouds as clouds
    from . import figures as figures
    from . import files as files
    from . import harmonics as harmonics
    from . import meshes as meshes
    from ._errors import (
        CancelledError,
        Error,
        InvalidInputError,
        IoError,
        NotConvergedError,
        NotStarShapedError,
        OutOfMemoryError,
        UnsupportedError,
    )
    from .clouds import PointCloud, orient, reconstruct, sample_surface
    from .figures import Panel, render, report_html, studio, view
    from .files import batch, load, read_batch, read_shape
    from .harmonics import (
        Atlas,
        Expansion,
        align,
        band_pass,
        compress,
        expand,
        from_array,
        from_pyshtools,
        high_pass,
        low_pass,
        placed,
        rotation_about,
    )
    from .meshes import (
        Mesh,
        box,
        bumpy_sphere,
        compare,
        ellipsoid,
        icosphere,
        inspect,
        repair,
        simplify,
        smooth,
        torus,
        transfer,
    )

    __version__: str

__all__ = [
    "Atlas",
    "CancelledError",
    "Error",
    "Expansion",
    "InvalidInputError",
    "IoError",
    "Mesh",
    "NotConvergedError",
    "NotStarShapedError",
    "OutOfMemoryError",
    "Panel",
    "PointCloud",
    "UnsupportedError",
    "align",
    "band_pass",
    "batch",
    "box",
    "bumpy_sphere",
    "compare",
    "compress",
    "ellipsoid",
    "expand",
    "from_array",
    "from_pyshtools",
    "high_pass",
    "icosphere",
    "inspect",
    "load",
    "low_pass",
    "orient",
    "placed",
    "read_batch",
    "read_shape",
    "reconstruct",
    "render",
    "repair",
    "report_html",
    "rotation_about",
    "sample_surface",
    "simplify",
    "smooth",
    "studio",
    "torus",
    "transfer",
    "view",
]

#: Public names by the module that has them. A module is loaded when one of its names is used first.
_MODULES = {
    "_errors": (
        "CancelledError Error InvalidInputError IoError NotConvergedError NotStarShapedError "
        "OutOfMemoryError UnsupportedError"
    ),
    "clouds": "PointCloud orient reconstruct sample_surface",
    "figures": "Panel render report_html studio view",
    "files": "batch load read_batch read_shape",
    "harmonics": (
        "Atlas Expansion align band_pass compress expand from_array from_pyshtools high_pass "
        "low_pass placed rotation_about"
    ),
    "meshes": (
        "Mesh box bumpy_sphere compare ellipsoid icosphere inspect repair simplify smooth torus transfer"
    ),
}
_HOMES = {name: module for module, names in _MODULES.items() for name in names.split()}


def __dir__() -> list[str]:
    return [*__all__, *(module for module in _MODULES if not module.startswith("_")), "__version__"]


if not TYPE_CHECKING:  # otherwise type checkers would accept every name

    def __getattr__(name: str) -> object:
        if name in _HOMES:
            thing = getattr(importlib.import_module(f".{_HOMES[name]}", __name__), name)
        elif name in _MODULES:
            return importlib.import_module(f".{name}", __name__)
        elif name == "__version__":
            thing = importlib.import_module("._core", __name__).VERSION
        elif name.startswith("_"):
            raise AttributeError(f"module 'rholm' has no attribute {name!r}")
        else:
            return importlib.import_module("._old_names", __name__).old_thing(name)
        globals()[name] = thing
        return thing
