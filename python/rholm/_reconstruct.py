"""Surfaces from points."""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy.typing as npt

from . import _core
from ._atlas import Atlas
from ._errors import InvalidInputError, UnsupportedError
from ._options import options_of, takes
from ._run import Progress, caller
from ._shapes import Mesh, PointsLike, as_points, columns_text, shape_of_path

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._keywords import ReconstructKeywords


class Reconstruction(NamedTuple):
    """What `reconstruct` made of points."""

    mesh: Mesh
    """Closed and oriented outwards (open with holes="keep"), with normals and the points' attributes."""
    atlas: Atlas
    """The caps; ``atlas.mesh()`` is the same mesh again, without the points' attributes."""
    report: _core.ReconstructReport
    """What was found in the points, and what became of them."""

    def save(self, path: str | os.PathLike[str], format: str | None = None, ascii: bool = False) -> None:
        """Writes the mesh; see `write_shape`."""
        self.mesh.save(path, format, ascii)

    def _repr_png_(self) -> bytes | None:
        from ._pictures import notebook_png

        return notebook_png(self.mesh)


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
    threads: int = 0,
    progress: Progress = None,
    **options: Unpack[ReconstructKeywords],
) -> Reconstruction:
    """A surface from points.

    Parameters
    ----------
    points : array_like (N, 3), PointCloud, (points, normals), path, points of trimesh, PyVista, meshio
        At least 16 different ones. Rows that are masked or not finite are dropped, and counted in
        ``r.report.dropped_points``.
    normals : array_like, (N, 3), optional
        They point outwards; of any length. Computed if there are none. Those that contradict their
        neighbours are turned, as ``r.report.mended_normals`` says.
    attributes : mapping of str to array_like, optional
        Of points, (N,) or (N, k) each: carried over to the mesh.
    columns : str or sequence of str, optional
        What the columns of a text table or of an array are, as in `read_shape`.
    {options}
    threads, progress
        See `rholm.caller`.

    Returns
    -------
    r : Reconstruction
        ``r.mesh``, ``r.atlas``, ``r.report``.

    Raises
    ------
    InvalidInputError
        For fewer than 16 different points, points that no closed surface goes with, and points that
        lie on a curve or fill a volume.
    OutOfMemoryError
        If more than allowed would be needed, with the step that would do.

    Warns
    -----
    UserWarning
        Where normals contradict each other, and it cannot be decided which of them are right.
    """
    shape, dropped = shape_of_path(points, columns)
    cloud = as_points(shape, normals, attributes, columns)
    wanted = options_of(_core.ReconstructOptions, {**options}, "reconstruct")
    with caller(threads, progress) as how:
        mesh, model, report = _core.reconstruct(cloud._core, dropped, wanted, how)
    _warn_of_normals(report)
    return Reconstruction(Mesh._of(mesh), Atlas._of(model), report)


