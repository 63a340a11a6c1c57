"""Regions of meshes, and local smoothing."""

from __future__ import annotations

from typing import TYPE_CHECKING, Union

import numpy as np

from . import _core
from ._arguments import public
from ._arrays import FloatArray, IndexArray, Rows, plain_array, read_only
from ._convert import MeshLike, as_mesh
from ._errors import InvalidInputError
from ._options import options_of, takes
from ._run import Progress, caller
from ._shapes import Mesh

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._keywords import PatchKeywords

#: A region of a mesh. Texts are "ball:X,Y,Z,R", "vertex:INDEX,RADIUS", "box:X0,Y0,Z0,X1,Y1,Z1",
#: "property:NAME", "color:RRGGBB", as in the program. A list of texts is their union. Arrays are a
#: mask (N,) of bools, weights (N,) in 0 ... 1, or indices of vertices. None is the whole mesh.
RegionLike = Union[str, Rows, None]

_MASK = "rholm_region"


def _with_region(mesh: Mesh, region: RegionLike) -> tuple[Mesh, list[str]]:
    """Returns the mesh and the region as texts. A region of numbers becomes an attribute of the mesh."""
    if isinstance(region, str):
        return mesh, [region]
    if isinstance(region, (list, tuple)) and region and all(isinstance(r, str) for r in region):
        return mesh, [str(r) for r in region]
    n = len(mesh.vertices)
    values = np.ones(n, bool) if region is None else plain_array(region, "region")
    if values.dtype.kind in "iu" and values.ndim == 1 and values.size:
        if values.min() < 0 or values.max() >= n:
            raise InvalidInputError(f"region: a vertex index is not within 0 ... {n - 1}")
        mask = np.zeros(n, np.float64)
        mask[values] = 1
        values = mask
    if values.shape != (n,) or values.dtype.kind not in "bf":
        raise InvalidInputError(
            f"region: a text, a mask or weights ({n},), indices, or None for the whole mesh are needed, "
            f"not {values.shape} of {values.dtype}"
        )
    if not np.isfinite(values.astype(np.float64)).all():
        raise InvalidInputError("region: a weight is not finite")
    if not (values > 0).any():
        raise InvalidInputError("region: no vertex is in it")
    return mesh.with_attributes(**{_MASK: values.astype(np.float64)}), [f"property:{_MASK}"]


def _without_region(mesh: Mesh) -> Mesh:
    attributes = mesh.attributes
    if attributes.pop(_MASK, None) is None:
        return mesh
    return Mesh(mesh.vertices, mesh.faces, attributes)


@public
def region_weights(mesh: MeshLike, region: RegionLike, transition: float = 0.0) -> FloatArray:
    """Returns the weight of every vertex, 1 in the region and falling to 0 around it, (N,).

    Parameters
    ----------
    mesh : mesh-like
        The mesh.
    region : region-like
        The region: see `smooth`.
    transition : float
        Width of the transition around the region, in the mesh's unit.

    Examples
    --------
    >>> ball = rholm.icosphere(2)
    >>> weights = rholm.meshes.region_weights(ball, "ball:0,0,1,0.5", transition=0.2)
    >>> float(weights.min()), float(weights.max())
    (0.0, 1.0)
    """
    marked, regions = _with_region(as_mesh(mesh), region)
    return _core.region_weights(marked._core, regions, transition)


@public
class SmoothEditor:
    """A region of a mesh with adjustable detail, made by `analyze_patch`.

    Setting `strength` or `wavelength` moves the vertices of `mesh` at once, in place.

    Examples
    --------
    >>> editor = rholm.meshes.analyze_patch(rholm.bumpy_sphere(4), "ball:0,0,1,0.6", 0.5)
    >>> editor.strength = 0.5
    >>> editor.mesh
    <rholm.Mesh: 2562 vertices, 5120 faces>
    """

    __slots__ = ("_mesh", "_patch", "_strength", "_wavelength")

    def __init__(self, patch: _core.Patch, mesh: _core.Mesh) -> None:
        self._patch = patch
        self._mesh = mesh
        self._strength = 0.0
        self._wavelength = patch.wavelength

    @property
    def mesh(self) -> Mesh:
        """The mesh in its present state; its arrays follow the editor."""
        return Mesh._of(self._mesh)

    @property
    def vertices(self) -> IndexArray:
        """Indices of the vertices that may move, (n,)."""
        return read_only(self._patch.vertices)

    @property
    def weights(self) -> FloatArray:
        """Weights of these vertices in the region, (n,)."""
        return read_only(self._patch.weights)

    @property
    def unreached(self) -> int:
        """Number of vertices that no cap sees; they stay."""
        return self._patch.unreached

    @property
    def strength(self) -> float:
        """Strength of the smoothing: 0 changes nothing, 1 removes the detail, -1 doubles it."""
        return self._strength

    @strength.setter
    def strength(self, value: float) -> None:
        self._move(float(value), self._wavelength)

    @property
    def wavelength(self) -> float:
        """Finest detail that stays, in the mesh's unit, from the analysis' wavelength to
        `longest_wavelength`.
        """
        return self._wavelength

    @wavelength.setter
    def wavelength(self, value: float) -> None:
        self._move(self._strength, float(value))

    @property
    def longest_wavelength(self) -> float:
        """Wavelength of the lowest degree that is fitted."""
        return _core.longest_wavelength(self._patch)

    def positions(self, strength: float | None = None, wavelength: float | None = None) -> FloatArray:
        """Returns the positions of `vertices` for other settings, (n, 3). The mesh does not change.

        Parameters
        ----------
        strength, wavelength : float, optional
            By default the present values.

        Examples
        --------
        >>> editor = rholm.meshes.analyze_patch(rholm.bumpy_sphere(4), "ball:0,0,1,0.6", 0.5)
        >>> editor.positions(strength=1).shape == (len(editor.vertices), 3)
        True
        """
        return _core.update_patch(
            self._patch,
            self._wavelength if wavelength is None else wavelength,
            self._strength if strength is None else strength,
        )

    def __copy__(self) -> SmoothEditor:
        twin = SmoothEditor(self._patch, _core.copy_mesh(self._mesh))  # the copy moves on its own
        twin._strength, twin._wavelength = self._strength, self._wavelength
        return twin

    def _move(self, strength: float, wavelength: float) -> None:
        _core.apply_in_place(self._patch, wavelength, strength, self._mesh)
        self._strength, self._wavelength = strength, wavelength

    def __repr__(self) -> str:
        return (
            f"<rholm.meshes.SmoothEditor: {len(self.vertices)} vertices, strength {self._strength:g}, "
            f"wavelength {self._wavelength:g}>"
        )

    def _repr_png_(self) -> bytes | None:
        return self.mesh._repr_png_()


