"""Surfaces of any genus as an atlas of caps."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import public
from ._arrays import FloatArray, IndexArray, float_rows, plain_array, read_only
from ._convert import MeshLike, as_mesh, as_shape
from ._core import (
    AtlasErrors,
    AtlasModel,
    AtlasSize,
    AtlasSynthesisOptions,
    Cap,
    CompressReport,
    SurfaceRules,
)
from ._errors import InvalidInputError
from ._options import options_of, takes
from ._run import Progress, caller, named
from ._shapes import Mesh, PointCloud, finite_points, name_of
from ._shown import Reported

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._keywords import AtlasSynthesisKeywords, CompressKeywords, PatchAtlasKeywords

NO_CAP = _core.NO_CAP
"""The number that `Atlas.dominant_caps` gives where there is no cap."""


@public
class Atlas(Reported):
    """A surface of any genus as overlapping caps, each a function on its own sphere.

    `compress`, `patch_atlas`, `load` and `reconstruct` (as ``r.atlas``) make atlases.

    Examples
    --------
    >>> a = rholm.compress(rholm.torus(2, 0.7, 40, 20), 0.2)
    >>> a.save("ring.h5")
    >>> a.mesh().inspect().genus
    1
    """

    __slots__ = ("_core", "_name", "_report", "_shape")

    _core: AtlasModel
    _report: CompressReport | None
    _shape: Mesh | None
    _name: str

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        raise TypeError("an atlas is made by compress(), reconstruct(), patch_atlas() or load()")

    @classmethod
    def _of(cls, model: AtlasModel, report: Any = None, shape: Any = None, name: str = "") -> Atlas:
        self = cls.__new__(cls)
        self._core = model
        self._report = report
        self._shape = shape
        self._name = name
        return self

    @property
    def report(self) -> CompressReport | Any:
        """Report of `compress`; None if another function made the atlas."""
        return self._report

    @property
    def errors(self) -> AtlasErrors | Any:
        """Errors measured on the extracted surface; None if unknown."""
        return self._core.errors

    @property
    def tolerance(self) -> float:
        """Wanted tolerance in the unit of the shape; 0: none."""
        return self._core.tolerance

    @property
    def size(self) -> AtlasSize:
        """Numbers of caps, coefficients and values."""
        return _core.size_of(self._core.atlas)

    @property
    def input_numbers(self) -> int:
        """Number of coordinates of the shape: 3 per vertex; 0: unknown."""
        return self._core.input_numbers

    @property
    def degree(self) -> int:
        """Highest degree of a cap."""
        return _core.highest_degree(self._core.atlas)

    @property
    def step(self) -> float:
        """Step of the grid on which its surface was measured, in the unit of the shape."""
        return self._core.step

    @property
    def diagonal(self) -> float:
        """Diagonal of the bounding box of the original points."""
        return self._core.atlas.diagonal

    @property
    def unit(self) -> str:
        """Unit of lengths; empty if unknown."""
        return self._core.unit

    @property
    def method(self) -> str:
        """Method that made the atlas; empty if unknown."""
        return self._core.method

    @property
    def rules(self) -> SurfaceRules | None:
        """Rules of `reconstruct` for the surface; None if another function made the atlas."""
        return self._core.rules

    def cap(self, i: int) -> Cap:
        """Returns one of the caps: its sphere, support and degree.

        Parameters
        ----------
        i : int
            Index of the cap, 0 ... len(atlas) - 1; negative indices count from the end.

        Examples
        --------
        >>> a = rholm.load("ring.h5")
        >>> a.cap(0) == a.cap(-len(a))
        True
        """
        return self._core.atlas.cap(_index(i, len(self)))

    def coefficients_of(self, i: int) -> FloatArray:
        """Returns the coefficients of one cap, real and orthonormal, relative to the cap's radius.
        Their order is l = 0, 1, ..., in each l the order m = 0, then C and S of m = 1 ... l. The
        even basis leaves out coefficients with l + m odd.

        Parameters
        ----------
        i : int
            Index of the cap.

        Examples
        --------
        >>> a = rholm.load("ring.h5")
        >>> cap = a.cap(0)
        >>> len(a.coefficients_of(0)) == rholm.harmonics.n_coefficients(cap.basis, cap.degree)
        True
        """
        return read_only(self._core.atlas.coefficients_of(_index(i, len(self))))

    def evaluate(self, i: int, points: npt.ArrayLike) -> tuple[FloatArray, FloatArray, npt.NDArray[np.bool_]]:
        """Evaluates the surface's potential according to one cap.

        Parameters
        ----------
        i : int
            Index of the cap.
        points : array_like, (N, 3)
            Points in space, also outside of the cap's support.

        Returns
        -------
        distance : float64, (N,)
            Signed distance to first order, positive outside.
        gradient : float64, (N, 3)
            Gradient of the distance, to first order.
        valid : bool, (N,)
            False at the centre, behind it, and where the cap's radius is not positive.

        Examples
        --------
        >>> a = rholm.load("ring.h5")
        >>> distance, gradient, valid = a.evaluate(0, [[2.7, 0, 0], [0, 2.7, 0]])
        >>> distance.shape, gradient.shape
        ((2,), (2, 3))
        """
        distance, gradient, valid = _core.evaluate_cap(
            self._core.atlas, _index(i, len(self)), float_rows(points)
        )
        return distance, gradient, valid.astype(bool)

    @takes(AtlasSynthesisOptions)
    def mesh(
        self, *, threads: int = 0, progress: Progress = None, **options: Unpack[AtlasSynthesisKeywords]
    ) -> Mesh:
        """Returns the surface: closed, oriented outwards, with normals.

        For a reconstruction it is the mesh of `reconstruct`, the same to the bit at the atlas's own
        step. It is open or simplified if that mesh is. ``simplify={"share": 1}`` keeps all
        faces.

        Parameters
        ----------
        {options}
        threads, progress
            See ``help(rholm)``.

        Examples
        --------
        >>> a = rholm.load("ring.h5")
        >>> a.mesh().inspect().closed
        True
        """
        wanted = options_of(AtlasSynthesisOptions, {**options}, "mesh")
        with caller(threads, progress) as how:
            return Mesh._of(_core.synthesize_atlas(self._core, wanted, how))

    def dominant_caps(
        self, points: npt.ArrayLike, *, threads: int = 0, progress: Progress = None
    ) -> IndexArray:
        """Returns the cap of the largest blend weight at each point, (N,); `NO_CAP` without caps.

        Parameters
        ----------
        points : array_like, (N, 3)
            Points on the surface.
        threads, progress
            See ``help(rholm)``.

        Examples
        --------
        >>> ring = rholm.torus(2, 0.7, 40, 20)
        >>> a = rholm.load("ring.h5")
        >>> a.dominant_caps(ring.vertices).shape
        (800,)
        """
        with caller(threads, progress) as how:
            return _core.dominant_caps(self._core.atlas, float_rows(points), how)

    def colored(self, mesh: Mesh | None = None, by: Literal["cap", "degree"] = "cap", **options: Any) -> Mesh:
        """Returns a mesh of the surface in the colours of its caps.

        Parameters
        ----------
        mesh : Mesh, optional
            Mesh to colour; by default the surface of the atlas.
        by : {"cap", "degree"}
            One colour per cap, or one per degree from dark blue to yellow.
        **options
            Arguments of `mesh`.

        Examples
        --------
        >>> a = rholm.load("ring.h5")
        >>> a.colored(by="degree").colors.shape[1]
        3
        """
        surface = self.mesh(**options) if mesh is None else as_mesh(mesh)
        caps = self.dominant_caps(surface.vertices)
        paint = set_cap_colors if by == "cap" else set_degree_colors
        return paint(surface, self, caps)

    def with_unit(self, unit: str) -> Atlas:
        """Returns the atlas with the same numbers and another name of the unit.

        Parameters
        ----------
        unit : str
            Name of the unit: "km", "mm", ...

        Examples
        --------
        >>> rholm.load("ring.h5").with_unit("km").unit
        'km'
        """
        _core.check_unit(unit)
        return Atlas._of(self._core.with_unit(unit), self._report, self._shape, self._name)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes a model file.

        Parameters
        ----------
        path : path
            File to write; an existing file is replaced when the new one is complete.

        Examples
        --------
        >>> a = rholm.load("ring.h5")
        >>> a.save("copy.h5")
        >>> len(rholm.load("copy.h5")) == len(a)
        True
        """
        with caller(0, False) as how:
            _core.write_atlas(self._core, named(path, (".h5", ".hdf5"), "an atlas"), how)

    def __len__(self) -> int:
        return self._core.atlas.n_caps

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Atlas):
            return NotImplemented
        mine, others = ((one.errors, one.tolerance, one.step, one.unit, one.rules) for one in (self, other))
        return (
            len(self) == len(other)
            and mine == others
            and all(
                self.cap(i) == other.cap(i)
                and bool(np.array_equal(self.coefficients_of(i), other.coefficients_of(i)))
                for i in range(len(self))
            )
        )

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"<rholm.Atlas: {len(self)} caps to degree {self.degree}, {self.size.numbers} numbers>"


