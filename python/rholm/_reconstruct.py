"""Reconstructs surfaces from points."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, cast

import numpy.typing as npt

from . import _core
from ._arguments import public
from ._atlas import Atlas
from ._convert import PointsLike, as_mesh, as_points
from ._errors import InvalidInputError
from ._model_files import load
from ._options import options_of, takes
from ._run import Progress, caller, warn
from ._shape_files import shape_of_path
from ._shapes import Mesh, columns_text
from ._shown import Shown

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._keywords import ReconstructKeywords


class _Parts(NamedTuple):
    mesh: Any
    atlas: Any
    report: _core.ReconstructReport


@public
class Reconstruction(_Parts, Shown):
    """Result of `reconstruct`: ``mesh, atlas, report = r``.

    With an ``output`` the first two items are None. ``r.mesh`` and ``r.atlas`` then read the files
    each time they are asked for.

    Examples
    --------
    >>> mesh, atlas, report = rholm.reconstruct(rholm.sample_surface(rholm.icosphere(3), 1000))
    >>> mesh.inspect().closed
    True
    """

    report: _core.ReconstructReport
    """Report about the points and the surface."""
    _files: tuple[Path, Path | None] | None = None

    @property
    def mesh(self) -> Mesh:
        """Mesh with normals and the points' attributes, closed (open with holes="keep"), oriented
        outwards.
        """
        if self[0] is None and self._files is not None:
            return as_mesh(self._files[0])
        mesh: Mesh = self[0]
        return mesh

    @property
    def atlas(self) -> Atlas:
        """The caps; ``atlas.mesh()`` makes the same mesh again, without the points' attributes."""
        if self[1] is None and self._files is not None:
            if self._files[1] is None:
                raise InvalidInputError("the caps are not kept beside an output: give a model=")
            return cast(Atlas, load(self._files[1]))
        atlas: Atlas = self[1]
        return atlas

    def save(self, path: str | os.PathLike[str], format: str | None = None, ascii: bool = False) -> None:
        """Writes the mesh.

        Parameters
        ----------
        path, format, ascii
            As in `write_shape`.

        Examples
        --------
        >>> rholm.reconstruct(rholm.sample_surface(rholm.icosphere(3), 1000)).save("ball.ply")
        >>> rholm.inspect("ball.ply").closed
        True
        """
        self.mesh.save(path, format, ascii)

    def __repr__(self) -> str:
        report = f"{self.report.vertices} vertices, {self.report.faces} faces"
        return f"<rholm.clouds.Reconstruction: {report} from {self.report.points} points>"

    def _repr_png_(self) -> bytes | None:
        return None if self[0] is None else self.mesh._repr_png_()


def _warn_of_normals(report: _core.ReconstructReport) -> None:
    """Warns of an unreliable surface. The limits are kMostCrossing and others in reconstruct.h, for
    which the program ends with exit code 4.
    """
    if report.points_off_surface > 0.5:
        warn(
            f"{100 * report.points_off_surface:.3g} % of the points lie off the surface, first at "
            f"{report.places_off_surface.tolist()}: they fill a volume, or their noise hides how thick the "
            "body is",
        )
    elif report.crossing_length > 0.12:
        warn(
            f"sheets of the points cross each other, near {report.crossings.tolist()}: the surface is wrong "
            "there",
        )
    elif report.contradicting_normals > 0.5 * report.points**0.5:
        warn(
            f"the normals of {report.contradicting_normals} points contradict those around them, first "
            f"at {report.contradictions.tolist()}: the surface may be wrong",
        )
    elif report.inward_normals > 0.1:
        warn(
            f"{100 * report.inward_normals:.3g} % of the given normals point into the solid: the surface "
            "may be wrong",
        )


@public
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
    """Reconstructs a surface from points. It is the same as from ``rholm reconstruct`` with these
    options.

    Space is cut into tiles of at most `tile_points` points; fewer points are one tile. Each tile
    uses the points around it too, and the parts join to one surface without seams. The bytes of the
    surface are the same for any memory, number of threads and folder. The order of points does not
    matter either, except at points with the same place: the attributes of the first one are used.

    Parameters
    ----------
    points : array_like (N, 3), PointCloud, (points, normals), path, points of trimesh, PyVista, meshio
        At least 16 different points. A PLY of points and lines of numbers are read in portions if
        they have more points than a tile. Other files and meshes are read as a whole; of meshes the
        vertices are used. Rows that are masked or not finite are dropped, and counted in
        ``r.report.dropped_points``.
    normals : array_like, (N, 3), optional
        Outward normals of any length; missing normals are computed. Normals that contradict their
        neighbours are turned: see ``r.report.mended_normals``.
    attributes : mapping of str to array_like, optional
        Attributes of points, (N,) or (N, k) each, for the mesh.
    columns : str or sequence of str, optional
        Meaning of the columns of a text table or array, as in `read_shape`.
    foreseen : callable, optional
        Called as ``f(forecast)`` with a `TileForecast` if there are several tiles, after the points
        are counted. An exception in it ends the run.
    {options}
    threads, progress
        See ``help(rholm)``.

    Returns
    -------
    r : Reconstruction
        Result with ``r.mesh``, ``r.atlas``, ``r.report``. With an `output` the first two are read
        from the files of `output` and `model` when needed.

    Raises
    ------
    InvalidInputError
        For fewer than 16 different points, and points that fit no closed surface, lie on a curve or
        fill a volume. For a malformed file. For `resume` without an `output`, or with a folder that
        has other files or work of other input or options.
    IoError
        If a file cannot be read or written, the disk is too small, or another process works in the
        folder.
    OutOfMemoryError
        If the need is above `max_memory`; it names sufficient `tile_points` or `step`.
    UnsupportedError
        For an `output` with the name of a format other than PLY.

    Warns
    -----
    UserWarning
        If the surface is unreliable, for example where normals contradict each other.

    Examples
    --------
    >>> cloud = rholm.sample_surface(rholm.torus(2, 0.7, 40, 20), 3000)
    >>> r = rholm.reconstruct(cloud)
    >>> r.mesh.inspect().closed, r.mesh.inspect().genus
    (True, 1)
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
    """Returns a file or points in memory, and the number of points that their reader dropped."""
    if normals is None and attributes is None and isinstance(points, (str, os.PathLike)):
        return Path(points), 0
    shape, dropped = shape_of_path(points, columns)
    return as_points(shape, normals, attributes, columns)._core, dropped


@public
def foresee_tiles(points: int, tile_points: int = 1 << 20) -> _core.TileForecast:
    """Estimates the resources of `reconstruct` for a number of points, without attributes.

    Parameters
    ----------
    points : int
        Number of points.
    tile_points : int
        As in `reconstruct`.

    Returns
    -------
    forecast : TileForecast
        Numbers of ``points`` and ``tiles``, and sizes in bytes. ``memory`` is needed besides
        ``stored``, which is in memory or a folder. ``written`` is the surface's file.

    Raises
    ------
    InvalidInputError
        For `tile_points` out of range.

    Examples
    --------
    >>> rholm.clouds.foresee_tiles(1_000_000).tiles
    1
    """
    return _core.foresee_tiles(points, tile_points)
