"""Local smoothing, and the transfer of detail from one surface to another."""

from __future__ import annotations

from typing import Any, Literal, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import FloatArray, IndexArray, float_rows, plain_array, read_only
from ._errors import InvalidInputError
from ._run import Progress, caller
from ._shapes import Mesh, MeshLike, as_mesh

#: What stands for a region of a mesh: text as the program has it ("ball:X,Y,Z,R",
#: "vertex:INDEX,RADIUS", "box:X0,Y0,Z0,X1,Y1,Z1", "property:NAME", "color:RRGGBB"), a mask (N,) of
#: bools, weights (N,) in 0 ... 1, indices of vertices, or a list of texts: their union. None: the
#: whole mesh.
RegionLike = Union[str, list[str], tuple[str, ...], npt.ArrayLike, None]

_MASK = "rholm_region"


def _with_region(mesh: Mesh, region: RegionLike) -> tuple[Mesh, list[str]]:
    """The mesh, with an attribute for a region that is given by numbers, and the region as texts."""
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
    return Mesh(mesh.vertices, mesh.triangles, attributes)


def region_weights(mesh: MeshLike, region: RegionLike, transition: float = 0.0) -> FloatArray:
    """The weight of every vertex in a region, 1 in it, falling to 0 around it, (N,).

    Parameters
    ----------
    mesh : mesh-like
        The mesh.
    region : region-like
        Where: see `smooth`.
    transition : float
        Width of the fall, in the mesh's unit.
    """
    marked, regions = _with_region(as_mesh(mesh), region)
    return _core.region_weights(marked._core, regions, transition)


class SmoothEditor:
    """A region of a mesh whose detail is a slider: made by `analyze_patch`.

    Setting `strength` or `wavelength` moves the vertices of `mesh` at once, where they lie.
    """

    __slots__ = ("_mesh", "_patch", "_strength", "_wavelength")

    def __init__(self, patch: _core.Patch, mesh: _core.Mesh) -> None:
        self._patch = patch
        self._mesh = mesh
        self._strength = 0.0
        self._wavelength = patch.wavelength

    @property
    def mesh(self) -> Mesh:
        """The mesh as it is now; its arrays follow the editor."""
        return Mesh._of(self._mesh)

    @property
    def vertices(self) -> IndexArray:
        """Indices of those that may move, (n,)."""
        return read_only(self._patch.vertices)

    @property
    def weights(self) -> FloatArray:
        """Their weights in the region, (n,)."""
        return read_only(self._patch.weights)

    @property
    def unreached(self) -> int:
        """Vertices that no cap sees: they stay."""
        return self._patch.unreached

    @property
    def strength(self) -> float:
        """0 leaves all as it is, 1 takes the detail away, -1 doubles it."""
        return self._strength

    @strength.setter
    def strength(self, value: float) -> None:
        self._move(float(value), self._wavelength)

    @property
    def wavelength(self) -> float:
        """The finest detail that stays, in the mesh's unit: from the analysis' on to `longest_wavelength`."""
        return self._wavelength

    @wavelength.setter
    def wavelength(self, value: float) -> None:
        self._move(self._strength, float(value))

    @property
    def longest_wavelength(self) -> float:
        """That of the lowest degree that is fitted."""
        return _core.longest_wavelength(self._patch)

    def positions(self, strength: float | None = None, wavelength: float | None = None) -> FloatArray:
        """Where `vertices` would be, (n, 3); the mesh stays as it is.

        Parameters
        ----------
        strength, wavelength : float, optional
            By default as they are.
        """
        return _core.update_patch(
            self._patch,
            self._wavelength if wavelength is None else wavelength,
            self._strength if strength is None else strength,
        )

    def __copy__(self) -> SmoothEditor:
        twin = SmoothEditor(self._patch, _core.copy_mesh(self._mesh))  # which moves by itself
        twin._strength, twin._wavelength = self._strength, self._wavelength
        return twin

    def _move(self, strength: float, wavelength: float) -> None:
        _core.apply_in_place(self._patch, wavelength, strength, self._mesh)
        self._strength, self._wavelength = strength, wavelength

    def __repr__(self) -> str:
        return (
            f"<rholm.SmoothEditor: {len(self.vertices)} vertices, strength {self._strength:g}, "
            f"wavelength {self._wavelength:g}>"
        )

    def _repr_png_(self) -> bytes | None:
        return self.mesh._repr_png_()