@public
def as_atlas(thing: Any) -> Atlas:
    """Returns an `Atlas` unchanged, and raises TypeError for anything else.

    Parameters
    ----------
    thing : Atlas
        The atlas, or any other object.

    Examples
    --------
    >>> a = rholm.load("ring.h5")
    >>> rholm.harmonics.as_atlas(a) is a
    True
    """
    if isinstance(thing, Atlas):
        return thing
    raise TypeError(f"an Atlas is needed, not {type(thing).__name__}; compress() and load() make one")


def _index(i: int, n: int) -> int:
    """Returns an index from 0 to n - 1. Negative indices count from the end."""
    if not -n <= i < n:
        raise IndexError(f"there is no cap {i}: the atlas has {n}")
    return i % n


def _caps_of(caps: npt.ArrayLike) -> list[int]:
    array = plain_array(caps, "caps")
    if array.ndim != 1 or array.dtype.kind not in "iu":
        raise InvalidInputError(f"caps: whole numbers (N,) are needed, not {array.shape} of {array.dtype}")
    if array.size and (array.min() < 0 or array.max() > NO_CAP):
        raise InvalidInputError("caps: a number is no cap's")
    return [int(c) for c in array]


def _colored(mesh: Mesh, channels: list[FloatArray]) -> Mesh:
    red, green, blue = (c.astype(np.uint8) for c in channels)
    return mesh.with_attributes(red=red, green=green, blue=blue)


