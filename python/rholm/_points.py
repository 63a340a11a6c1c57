"""Samples, cleans, aligns and orients points."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy.typing as npt

from . import _core
from ._arguments import public
from ._convert import MeshLike, PointsLike, as_mesh, as_points
from ._options import options_of, takes
from ._run import Progress, caller
from ._shapes import PointCloud, finite_points

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._keywords import OrientKeywords, SampleKeywords


@public
@takes(_core.SampleOptions)
def sample_surface(
    mesh: MeshLike,
    points: int = 100_000,
    *,
    threads: int = 0,
    progress: Progress = None,
    **options: Unpack[SampleKeywords],
) -> PointCloud:
    """Samples points on a surface: random points, uniform by area, or a pattern.

    Parameters
    ----------
    mesh : mesh-like
        The surface. Lengths below are fractions of the diagonal of its bounding box.
    points : int
        Number of points before holes; approximate with a pattern.
    {options}
    threads, progress
        See ``help(rholm)``.

    Returns
    -------
    cloud : PointCloud
        Points with the normals of their faces, and with the mesh's attributes. These are
        interpolated linearly in each face before noise; whole numbers are rounded. Outliers get the
        attributes of another place of the surface.

    Raises
    ------
    InvalidInputError
        For a mesh without area, options out of range, or holes that leave no point.

    Examples
    --------
    >>> cloud = rholm.sample_surface(rholm.icosphere(3), 1000, seed=1)
    >>> cloud
    <rholm.PointCloud: 1000 points with normals>
    """
    wanted = options_of(_core.SampleOptions, {**options}, "sample_surface", points=points)
    with caller(threads, progress) as how:
        return PointCloud._of(_core.sample_surface(as_mesh(mesh)._core, wanted, how))


class Cleaned(NamedTuple):
    """Result of `clean`."""

    cloud: PointCloud
    """The points that stay."""
    report: _core.CleanReport
    """Number and kinds of dropped points."""


@public
def clean(points: PointsLike) -> Cleaned:
    """Drops points that are not finite, and merges points at one place.

    Parameters
    ----------
    points : points-like
        Points, which do not change.

    Examples
    --------
    >>> cleaned = rholm.clouds.clean([[0, 0, 0], [0, 0, 0], [1, 0, 0], [np.nan, 0, 0]])
    >>> len(cleaned.cloud)
    2
    """
    with caller(0, False) as how:
        cloud, report = _core.clean(as_points(points)._core, how)
    return Cleaned(PointCloud._of(cloud), report)


class AlignedScans(NamedTuple):
    """Result of `align_scans`."""

    cloud: PointCloud
    """The points in their new places; normals and sensors have gone with them."""
    report: _core.ScanAlignment
    """How far scans were apart, and are."""


@public
def align_scans(
    points: PointsLike, scan: npt.ArrayLike | None = None, *, threads: int = 0, progress: Progress = None
) -> AlignedScans:
    """Aligns scans of one surface, each moved as a rigid body.

    The scans must overlap and be within a few spacings. The mean of all points does not move.

    Parameters
    ----------
    points : points-like
        Points, which do not change. Attributes ``sensor_x``, ``sensor_y``, ``sensor_z`` tell which
        side of a thin part a point is on.
    scan : array_like, (N,), optional
        Number of the scan of each point, whole numbers; by default the attribute ``scan``. Without
        both nothing is done.
    threads, progress
        See ``help(rholm)``.

    References
    ----------
    Y. Chen, G. Medioni, Object modelling by registration of multiple range images, 1992.
    S. Rusinkiewicz, A symmetric objective function for ICP, 2019.

    Examples
    --------
    >>> scans = rholm.sample_surface(rholm.torus(2, 0.7, 40, 20), 3000, scans=3, misalignment=1e-3)
    >>> aligned = rholm.clouds.align_scans(scans)
    >>> len(aligned.cloud) == len(scans)
    True
    """
    cloud = as_points(points)
    if scan is not None:
        cloud = as_points(cloud, attributes={**cloud.attributes, "scan": scan})
    known = finite_points(cloud)[0]
    with caller(threads, progress) as how:
        moved, report = _core.align_scans(known._core, how)
    return AlignedScans(PointCloud._of(moved), report)


class Oriented(NamedTuple):
    """Result of `orient`."""

    cloud: PointCloud
    """The points with unit normals that point out of the solid."""
    report: _core.OrientReport
    """Report: the steps that were done, and how sure the result is."""


@public
@takes(_core.OrientOptions)
def orient(
    points: PointsLike,
    normals: npt.ArrayLike | None = None,
    *,
    columns: str | Sequence[str] | None = None,
    threads: int = 0,
    progress: Progress = None,
    **options: Unpack[OrientKeywords],
) -> Oriented:
    """Computes unit normals of points that point out of the solid.

    Parameters
    ----------
    points : points-like
        The points.
    normals : array_like, (N, 3), optional
        Directions for `keep_directions`, of which only the signs are chosen.
    columns : str or sequence of str, optional
        Meaning of the columns of a text table or array, as in `read_shape`.
    {options}
    threads, progress
        See ``help(rholm)``.

    References
    ----------
    H. Hoppe et al., Surface reconstruction from unorganized points, 1992.

    Examples
    --------
    >>> cloud = rholm.sample_surface(rholm.icosphere(4), 1000)
    >>> found = rholm.orient(cloud.points).cloud.normals
    >>> bool(((found * cloud.normals).sum(axis=1) > 0).all())
    True
    """
    wanted = options_of(_core.OrientOptions, {**options}, "orient")
    given = finite_points(as_points(points, normals, columns=columns))[0]
    with caller(threads, progress) as how:
        cloud, report = _core.orient(given._core, wanted, how)
    return Oriented(PointCloud._of(cloud), report)
