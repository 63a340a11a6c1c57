"""Transfer of detail from one surface to another, and functions of both kinds of editors."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy.typing as npt

from . import _core
from ._arguments import public
from ._arrays import FloatArray, IndexArray, float_rows, read_only
from ._convert import MeshLike, as_mesh
from ._edit import RegionLike, SmoothEditor, _with_region, _without_region
from ._options import given_of, options_of, takes
from ._run import Progress, caller
from ._shapes import Mesh

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._keywords import TransferKeywords, TransferUpdateKeywords

    class _Keywords(TransferKeywords, TransferUpdateKeywords, total=False):
        pass


@public
class TransferEditor:
    """Detail of one surface on another, with adjustable height and angle, made by
    `analyze_transfer`.

    Setting a property moves the vertices of `mesh` at once, in place.

    Examples
    --------
    >>> body = rholm.bumpy_sphere(4)
    >>> editor = rholm.meshes.analyze_transfer(body, "ball:0,0,1,0.6", body, "ball:0,0,-1,0.6")
    >>> editor.height = 1.5
    >>> editor.mesh
    <rholm.Mesh: 2562 vertices, 5120 faces>
    """

    __slots__ = ("_analysis", "_mesh", "_patch", "_wanted")

    def __init__(self, analysis: _core.TransferAnalysis) -> None:
        self._analysis = analysis
        self._patch = analysis.patch
        self._mesh = _core.copy_mesh(analysis.mesh)
        sliders = _core.TransferUpdate.FIELDS
        self._wanted: dict[str, Any] = {field["name"]: field["default"] for field in sliders}
        self._wanted["height"] = 0.0

    @property
    def mesh(self) -> Mesh:
        """The target in its present state; its arrays follow the editor."""
        return Mesh._of(self._mesh)

    @property
    def report(self) -> _core.TransferReport:
        """Findings of the analysis."""
        return self._analysis.report

    @property
    def vertices(self) -> IndexArray:
        """Indices of the vertices that may move, (n,)."""
        return read_only(self._patch.vertices)

    @property
    def height(self) -> float:
        """Factor of the texture's heights, in addition to the scale; 0 until it is set."""
        height: float = self._wanted["height"]
        return height

    @height.setter
    def height(self, value: float) -> None:
        self.set(height=float(value))

    @property
    def angle(self) -> float | None:
        """Rotation of the texture in radians; None: the angle of the analysis."""
        angle: float | None = self._wanted["angle"]
        return angle

    @angle.setter
    def angle(self, value: float | None) -> None:
        self.set(angle=None if value is None else float(value))

    def set(self, **wanted: Any) -> None:
        """Sets several properties at once.

        Parameters
        ----------
        **wanted
            height and angle. repeat: the texture is repeated over a larger region. remove_own: the
            target's own detail is removed first. mode: "displacement" or "coefficients".

        Examples
        --------
        >>> body = rholm.bumpy_sphere(4)
        >>> editor = rholm.meshes.analyze_transfer(body, "ball:0,0,1,0.6", body, "ball:0,0,-1,0.6")
        >>> editor.set(height=1, angle=0.5)
        >>> editor.angle
        0.5
        """
        new = self._merged(wanted)
        if new["height"] == 0 and not new["remove_own"]:
            _core.apply_in_place(self._patch, self._patch.wavelength, 0.0, self._mesh)
        else:
            with caller(0, False) as how:
                _core.apply_transfer_in_place(self._analysis, _core.TransferUpdate(**new), self._mesh, how)
        self._wanted = new

    def positions(self, **wanted: Any) -> FloatArray:
        """Returns the positions of `vertices` for other settings, (n, 3). The mesh does not change.

        Parameters
        ----------
        **wanted
            Settings as in `set`; by default the present values.

        Examples
        --------
        >>> body = rholm.bumpy_sphere(4)
        >>> editor = rholm.meshes.analyze_transfer(body, "ball:0,0,1,0.6", body, "ball:0,0,-1,0.6")
        >>> editor.positions(height=1).shape == (len(editor.vertices), 3)
        True
        """
        update = _core.TransferUpdate(**self._merged(wanted))
        with caller(0, False) as how:
            return _core.update_transfer(self._analysis, update, how)

    def __copy__(self) -> TransferEditor:
        twin = TransferEditor(self._analysis)
        twin._mesh = _core.copy_mesh(self._mesh)
        twin._wanted = dict(self._wanted)
        return twin

    def __deepcopy__(self, memo: dict[int, Any]) -> TransferEditor:
        return self.__copy__()

    def __reduce__(self) -> Any:
        raise TypeError("a TransferEditor cannot be pickled, as what it knows is too large: pickle its mesh")

    def __repr__(self) -> str:
        set_to = ", ".join(f"{name} {value}" for name, value in self._wanted.items())
        return f"<rholm.meshes.TransferEditor: {len(self.vertices)} vertices, {set_to}>"

    def _merged(self, wanted: dict[str, Any]) -> dict[str, Any]:
        unknown = set(wanted) - set(self._wanted)
        if unknown:
            raise TypeError(
                f"no slider is called {', '.join(sorted(unknown))}; there are {', '.join(self._wanted)}"
            )
        return {**self._wanted, **wanted}

    def _repr_png_(self) -> bytes | None:
        return self.mesh._repr_png_()