@takes(_core.ReconstructOptions)
def reconstruct_bricks(
    points: PointsLike,
    mesh_path: str | os.PathLike[str],
    *,
    normals: npt.ArrayLike | None = None,
    attributes: Any = None,
    columns: str | Sequence[str] | None = None,
    points_per_brick: int = _core.BRICK_POINTS,
    work_dir: str | os.PathLike[str] | None = None,
    resume: bool = False,
    model: str | os.PathLike[str] | None = None,
    foreseen: Callable[[_core.BrickForecast], Any] | None = None,
    threads: int = 0,
    progress: Progress = None,
    **options: Unpack[ReconstructKeywords],
) -> _core.BrickReconstruction:
    """A surface from more points than fit into memory, brick by brick, to a file.

    Space is cut into bricks, each is worked on with the points around it, and the parts are one
    surface, without seams: the same bytes for any number of threads, any memory and any order of the
    points, but for attributes of points at one place, of which the first counts.

    Parameters
    ----------
    points : path, or what `reconstruct` takes
        At least 16 different ones. A binary or text PLY of points and lines of numbers are read a
        piece at a time; other files, and meshes, of which the vertices are taken, as a whole.
    mesh_path : path
        The surface: a binary PLY, which appears when it is complete.
    normals : array_like, (N, 3), optional
        In the place of the points' own; they point outwards.
    attributes : mapping of str to array_like, optional
        In the place of the points' own, (N,) or (N, k) each: carried over to the vertices.
    columns : str or sequence of str, optional
        What the columns of a text table or of an array are, as in `read_shape`.
    points_per_brick : int
        At most, 1000 ... 2**28; fewer take less memory, more less time. By default 2**20: some
        1.8 GB on two threads.
    work_dir : path, optional
        A folder for what is known between the steps, some 500 bytes a point: one that is not there, or
        is empty, or is that of an earlier run. It is gone at the end. None: in memory.
    resume : bool
        Leave the folder where it is if the run ends early, and take up what is there. The input and
        the options that change the surface must be those of the earlier run.
    model : path, optional
        A model file of all caps is written as well, as `write_atlas` does; they must fit into memory.
    foreseen : callable, optional
        Called as ``f(forecast)`` with a `BrickForecast` before the work, once the points have been
        counted; what it raises ends the run.
    {options}
    threads, progress
        See `rholm.caller`.

    Returns
    -------
    r : BrickReconstruction
        ``r.report`` as of `reconstruct`, ``r.bounds``, numbers of ``r.bricks``, ``r.vertices``,
        ``r.triangles`` and ``r.coefficients``, ``r.stored`` bytes, ``r.warnings`` of the file.

    Raises
    ------
    InvalidInputError
        As by `reconstruct`; for a malformed file; for a folder that has other files, or what a run
        with another input or other options has left; for `resume` without a folder.
    IoError
        If a file cannot be read or written, a disk has not the room that is foreseen, or another
        process works in the folder.
    OutOfMemoryError
        If `max_memory` is too little for a brick.
    UnsupportedError
        For several scans without `keep_scans`, and a `mesh_path` that is named as another format.
    """
    if Path(mesh_path).suffix.lower() not in ("", ".ply"):
        raise UnsupportedError(f"{os.fspath(mesh_path)}: the surface is a binary PLY: NAME.ply")
    if resume and work_dir is None:
        raise InvalidInputError("what is in memory cannot be resumed: give a work_dir")
    if foreseen is not None and not callable(foreseen):
        raise TypeError(f"foreseen is a callable or None, not {foreseen!r}")
    wanted = options_of(_core.ReconstructOptions, {**options}, "reconstruct_bricks")
    bricks = _core.BrickOptions(
        points_per_brick=points_per_brick,
        work_dir=None if work_dir is None else Path(work_dir),
        resume=resume,
        model=None if model is None else Path(model),
        columns=columns_text(columns),
    )
    source, dropped = _brick_points(points, normals, attributes, columns)
    with caller(threads, progress) as how:
        return _core.reconstruct_bricks(source, dropped, Path(mesh_path), wanted, bricks, foreseen, how)


def foresee_bricks(points: int, points_per_brick: int = _core.BRICK_POINTS) -> _core.BrickForecast:
    """What `reconstruct_bricks` will take, about; attributes of the points are not counted.

    Parameters
    ----------
    points : int
        How many there are.
    points_per_brick : int
        At most, 1000 ... 2**28.

    Returns
    -------
    forecast : BrickForecast
        Numbers of ``points`` and ``bricks``; bytes of ``memory``, ``stored`` beside it or in a
        folder, and ``written`` to the surface's file.

    Raises
    ------
    InvalidInputError
        For bricks of another size.
    """
    return _core.foresee_bricks(points, points_per_brick)


def _brick_points(
    points: PointsLike, normals: Any, attributes: Any, columns: Any
) -> tuple[_core.PointCloud | Path, int]:
    """A file that is read a piece at a time, or points in memory, and how many their reader dropped."""
    own = normals is None and attributes is None
    if own and isinstance(points, (str, os.PathLike)) and _core.is_streamed(Path(points)):
        return Path(points), 0
    shape, dropped = shape_of_path(points, columns)
    return as_points(shape, normals, attributes, columns)._core, dropped
