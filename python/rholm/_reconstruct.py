"""Surfaces from points."""

from __future__ import annotations

import os
from typing import Any, Literal, NamedTuple

import numpy.typing as npt

from . import _core
from ._arrays import triple
from ._atlas import Atlas
from ._run import Progress, caller
from ._shapes import Mesh, PointsLike, as_points
from ._topology import simplify_options


class Reconstruction(NamedTuple):
    """What `reconstruct` made of points."""

    mesh: Mesh
    """Closed and oriented outwards (open with holes="keep"), with normals and the points' attributes."""
    atlas: Atlas
    """The caps that the mesh was extracted from."""
    report: _core.ReconstructReport
    """What was found in the points, and what became of them."""

    def save(self, path: str | os.PathLike[str], format: str | None = None, ascii: bool = False) -> None:
        """Writes the mesh; see `write_shape`."""
        self.mesh.save(path, format, ascii)

    def _repr_png_(self) -> bytes | None:
        from ._pictures import notebook_png

        return notebook_png(self.mesh)


def reconstruct(
    points: PointsLike,
    normals: npt.ArrayLike | None = None,
    attributes: Any = None,
    *,
    holes: Literal["fill", "keep"] = "fill",
    step: float = 0.0,
    tolerance: float = 0.0,
    noise: float | None = None,
    blend: Literal["smooth", "spline"] = "smooth",
    min_component: float = 0.01,
    keep_outliers: bool = False,
    sensor: npt.ArrayLike | None = None,
    keep_scans: bool = False,
    confidence: bool = False,
    simplify: Any = None,
    max_memory: int = 8 << 30,
    threads: int = 0,
    progress: Progress = None,
) -> Reconstruction:
    """A surface from points.

    Parameters
    ----------
    points : array_like (N, 3), PointCloud, (points, normals), path, points of trimesh, PyVista, meshio
        At least 16 different ones.
    normals : array_like, (N, 3), optional
        They point outwards; of any length. Computed if there are none.
    attributes : mapping of str to array_like, optional
        Of points, (N,) or (N, k) each: carried over to the mesh.
    holes : {"fill", "keep"}
        Whether places without points are closed smoothly, or cut open.
    step : float
        Edge of the grid's cubes, in the unit of the points; 0: from their spacing and noise.
    tolerance : float
        Caps grow while their points fit to within this; 0: as exact as the points are.
    noise : float, optional
        Standard deviation of the points; estimated if not given.
    blend : {"smooth", "spline"}
        Of caps; "spline": the paper's.
    min_component : float
        Parts of the surface with less than this share of the largest one's area are dropped.
    keep_outliers : bool
        Whether points that belong to no surface stay.
    sensor : array_like, (3,), optional
        All points have been measured from here; without, attributes sensor_x, sensor_y, sensor_z
        say where each was. Computed normals point there, and holes are not closed across what
        lines of sight go through.
    keep_scans : bool
        Whether points with an attribute ``scan`` stay where they are; else the scans are brought
        together first, by `rholm.align_scans`.
    confidence : bool
        The vertices get an attribute `confidence`, 0 ... 1: less where signs of computed normals are
        unsure, far from data, and where an opposite sheet is near.
    simplify : "auto", int or dict, optional
        Fewer triangles for the same surface: to 1/50 of a step, to so many triangles, or options of
        `rholm.simplify`.
    max_memory : int
        Bytes: refused if more is foreseen.
    threads, progress
        See `rholm.caller`.

    Returns
    -------
    r : Reconstruction
        ``r.mesh``, ``r.atlas``, ``r.report``.

    Raises
    ------
    InvalidInputError
        For fewer than 16 different points, and points that no closed surface goes with.
    OutOfMemoryError
        If more than allowed would be needed, with the step that would do.
    """
    cloud = as_points(points, normals, attributes)
    options = _core.ReconstructOptions(
        step=step,
        tolerance=tolerance,
        noise=noise,
        holes=holes,
        blend=blend,
        min_component=min_component,
        remove_outliers=not keep_outliers,
        sensor=None if sensor is None else triple(sensor, "sensor"),
        align_scans=not keep_scans,
        confidence=confidence,
        simplify=simplify_options(simplify),
        max_memory=max_memory,
    )
    with caller(threads, progress) as how:
        mesh, atlas, report = _core.reconstruct(cloud._core, options, how)
    return Reconstruction(Mesh._of(mesh), Atlas._of(_core.AtlasModel(atlas, report.step, "")), report)