@public
class TransferSource:
    """A texture extracted from its source, for any number of targets, made by `analyze_source`.

    Examples
    --------
    >>> texture = rholm.meshes.analyze_source(rholm.bumpy_sphere(4), "ball:0,0,1,0.6")
    >>> texture.from_degree
    8
    """

    __slots__ = ("_source",)

    def __init__(self, source: _core.TransferSource) -> None:
        self._source = source

    def __copy__(self) -> TransferSource:
        return TransferSource(self._source)  # nothing in it can be changed

    def __deepcopy__(self, memo: dict[int, Any]) -> TransferSource:
        return self.__copy__()

    def __reduce__(self) -> Any:
        raise TypeError("a TransferSource cannot be pickled, as what it knows is too large: pickle the mesh")

    def __repr__(self) -> str:
        return (
            f"<rholm.meshes.TransferSource: radius {self.radius:.6g}, wavelength {self.wavelength:.6g}, "
            f"rms {self.rms:.6g}>"
        )

    @property
    def from_degree(self) -> int:
        """The texture is the part of the source that harmonics up to this degree leave."""
        return self._source.from_degree

    @property
    def radius(self) -> float:
        """Radius of a disc with the area of the region."""
        return self._source.radius

    @property
    def wavelength(self) -> float:
        """Wavelength of the source's base."""
        return self._source.wavelength

    @property
    def edge(self) -> float:
        """Median length of an edge of the source region."""
        return self._source.edge

    @property
    def rms(self) -> float:
        """Root mean square height of the texture in its region."""
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
        """Analyzes the target region: the target's half of `analyze_transfer`.

        Parameters
        ----------
        target, target_region, scale, refine, transition, find_angle
            As in `analyze_transfer`.
        threads, progress
            See ``help(rholm)``.

        Returns
        -------
        editor : TransferEditor
            Editor with height 0. Setting `TransferEditor.height` moves the target.

        Examples
        --------
        >>> body = rholm.bumpy_sphere(4)
        >>> texture = rholm.meshes.analyze_source(body, "ball:0,0,1,0.6")
        >>> texture.onto(body, "ball:0,0,-1,0.6", find_angle=False).height
        0.0
        """
        wanted = _core.TransferOptions(
            from_degree=self.from_degree,
            scale=scale,
            refine=refine,
            transition=transition,
            find_angle=find_angle,
        )
        return self._onto(target, target_region, wanted, threads, progress)

    def _onto(
        self,
        target: MeshLike,
        target_region: RegionLike,
        wanted: _core.TransferOptions,
        threads: int,
        progress: Progress,
    ) -> TransferEditor:
        laid, to = _with_region(as_mesh(target), target_region)
        with caller(threads, progress) as how:
            return TransferEditor(_core.analyze_transfer(self._source, laid._core, to, wanted, how))


@public
def analyze_source(
    source: MeshLike,
    source_region: RegionLike,
    *,
    from_degree: int = 8,
    threads: int = 0,
    progress: Progress = None,
) -> TransferSource:
    """Extracts the detail of a region for any number of targets: the source's half of
    `analyze_transfer`.

    Parameters
    ----------
    source, source_region, from_degree
        As in `transfer`.
    threads, progress
        See ``help(rholm)``.

    Returns
    -------
    texture : TransferSource
        Texture for `TransferSource.onto`.

    Examples
    --------
    >>> rholm.meshes.analyze_source(rholm.bumpy_sphere(4), "ball:0,0,1,0.6").rms > 0
    True
    """
    taken, from_ = _with_region(as_mesh(source), source_region)
    with caller(threads, progress) as how:
        return TransferSource(_core.analyze_source(taken._core, from_, from_degree, how))


def _analyzed(
    source: MeshLike,
    source_region: RegionLike,
    target: MeshLike,
    target_region: RegionLike,
    wanted: _core.TransferOptions,
    threads: int,
    progress: Progress,
) -> TransferEditor:
    texture = analyze_source(
        source, source_region, from_degree=wanted.from_degree, threads=threads, progress=progress
    )
    return texture._onto(target, target_region, wanted, threads, progress)