@public
def set_cap_colors(mesh: Mesh, atlas: Atlas, caps: npt.ArrayLike) -> Mesh:
    """Returns the mesh with one colour per cap. Touching caps get different hues; vertices without
    a cap are grey.

    Parameters
    ----------
    mesh : Mesh
        Mesh to colour. It is not changed.
    atlas : Atlas
        Atlas that has the caps.
    caps : array_like, (N,)
        Cap of each vertex, from `Atlas.dominant_caps`.

    Examples
    --------
    >>> ring = rholm.torus(2, 0.7, 40, 20)
    >>> a = rholm.load("ring.h5")
    >>> rholm.figures.set_cap_colors(ring, a, a.dominant_caps(ring.vertices)).colors.shape
    (800, 3)
    """
    return _colored(as_mesh(mesh), _core.set_cap_colors(as_atlas(atlas)._core.atlas, _caps_of(caps)))


@public
def set_degree_colors(mesh: Mesh, atlas: Atlas, caps: npt.ArrayLike) -> Mesh:
    """Returns the mesh coloured by the degrees of the caps: dark blue for the lowest, yellow for
    the highest.

    Parameters
    ----------
    mesh, atlas, caps
        As in `set_cap_colors`.

    Examples
    --------
    >>> ring = rholm.torus(2, 0.7, 40, 20)
    >>> a = rholm.load("ring.h5")
    >>> rholm.figures.set_degree_colors(ring, a, a.dominant_caps(ring.vertices)).colors.shape
    (800, 3)
    """
    return _colored(as_mesh(mesh), _core.set_degree_colors(as_atlas(atlas)._core.atlas, _caps_of(caps)))


@public
def dominant_caps(
    atlas: Atlas, points: npt.ArrayLike, *, threads: int = 0, progress: Progress = None
) -> IndexArray:
    """Returns the cap of the largest blend weight at each point; see `Atlas.dominant_caps`.

    Parameters
    ----------
    atlas : Atlas
        Atlas that has the caps.
    points, threads, progress
        As in `Atlas.dominant_caps`.

    Examples
    --------
    >>> ring = rholm.torus(2, 0.7, 40, 20)
    >>> a = rholm.load("ring.h5")
    >>> rholm.harmonics.dominant_caps(a, ring.vertices).shape
    (800,)
    """
    return as_atlas(atlas).dominant_caps(points, threads=threads, progress=progress)


@public
def size_of(atlas: Atlas) -> _core.AtlasSize:
    """Returns the size of an atlas: caps, coefficients and values.

    Parameters
    ----------
    atlas : Atlas
        The atlas.

    Examples
    --------
    >>> a = rholm.load("ring.h5")
    >>> rholm.harmonics.size_of(a).caps == len(a)
    True
    """
    return as_atlas(atlas).size


@public
def highest_degree(atlas: Atlas) -> int:
    """Returns the highest degree of all caps; 0 without caps.

    Parameters
    ----------
    atlas : Atlas
        The atlas.

    Examples
    --------
    >>> a = rholm.load("ring.h5")
    >>> rholm.harmonics.highest_degree(a) == a.degree
    True
    """
    return as_atlas(atlas).degree


@public
def n_coefficients(basis: Literal["full", "even"], degree: int) -> int:
    """Returns the number of coefficients of a cap.

    Parameters
    ----------
    basis : {"full", "even"}
        All harmonics up to the degree, or harmonics with l + m even.
    degree : int
        Highest degree L.

    Examples
    --------
    >>> rholm.harmonics.n_coefficients("full", 4), rholm.harmonics.n_coefficients("even", 4)
    (25, 15)
    """
    return _core.n_coefficients(basis, degree)