def analyze_patch(
    mesh: MeshLike,
    region: RegionLike,
    wavelength: float,
    *,
    transition: float | None = None,
    fitting: Literal["robust", "mean", "around"] = "robust",
    repair: bool = False,
    threads: int = 0,
    progress: Progress = None,
) -> SmoothEditor:
    """Covers a region with caps and fits them: the slow part of `smooth`.

    Parameters
    ----------
    mesh, region, wavelength, transition, fitting, repair, threads, progress
        As in `smooth`.

    Returns
    -------
    editor : SmoothEditor
        Whose `SmoothEditor.strength` is 0 and moves the mesh when it is set.
    """
    whole = as_mesh(mesh)
    marked, regions = _with_region(whole, region)
    options = _core.PatchOptions(wavelength=wavelength, transition=transition, fitting=fitting, repair=repair)
    with caller(threads, progress) as how:
        patch = _core.analyze_patch(marked._core, regions, options, how)
    return SmoothEditor(patch, _core.copy_mesh(whole._core))


def smooth(
    mesh: MeshLike,
    region: RegionLike,
    wavelength: float,
    *,
    strength: float = 1.0,
    transition: float | None = None,
    fitting: Literal["robust", "mean", "around"] = "robust",
    repair: bool = False,
    threads: int = 0,
    progress: Progress = None,
) -> Mesh:
    """Takes detail finer than a wavelength from a region; the rest stays, to the last bit.

    Parameters
    ----------
    mesh : mesh-like
        Of any genus, closed or open; triangles stay as they are.
    region : region-like
        "ball:X,Y,Z,R", "vertex:INDEX,RADIUS", "box:X0,Y0,Z0,X1,Y1,Z1", "property:NAME",
        "color:RRGGBB", a list of these, or per vertex: a mask, weights, or indices; None: everywhere.
    wavelength : float
        The finest detail that may stay, in the mesh's unit.
    strength : float
        0 leaves all as it is, 1 takes the detail away, -1 doubles it.
    transition : float, optional
        Width in which the edit fades; by default the wavelength.
    fitting : {"robust", "mean", "around"}
        What the smooth surface is fitted to: all but what stands out, all points, or what lies
        around the region, which is bridged.
    repair : bool
        Moves only what stands out: scratches go, the texture around them stays.
    threads, progress
        See `rholm.caller`.

    Raises
    ------
    InvalidInputError
        For a region without a vertex, "around" where nothing is around it (the whole mesh), a
        wavelength shorter than the mesh's edges can show.
    """
    editor = analyze_patch(
        mesh,
        region,
        wavelength,
        transition=transition,
        fitting=fitting,
        repair=repair,
        threads=threads,
        progress=progress,
    )
    editor.strength = strength
    return editor.mesh


def longest_wavelength(editor: SmoothEditor) -> float:
    """See `SmoothEditor.longest_wavelength`.

    Parameters
    ----------
    editor : SmoothEditor
        Of `analyze_patch`.
    """
    return editor.longest_wavelength


def update(editor: SmoothEditor | TransferEditor, **wanted: Any) -> FloatArray:
    """Where the vertices of an editor would be, (n, 3); its mesh stays as it is.

    Parameters
    ----------
    editor : SmoothEditor or TransferEditor
        Of `analyze_patch` or `analyze_transfer`.
    **wanted
        Of its `SmoothEditor.positions` or `TransferEditor.positions`.
    """
    return editor.positions(**wanted)


def apply(
    editor: SmoothEditor | TransferEditor, positions: npt.ArrayLike, mesh: MeshLike | None = None
) -> Mesh:
    """A mesh with an editor's vertices at other positions; normals among its attributes follow.

    Parameters
    ----------
    editor : SmoothEditor or TransferEditor
        Of `analyze_patch` or `analyze_transfer`.
    positions : array_like, (n, 3)
        Of `update`.
    mesh : mesh-like, optional
        By default the editor's own, which stays as it is.
    """
    target = editor._mesh if mesh is None else as_mesh(mesh)._core
    return Mesh._of(_core.apply(editor._patch, float_rows(positions, "positions"), target))


