"""Surfaces from points."""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, cast

import numpy.typing as npt

from . import _core
from ._atlas import Atlas
from ._errors import InvalidInputError
from ._options import options_of, takes
from ._run import Progress, caller
from ._shapes import Mesh, PointsLike, as_mesh, as_points, columns_text, shape_of_path, warn

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._keywords import ReconstructKeywords


class _Parts(NamedTuple):
    mesh: Any
    atlas: Any
    report: _core.ReconstructReport


class Reconstruction(_Parts):
    """What `reconstruct` made of points: ``mesh, atlas, report = r``.

    With an ``output`` the first two of these are None; ``r.mesh`` and ``r.atlas`` read the files when they
    are first asked for.
    """

    report: _core.ReconstructReport
    """What was found in the points, and what became of them."""
    _files: tuple[Path, Path | None] | None = None

    @property
    def mesh(self) -> Mesh:
        """Closed and oriented outwards (open with holes="keep"), with normals and the points' attributes."""
        if self[0] is None and self._files is not None:
            return as_mesh(self._files[0])
        mesh: Mesh = self[0]
        return mesh

    @property
    def atlas(self) -> Atlas:
        """The caps; ``atlas.mesh()`` is the same mesh again, without the points' attributes."""
        if self[1] is None and self._files is not None:
            if self._files[1] is None:
                raise InvalidInputError("the caps are not kept beside an output: give a model=")
            from ._model_files import load

            return cast(Atlas, load(self._files[1]))
        atlas: Atlas = self[1]
        return atlas

    def save(self, path: str | os.PathLike[str], format: str | None = None, ascii: bool = False) -> None:
        """Writes the mesh; see `write_shape`."""
        self.mesh.save(path, format, ascii)

    def _repr_png_(self) -> bytes | None:
        from ._pictures import notebook_png

        return None if self[0] is None else notebook_png(self.mesh)


def _warn_of_normals(report: _core.ReconstructReport) -> None:
    """As the program ends with exit code 4: see kMostCrossing and the limits beside it in reconstruct.h."""
    if report.points_off_surface > 0.5:
        warnings.warn(
            f"{100 * report.points_off_surface:.3g} % of the points lie off the surface, first at "
            f"{report.places_off_surface.tolist()}: they fill a volume, or their noise hides how thick the "
            "body is",
            stacklevel=3,
        )
    elif report.crossing_length > 0.12:
        warnings.warn(
            f"sheets of the points cross each other, near {report.crossings.tolist()}: the surface is wrong "
            "there",
            stacklevel=3,
        )
    elif report.contradicting_normals > 0.5 * report.points**0.5:
        warnings.warn(
            f"the normals of {report.contradicting_normals} points contradict those around them, first "
            f"at {report.contradictions.tolist()}: the surface may be wrong",
            stacklevel=3,
        )
    elif report.inward_normals > 0.1:
        warnings.warn(
            f"{100 * report.inward_normals:.3g} % of the given normals point into the solid: the surface "
            "may be wrong",
            stacklevel=3,
        )


@takes(_core.ReconstructOptions)
def reconstruct(
    points: PointsLike,
    normals: npt.ArrayLike | None = None,
    attributes: Any = None,
    *,
    columns: str | Sequence[str] | None = None,
    foreseen: Callable[[_core.TileForecast], Any] | None = None,
    threads: int = 0,
    progress: Progress = None,
    **options: Unpack[ReconstructKeywords],
) -> Reconstruction:
    """A surface from points: the one that ``rholm reconstruct`` makes of the same points and options.

    Up to `tile_points` points are worked on in one piece. More are cut into tiles of space, each is worked
    on with the points around it, and the parts are one surface, without seams. Its bytes are the same
    for any memory, any number of threads and any folder, and, in several tiles, any order of the points
    (of points at one place the first one's attributes count).

    Parameters
    ----------
    points : array_like (N, 3), PointCloud, (points, normals), path, points of trimesh, PyVista, meshio
        At least 16 different ones. If they are more than a tile, a binary or text PLY of points and
        lines of numbers are read in portions; other files, and meshes, of which the vertices are
        taken, as a whole. Rows that are masked or not finite are dropped, and counted in
        ``r.report.dropped_points``.
    normals : array_like, (N, 3), optional
        They point outwards; of any length. Computed if there are none. Those that contradict their
        neighbours are turned, as ``r.report.mended_normals`` says.
    attributes : mapping of str to array_like, optional
        Of points, (N,) or (N, k) each: carried over to the mesh.
    columns : str or sequence of str, optional
        What the columns of a text table or of an array are, as in `read_shape`.
    foreseen : callable, optional
        Called as ``f(forecast)`` with a `TileForecast` before the work on several tiles, once the points
        have been counted; what it raises ends the run.
    {options}
    threads, progress
        See `rholm.caller`.

    Returns
    -------
    r : Reconstruction
        ``r.mesh``, ``r.atlas``, ``r.report``. With an `output` the first two are read from the files of
        `output` and `model` when they are asked for.

    Raises
    ------
    InvalidInputError
        For fewer than 16 different points, points that no closed surface goes with, and points that
        lie on a curve or fill a volume; for a malformed file; for `resume` without an `output`, and with a
        folder that has other files, or what a run with another input or other options has left.
    IoError
        If a file cannot be read or written, a disk has not the room that is foreseen, or another
        process works in the folder.
    OutOfMemoryError
        If more than allowed would be needed, with the `tile_points` or the step that would do.
    UnsupportedError
        For an `output` that is named as another format than PLY.

    Warns
    -----
    UserWarning
        Where normals contradict each other, and it cannot be decided which of them are right.
    """
    if foreseen is not None and not callable(foreseen):
        raise TypeError(f"foreseen is a callable or None, not {foreseen!r}")
    wanted = options_of(_core.ReconstructOptions, {**options}, "reconstruct")
    source, dropped = _source(points, normals, attributes, columns)
    with caller(threads, progress) as how:
        made = _core.reconstruct(source, dropped, columns_text(columns), wanted, foreseen, how)
    mesh, model, report = made
    if isinstance(source, Path):
        for text in report.warnings:
            warn(f"{source}: {text}")
    _warn_of_normals(report)
    if mesh is not None:
        return Reconstruction(Mesh._of(mesh), Atlas._of(model), report)
    on_disk = Reconstruction(None, None, report)
    on_disk._files = (wanted.output, wanted.model if options.get("model") is not None else None)
    return on_disk