@public
@takes(_core.PatchOptions)
def analyze_patch(
    mesh: MeshLike,
    region: RegionLike,
    wavelength: float,
    *,
    threads: int = 0,
    progress: Progress = None,
    **options: Unpack[PatchKeywords],
) -> SmoothEditor:
    """Covers a region with caps and fits them: the slow part of `smooth`.

    Parameters
    ----------
    mesh, region, wavelength
        As in `smooth`.
    {options}
    threads, progress
        See ``help(rholm)``.

    Returns
    -------
    editor : SmoothEditor
        Editor with strength 0. Setting `SmoothEditor.strength` moves the mesh.

    Examples
    --------
    >>> editor = rholm.meshes.analyze_patch(rholm.bumpy_sphere(4), "ball:0,0,1,0.6", 0.5)
    >>> editor.strength
    0.0
    """
    wanted = options_of(_core.PatchOptions, {**options}, "analyze_patch", wavelength=wavelength)
    return _editor(mesh, region, wanted, threads, progress)


def _editor(
    mesh: MeshLike, region: RegionLike, wanted: _core.PatchOptions, threads: int, progress: Progress
) -> SmoothEditor:
    whole = as_mesh(mesh)
    marked, regions = _with_region(whole, region)
    with caller(threads, progress) as how:
        patch = _core.analyze_patch(marked._core, regions, wanted, how)
    return SmoothEditor(patch, _core.copy_mesh(whole._core))


@public
@takes(_core.PatchOptions)
def smooth(
    mesh: MeshLike,
    region: RegionLike,
    wavelength: float,
    *,
    strength: float = 1.0,
    threads: int = 0,
    progress: Progress = None,
    **options: Unpack[PatchKeywords],
) -> Mesh:
    """Removes detail finer than a wavelength from a region. Other vertices do not change, to the
    last bit.

    Parameters
    ----------
    mesh : mesh-like
        Mesh of any genus, closed or open. Its connectivity stays.
    region : region-like
        Text "ball:X,Y,Z,R", "vertex:INDEX,RADIUS", "box:X0,Y0,Z0,X1,Y1,Z1", "property:NAME",
        "color:RRGGBB", or a list of these texts. Arrays are a mask, weights per vertex, or vertex
        indices. None is the whole mesh.
    wavelength : float
        Finest detail to keep, in the mesh's unit.
    strength : float
        0 changes nothing, 1 removes the detail, -1 doubles it.
    {options}
    threads, progress
        See ``help(rholm)``.

    Raises
    ------
    InvalidInputError
        For a region without a vertex, for "around" if nothing is around it (the whole mesh), and
        for a wavelength too short for the mesh's edges.

    Examples
    --------
    >>> body = rholm.bumpy_sphere(4)
    >>> smoother = rholm.smooth(body, "ball:0,0,1,0.6", wavelength=0.5)
    >>> moved = (smoother.vertices != body.vertices).any(axis=1)
    >>> bool(moved.any()), bool(moved.all())
    (True, False)
    """
    wanted = options_of(_core.PatchOptions, {**options}, "smooth", wavelength=wavelength)
    editor = _editor(mesh, region, wanted, threads, progress)
    editor.strength = strength
    return editor.mesh


@public
def longest_wavelength(editor: SmoothEditor) -> float:
    """Returns the wavelength of the lowest fitted degree; see `SmoothEditor.longest_wavelength`.

    Parameters
    ----------
    editor : SmoothEditor
        Editor from `analyze_patch`.

    Examples
    --------
    >>> editor = rholm.meshes.analyze_patch(rholm.bumpy_sphere(4), "ball:0,0,1,0.6", 0.5)
    >>> rholm.meshes.longest_wavelength(editor) == editor.longest_wavelength
    True
    """
    return editor.longest_wavelength