@public
@takes(_core.TransferOptions)
def analyze_transfer(
    source: MeshLike,
    source_region: RegionLike,
    target: MeshLike,
    target_region: RegionLike,
    *,
    find_angle: bool = True,
    threads: int = 0,
    progress: Progress = None,
    **options: Unpack[TransferKeywords],
) -> TransferEditor:
    """Extracts the detail of one region and analyzes another: the slow part of `transfer`.

    Parameters
    ----------
    source, source_region, target, target_region
        As in `transfer`.
    find_angle : bool
        True: the angle at which the detail resembles the target's own most is searched for, which
        is half of the work. False: this angle is 0.
    {options}
    threads, progress
        See ``help(rholm)``.

    Returns
    -------
    editor : TransferEditor
        Editor with height 0. Setting `TransferEditor.height` moves the target.

    Examples
    --------
    >>> body = rholm.bumpy_sphere(4)
    >>> rholm.meshes.analyze_transfer(
    ...     body, "ball:0,0,1,0.6", body, "ball:0,0,-1,0.6", find_angle=False
    ... ).height
    0.0
    """
    wanted = options_of(_core.TransferOptions, {**options}, "analyze_transfer", find_angle=find_angle)
    return _analyzed(source, source_region, target, target_region, wanted, threads, progress)


@public
@takes(_core.TransferUpdate, _core.TransferOptions)
def transfer(
    source: MeshLike,
    source_region: RegionLike,
    target: MeshLike,
    target_region: RegionLike,
    *,
    threads: int = 0,
    progress: Progress = None,
    **options: Unpack[_Keywords],
) -> Mesh:
    """Copies the detail of a region of one surface to a region of another.

    Parameters
    ----------
    source, target : mesh-like
        Mesh that the detail is copied from, and mesh that it is copied to.
    source_region, target_region : region-like
        Regions as in `smooth`.
    {options}
    threads, progress
        See ``help(rholm)``.

    Examples
    --------
    >>> source, target = rholm.bumpy_sphere(4, seed=2), rholm.icosphere(4)
    >>> textured = rholm.transfer(source, "ball:0,0,1,0.6", target, "ball:0,0,1,0.6", angle=0)
    >>> bool((textured.vertices != target.vertices).any())
    True
    """
    kept, moved = given_of(
        _core.TransferOptions, _core.TransferUpdate, given={**options}, function="transfer"
    )
    wanted = options_of(_core.TransferOptions, kept, "transfer", find_angle=moved.get("angle") is None)
    editor = _analyzed(source, source_region, target, target_region, wanted, threads, progress)
    editor.set(**{"height": 1.0, **moved})
    return _without_region(editor.mesh)


@public
def update(editor: SmoothEditor | TransferEditor, **wanted: Any) -> FloatArray:
    """Returns the positions of an editor's vertices for other settings, (n, 3). Its mesh does not
    change.

    Parameters
    ----------
    editor : SmoothEditor or TransferEditor
        Editor from `analyze_patch` or `analyze_transfer`.
    **wanted
        Arguments of `SmoothEditor.positions` or `TransferEditor.positions`.

    Examples
    --------
    >>> editor = rholm.meshes.analyze_patch(rholm.bumpy_sphere(4), "ball:0,0,1,0.6", 0.5)
    >>> rholm.meshes.update(editor, strength=1).shape == (len(editor.vertices), 3)
    True
    """
    return editor.positions(**wanted)


@public
def apply(
    editor: SmoothEditor | TransferEditor, positions: npt.ArrayLike, mesh: MeshLike | None = None
) -> Mesh:
    """Returns a mesh with an editor's vertices at other positions, and with updated normals.

    Parameters
    ----------
    editor : SmoothEditor or TransferEditor
        Editor from `analyze_patch` or `analyze_transfer`.
    positions : array_like, (n, 3)
        Positions from `update`.
    mesh : mesh-like, optional
        Mesh to use; by default the editor's own, which does not change.

    Examples
    --------
    >>> editor = rholm.meshes.analyze_patch(rholm.bumpy_sphere(4), "ball:0,0,1,0.6", 0.5)
    >>> rholm.meshes.apply(editor, rholm.meshes.update(editor, strength=1))
    <rholm.Mesh: 2562 vertices, 5120 faces>
    """
    target = editor._mesh if mesh is None else as_mesh(mesh)._core
    return Mesh._of(_core.apply(editor._patch, float_rows(positions, "positions"), target))