@public
@takes(_core.CompressOptions)
def compress(
    shape: MeshLike | PointCloud,
    tolerance: float,
    *,
    unit: Literal["absolute", "diagonal"] = "absolute",
    length_unit: str = "",
    threads: int = 0,
    progress: Progress = None,
    **options: Unpack[CompressKeywords],
) -> Atlas:
    """Computes a model of a small number of caps, smaller than its data, for any genus.

    Parameters
    ----------
    shape : mesh-like, or points with normals
        The shape, which may be open. If parts intersect, the outer surface is used. A mesh that is
        inside out or has duplicate vertices is corrected, as in `expand`.
    tolerance : float
        Root mean square distance between the surfaces, in both directions.
    unit : {"absolute", "diagonal"}
        Unit of the tolerance: the shape's own, or the diagonal of its bounding box.
    length_unit : str
        Unit of the vertices: "km", "mm", ...
    {options}
    threads, progress
        See ``help(rholm)``.

    Returns
    -------
    a : Atlas
        Atlas with ``a.errors`` and ``a.report``, which tell whether tolerance and topology are
        kept.

    Raises
    ------
    InvalidInputError
        For shapes without area, inconsistent orientation, or options out of range.
    UnsupportedError
        For shapes too thin for the grid, or caps that need more than `max_numbers`.

    Examples
    --------
    >>> ball = rholm.icosphere(2)
    >>> a = rholm.compress(ball, tolerance=0.05)
    >>> a.errors.rms < 0.05, a.size.numbers < 3 * len(ball.vertices)
    (True, True)
    """
    whole = finite_points(as_shape(shape))[0]
    factor = whole.bounds.diagonal if unit == "diagonal" else 1.0
    wanted = options_of(_core.CompressOptions, {**options}, "compress", tolerance=tolerance * factor)
    with caller(threads, progress) as how:
        model, report = _core.compress(whole._core, wanted, how)
    atlas = Atlas._of(model, report, whole if isinstance(whole, Mesh) else None, name_of(shape))
    return atlas.with_unit(length_unit) if length_unit else atlas


class PatchAtlas(NamedTuple):
    """Result of `patch_atlas`."""

    atlas: Atlas
    """The caps, blended by the paper's weights."""
    mesh: Mesh
    """The surface they make."""
    rms_along_rays: float
    """Rms distance along rays from all points of the cells to the series of their caps."""


@public
@takes(_core.PatchAtlasOptions)
def patch_atlas(
    shape: MeshLike | PointCloud,
    degree: int = 16,
    *,
    threads: int = 0,
    progress: Progress = None,
    **options: Unpack[PatchAtlasKeywords],
) -> PatchAtlas:
    """Computes the paper's atlas, for comparison; `compress` is better in every respect.

    Parameters
    ----------
    shape : mesh-like, or points with normals
        The shape.
    degree : int
        Degree of every cap, 0 ... 24.
    {options}
    threads, progress
        See ``help(rholm)``.

    Examples
    --------
    >>> made = rholm.harmonics.patch_atlas(rholm.icosphere(3), degree=4)
    >>> len(made.atlas) > 1
    True
    """
    core = finite_points(as_shape(shape))[0]._core
    wanted = options_of(_core.PatchAtlasOptions, {**options}, "patch_atlas", degree=degree)
    with caller(threads, progress) as how:
        model, surface, rms = _core.patch_atlas(core, wanted, how)
    return PatchAtlas(Atlas._of(model), Mesh._of(surface), rms)


@public
def patch_picture(
    shape: MeshLike | PointCloud,
    view: Literal["patches", "triangles", "spheres"] = "patches",
    *,
    min_cosine: float = 0.5,
    threads: int = 0,
    progress: Progress = None,
) -> Mesh:
    """Returns the paper's patches before the expansion, each in a colour of its own.

    Parameters
    ----------
    shape : mesh-like, or points with normals
        The shape.
    view : {"patches", "triangles", "spheres"}
        Delaunay triangles of each patch; smaller separate triangles; triangles on the patch's
        sphere.
    min_cosine : float
        As in `patch_atlas`.
    threads, progress
        See ``help(rholm)``.

    Examples
    --------
    >>> rholm.figures.patch_picture(rholm.icosphere(3)).colors.shape[1]
    3
    """
    core = finite_points(as_shape(shape))[0]._core
    with caller(threads, progress) as how:
        mesh, _ = _core.patch_picture(core, view, _core.PatchAtlasOptions(min_cosine=min_cosine), how)
    return Mesh._of(mesh)