class TransferEditor:
    """Detail of one surface on another, whose height and turn are sliders: made by `analyze_transfer`.

    Setting a property moves the vertices of `mesh` at once, where they lie.
    """

    __slots__ = ("_analysis", "_mesh", "_patch", "_wanted")

    def __init__(self, analysis: _core.TransferAnalysis) -> None:
        self._analysis = analysis
        self._patch = analysis.patch
        self._mesh = _core.copy_mesh(analysis.mesh)
        self._wanted: dict[str, Any] = {
            "height": 0.0,
            "angle": None,
            "repeat": False,
            "remove_own": False,
            "mode": "displacement",
        }

    @property
    def mesh(self) -> Mesh:
        """The target as it is now; its arrays follow the editor."""
        return Mesh._of(self._mesh)

    @property
    def report(self) -> _core.TransferReport:
        """What the analysis found."""
        return self._analysis.report

    @property
    def vertices(self) -> IndexArray:
        """Indices of those that may move, (n,)."""
        return read_only(self._patch.vertices)

    @property
    def height(self) -> float:
        """Of the texture, times what the scale makes of it; 0 until it is set."""
        height: float = self._wanted["height"]
        return height

    @height.setter
    def height(self, value: float) -> None:
        self.set(height=float(value))

    @property
    def angle(self) -> float | None:
        """Turn of the texture, radians; None: where it is most like the target's own detail."""
        angle: float | None = self._wanted["angle"]
        return angle

    @angle.setter
    def angle(self, value: float | None) -> None:
        self.set(angle=None if value is None else float(value))

    def set(self, **wanted: Any) -> None:
        """Several sliders at once.

        Parameters
        ----------
        **wanted
            height, angle; repeat: the texture is laid side by side over a larger region;
            remove_own: the target's own detail goes first; mode: "displacement" or "coefficients".
        """
        new = self._merged(wanted)
        if new["height"] == 0 and not new["remove_own"]:
            _core.apply_in_place(self._patch, self._patch.wavelength, 0.0, self._mesh)
        else:
            with caller(0, False) as how:
                _core.apply_transfer_in_place(self._analysis, *_sliders(new), self._mesh, how)
        self._wanted = new

    def positions(self, **wanted: Any) -> FloatArray:
        """Where `vertices` would be, (n, 3); the mesh stays as it is.

        Parameters
        ----------
        **wanted
            As in `set`; by default as they are.
        """
        with caller(0, False) as how:
            return _core.update_transfer(self._analysis, *_sliders(self._merged(wanted)), how)

    def __copy__(self) -> TransferEditor:
        twin = TransferEditor(self._analysis)
        twin._mesh = _core.copy_mesh(self._mesh)
        twin._wanted = dict(self._wanted)
        return twin

    def __deepcopy__(self, memo: dict[int, Any]) -> TransferEditor:
        return self.__copy__()

    def __reduce__(self) -> Any:
        raise TypeError("a TransferEditor cannot be pickled, as what it knows is too large: pickle its mesh")

    def _merged(self, wanted: dict[str, Any]) -> dict[str, Any]:
        unknown = set(wanted) - set(self._wanted)
        if unknown:
            raise TypeError(
                f"no slider is called {', '.join(sorted(unknown))}; there are {', '.join(self._wanted)}"
            )
        return {**self._wanted, **wanted}

    def _repr_png_(self) -> bytes | None:
        return self.mesh._repr_png_()


def _sliders(wanted: dict[str, Any]) -> tuple[float, float | None, bool, bool, str]:
    return wanted["height"], wanted["angle"], wanted["repeat"], wanted["remove_own"], wanted["mode"]


class TransferSource:
    """A texture taken from its source, to be laid on any number of targets: made by `analyze_source`."""

    __slots__ = ("_source",)

    def __init__(self, source: _core.TransferSource) -> None:
        self._source = source

    def __copy__(self) -> TransferSource:
        return TransferSource(self._source)  # nothing in it can be changed

    def __deepcopy__(self, memo: dict[int, Any]) -> TransferSource:
        return self.__copy__()

    def __reduce__(self) -> Any:
        raise TypeError("a TransferSource cannot be pickled, as what it knows is too large: pickle the mesh")

    @property
    def from_degree(self) -> int:
        """What harmonics up to this degree leave of the source is the texture."""
        return self._source.from_degree

    @property
    def radius(self) -> float:
        """Of a disc with the area of the region."""
        return self._source.radius

    @property
    def wavelength(self) -> float:
        """Of the source's base."""
        return self._source.wavelength

    @property
    def edge(self) -> float:
        """Median length of an edge there."""
        return self._source.edge

    @property
    def rms(self) -> float:
        """Height of the texture in its region."""
        return self._source.rms

    def onto(
        self,
        target: MeshLike,
        target_region: RegionLike,
        *,
        scale: float = 1.0,
        refine: bool = False,
        transition: float | None = None,
        find_angle: bool = True,
        threads: int = 0,
        progress: Progress = None,
    ) -> TransferEditor:
        """Looks at where it is to be laid: the target's half of `analyze_transfer`.

        Parameters
        ----------
        target, target_region, scale, refine, transition, find_angle
            As in `analyze_transfer`.
        threads, progress
            See `rholm.caller`.

        Returns
        -------
        editor : TransferEditor
            Whose `TransferEditor.height` is 0 and moves the target when it is set.
        """
        laid, to = _with_region(as_mesh(target), target_region)
        options = _core.TransferOptions(
            from_degree=self.from_degree,
            scale=scale,
            refine=refine,
            transition=transition,
            find_angle=find_angle,
        )
        with caller(threads, progress) as how:
            return TransferEditor(_core.analyze_transfer(self._source, laid._core, to, options, how))