def _source(
    points: PointsLike, normals: Any, attributes: Any, columns: Any
) -> tuple[_core.PointCloud | Path, int]:
    """A file, or points in memory, and how many of them their reader dropped."""
    if normals is None and attributes is None and isinstance(points, (str, os.PathLike)):
        return Path(points), 0
    shape, dropped = shape_of_path(points, columns)
    return as_points(shape, normals, attributes, columns)._core, dropped


def foresee_tiles(points: int, tile_points: int = 1 << 20) -> _core.TileForecast:
    """What `reconstruct` of many points will take, about; attributes of the points are not counted.

    Parameters
    ----------
    points : int
        How many there are.
    tile_points : int
        As in `reconstruct`.

    Returns
    -------
    forecast : TileForecast
        Numbers of ``points`` and ``tiles``; bytes of ``memory``, ``stored`` beside it or in a folder,
        and ``written`` to the surface's file.

    Raises
    ------
    InvalidInputError
        For tiles of another size.
    """
    return _core.foresee_tiles(points, tile_points)


class BrickForecast(NamedTuple):
    """What `foresee_bricks` returned in the version before."""

    points: int
    bricks: int
    memory: int
    stored: int
    written: int


class BrickReconstruction(NamedTuple):
    """What `reconstruct_bricks` returned in the version before."""

    report: _core.ReconstructReport
    bounds: _core.Bounds
    bricks: int
    vertices: int
    triangles: int
    coefficients: int
    stored: int
    warnings: list[str]


def _old_forecast(f: _core.TileForecast) -> BrickForecast:
    return BrickForecast(f.points, f.tiles, f.memory, f.stored, f.written)


def _foresee_bricks(points: int, points_per_brick: int = 1 << 20) -> BrickForecast:
    return _old_forecast(foresee_tiles(points, points_per_brick))


def _reconstruct_bricks(
    points: PointsLike,
    mesh_path: str | os.PathLike[str],
    *,
    points_per_brick: int = 1 << 20,
    foreseen: Callable[[BrickForecast], Any] | None = None,
    **options: Any,
) -> BrickReconstruction:
    told = None if foreseen is None else lambda forecast: foreseen(_old_forecast(forecast))
    if options.get("work_dir") is not None:
        Path(options["work_dir"]).mkdir(exist_ok=True)
    r = reconstruct(points, output=mesh_path, tile_points=points_per_brick, foreseen=told, **options).report
    return BrickReconstruction(
        r, r.bounds, r.tiles, r.vertices, r.triangles, r.coefficients, r.stored, r.warnings
    )


#: Names of the version before, and what stands for them.
_OLD_NAMES = {
    "reconstruct_bricks": ("reconstruct(output=..., tile_points=...)", _reconstruct_bricks),
    "foresee_bricks": ("foresee_tiles()", _foresee_bricks),
    "BrickForecast": ("TileForecast", BrickForecast),
    "BrickReconstruction": ("Reconstruction", BrickReconstruction),
}


def old_thing(name: str) -> object:
    """What the package had under a name in the version before.

    Parameters
    ----------
    name : str
        AttributeError for one that it had not.
    """
    if name not in _OLD_NAMES:
        raise AttributeError(f"module 'rholm' has no attribute {name!r}")
    new, thing = _OLD_NAMES[name]
    text = f"rholm.{name} is rholm.{new} now; the next version has no other name for it"
    warnings.warn(text, DeprecationWarning, stacklevel=3)
    return thing