def analyze_source(
    source: MeshLike,
    source_region: RegionLike,
    *,
    from_degree: int = 8,
    threads: int = 0,
    progress: Progress = None,
) -> TransferSource:
    """Takes the detail of a region, once for any number of targets: the source's half of `analyze_transfer`.

    Parameters
    ----------
    source, source_region, from_degree
        As in `transfer`.
    threads, progress
        See `rholm.caller`.

    Returns
    -------
    texture : TransferSource
        To be laid by `TransferSource.onto`.
    """
    taken, from_ = _with_region(as_mesh(source), source_region)
    with caller(threads, progress) as how:
        return TransferSource(_core.analyze_source(taken._core, from_, from_degree, how))


def analyze_transfer(
    source: MeshLike,
    source_region: RegionLike,
    target: MeshLike,
    target_region: RegionLike,
    *,
    from_degree: int = 8,
    scale: float = 1.0,
    refine: bool = False,
    transition: float | None = None,
    find_angle: bool = True,
    threads: int = 0,
    progress: Progress = None,
) -> TransferEditor:
    """Takes the detail of one region and looks at another: the slow part of `transfer`.

    Parameters
    ----------
    source, source_region, target, target_region, from_degree, scale, refine, transition
        As in `transfer`.
    find_angle : bool
        Whether the angle at which the detail is most like the target's own is looked for, which is
        half of the work; without it that angle is 0.
    threads, progress
        See `rholm.caller`.

    Returns
    -------
    editor : TransferEditor
        Whose `TransferEditor.height` is 0 and moves the target when it is set.
    """
    texture = analyze_source(
        source, source_region, from_degree=from_degree, threads=threads, progress=progress
    )
    return texture.onto(
        target,
        target_region,
        scale=scale,
        refine=refine,
        transition=transition,
        find_angle=find_angle,
        threads=threads,
        progress=progress,
    )


def transfer(
    source: MeshLike,
    source_region: RegionLike,
    target: MeshLike,
    target_region: RegionLike,
    *,
    height: float = 1.0,
    angle: float | None = None,
    repeat: bool = False,
    remove_own: bool = False,
    mode: Literal["displacement", "coefficients"] = "displacement",
    from_degree: int = 8,
    scale: float = 1.0,
    refine: bool = False,
    transition: float | None = None,
    threads: int = 0,
    progress: Progress = None,
) -> Mesh:
    """The detail of a region of one surface laid on a region of another.

    Parameters
    ----------
    source, target : mesh-like
        Where the detail is taken, and where it is laid.
    source_region, target_region : region-like
        As in `smooth`.
    height : float
        Of the texture.
    angle : float, optional
        Its turn, radians; by default where it is most like the target's own detail.
    repeat : bool
        Lays it side by side over a region that is larger than the texture.
    remove_own : bool
        The target's own detail of the same wavelengths goes first.
    mode : {"displacement", "coefficients"}
        Along the target's normals, or the raw coefficients, to compare with.
    from_degree : int
        What harmonics up to this degree leave of the source is the texture.
    scale : float
        Lengths on the target by lengths on the source, in units of the regions' radii.
    refine : bool
        Splits the target's edges until they are as short as the source's.
    transition : float, optional
        Width in which the texture fades.
    threads, progress
        See `rholm.caller`.
    """
    editor = analyze_transfer(
        source,
        source_region,
        target,
        target_region,
        from_degree=from_degree,
        scale=scale,
        refine=refine,
        transition=transition,
        find_angle=angle is None,
        threads=threads,
        progress=progress,
    )
    editor.set(height=height, angle=angle, repeat=repeat, remove_own=remove_own, mode=mode)
    return _without_region(editor.mesh)
