"""Pictures, reports, and the display of objects in notebooks."""

from __future__ import annotations

import base64
import html
import os
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import public
from ._arrays import float_rows, floats, plain_array
from ._atlas import Atlas
from ._convert import outward_mesh
from ._errors import Error, InvalidInputError
from ._expand import as_expansion
from ._expansion import Expansion
from ._options import options_of, takes
from ._run import Progress, caller, named
from ._shapes import Mesh, PointCloud, finite_points
from ._surfaces import surface_of
from ._view import viewer_script

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._keywords import RenderKeywords, ReportKeywords

Pixels = npt.NDArray[np.uint8]

_NOTEBOOK_SIZE = (480, 400)  # pixels; chosen: fits beside text


@public
class Picture(np.ndarray[Any, np.dtype[np.uint8]]):
    """Pixels, (height, width, 3) uint8, as a screen shows them (sRGB). It is an array that can be
    saved, and notebooks display it.

    Examples
    --------
    >>> rholm.render(rholm.icosphere(3), (64, 48)).dtype
    dtype('uint8')
    """

    def png(self) -> bytes:
        """Returns the bytes of a PNG file.

        Examples
        --------
        >>> rholm.render(rholm.icosphere(3), (64, 48)).png()[1:4]
        b'PNG'
        """
        return encode_png(self)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes a PNG file.

        Parameters
        ----------
        path : path
            File to write; an existing file is replaced when the new one is complete.

        Examples
        --------
        >>> rholm.render(rholm.icosphere(3), (64, 48)).save("ball.png")
        """
        write_png(path, self)

    def __repr__(self) -> str:
        if self.ndim != 3:
            return super().__repr__()
        return f"<rholm.figures.Picture: {self.shape[1]} x {self.shape[0]} pixels>"

    def _repr_png_(self) -> bytes | None:
        return self.png() if self.ndim == 3 and self.shape[2] == 3 else None


@public
class Panel:
    """One object in a picture.

    Parameters
    ----------
    shape : mesh-like, Expansion, Atlas, Reconstruction, PointCloud or array_like (N, 3)
        Object to show. A file may also hold points. For points of other packages use
        `rholm.clouds.as_points`.
    label : str
        Text below it.
    scalars : array_like, (N,), optional
        One value per vertex or point, shown by the colour map.
    colors : array_like, (N, 3), optional
        Colours per vertex or point, 0 ... 1. By default the shape's own colours if there are no
        scalars.
    smooth : bool, optional
        True: shades a mesh with its normals; by default if it has normals.
    point_radius : float, optional
        Radius of the ball that shows each point, in the points' unit. By default the typical
        spacing of the points, so that the balls of a surface leave no gaps.

    Raises
    ------
    InvalidInputError
        For both scalars and colors, or arrays of a wrong shape.

    Examples
    --------
    >>> ball, ring = rholm.icosphere(3), rholm.torus(2, 0.7, 40, 20)
    >>> panels = [
    ...     rholm.Panel(ball, "a ball", scalars=ball.vertices[:, 2]),
    ...     rholm.Panel(ring, "a ring"),
    ... ]
    >>> rholm.render(panels, (128, 64)).shape
    (64, 128, 3)
    """

    __slots__ = ("_arguments", "_core", "shape")

    def __init__(
        self,
        shape: Any,
        label: str = "",
        *,
        scalars: npt.ArrayLike | None = None,
        colors: npt.ArrayLike | None = None,
        smooth: bool | None = None,
        point_radius: float | None = None,
    ) -> None:
        self._arguments = {
            "label": label,
            "scalars": scalars,
            "colors": colors,
            "smooth": smooth,
            "point_radius": point_radius,
        }
        self.shape = _drawable(shape)
        if scalars is not None and colors is not None:
            raise InvalidInputError("scalars and colors exclude one another: give one of them")
        if scalars is None and colors is None:
            colors = self.shape.colors
        rows = None if colors is None else float_rows(colors, "colors")
        values = None if scalars is None else floats(scalars, "scalars")
        shape, (rows, values) = finite_points(self.shape, rows, values)
        if isinstance(shape, PointCloud):
            radius = 0.0 if point_radius is None else _positive(point_radius)
            self._core = _core.Panel(shape._core, label, radius, values, rows)
        else:
            if smooth is None:
                smooth = "nx" in shape.attributes
            self._core = _core.Panel(shape._core, label, smooth, values, rows)

    def __repr__(self) -> str:
        return f"<rholm.Panel {self._arguments['label']!r}: {self.shape!r}>"

    def __reduce__(self) -> Any:
        return (_panel_of, (self.shape, self._arguments))


def _panel_of(shape: Mesh | PointCloud, arguments: dict[str, Any]) -> Panel:
    return Panel(shape, **arguments)


def _drawable(shape: Any) -> Mesh | PointCloud:
    """Returns the surface of an object, or points."""
    drawn: Mesh | PointCloud = surface_of(shape, points=True)
    return drawn


def _positive(radius: float) -> float:
    if not radius > 0:
        raise InvalidInputError(f"point_radius is {radius}; it must be above 0, or None")
    return float(radius)


@public
@takes(_core.RenderOptions)
def render(
    shape: Any,
    size: tuple[int, int] = (1024, 768),
    *,
    scalars: npt.ArrayLike | None = None,
    colors: npt.ArrayLike | None = None,
    label: str = "",
    point_radius: float | None = None,
    scale: tuple[float | None, float | None] = (None, None),
    path: str | os.PathLike[str] | None = None,
    threads: int = 0,
    progress: Progress = None,
    **options: Unpack[RenderKeywords],
) -> Picture:
    """Makes a picture of one or several shapes side by side.

    Parameters
    ----------
    shape : mesh-like, Expansion, Atlas, Reconstruction, PointCloud, array_like (N, 3), Panel, or a list
        Object to show, or a list of several objects.
    size : (width, height)
        Size of the picture in pixels, 16 ... 16384.
    scalars : array_like, (N,), optional
        For one shape: a value per vertex or point, shown by the colour map.
    colors : array_like, (N, 3), optional
        For one shape: colours per vertex or point, 0 ... 1. By default its own if there are no
        scalars.
    label : str
        For one shape: text below it.
    point_radius : float, optional
        Radius of the balls that show points: as in `Panel`.
    scale : (lowest, highest)
        Range of the colour map; None stands for the range of all scalars.
    path : path, optional
        PNG file to write as well.
    {options}
    threads, progress
        See ``help(rholm)``.

    Returns
    -------
    picture : Picture
        Pixels, uint8, (height, width, 3).

    Raises
    ------
    InvalidInputError
        For a shape without faces or points, more than 20 million points, arrays of a wrong length,
        or sizes out of range.

    Examples
    --------
    >>> picture = rholm.render(rholm.bumpy_sphere(3), (64, 48), path="body.png")
    >>> picture.shape
    (48, 64, 3)
    """
    if path is not None:
        named(path, (".png",), "a picture")  # checked before the work
    several = isinstance(shape, list)
    of_one = scalars is not None or colors is not None or point_radius is not None or label
    if of_one and (several or isinstance(shape, Panel)):
        raise InvalidInputError(
            "scalars, colors, label and point_radius are of one shape; Panels have their own"
        )
    panels = [
        s
        if isinstance(s, Panel)
        else Panel(s, label, scalars=scalars, colors=colors, point_radius=point_radius)
        for s in (shape if several else [shape])
    ]
    wanted = options_of(
        _core.RenderOptions,
        {**options},
        "render",
        width=size[0],
        height=size[1],
        scale_min=scale[0],
        scale_max=scale[1],
    )
    with caller(threads, progress) as how:
        picture = _core.render([panel._core for panel in panels], wanted, how).view(Picture)
    if path is not None:
        write_png(path, picture)
    return picture


def _pixels(image: npt.ArrayLike) -> Pixels:
    array = plain_array(image, "image")
    if array.dtype != np.uint8 or array.ndim != 3 or array.shape[2] != 3:
        raise InvalidInputError(
            f"image: an array (height, width, 3) of uint8 is needed, not {array.shape} of {array.dtype}"
        )
    return np.ascontiguousarray(array)


@public
def encode_png(image: npt.ArrayLike) -> bytes:
    """Returns the bytes of a PNG file.

    Parameters
    ----------
    image : array_like of uint8, (height, width, 3)
        Pixels, rows from the top.

    Examples
    --------
    >>> rholm.figures.encode_png(np.zeros((4, 4, 3), np.uint8))[1:4]
    b'PNG'
    """
    return _core.encode_png(_pixels(image))


@public
def write_png(path: str | os.PathLike[str], image: npt.ArrayLike) -> None:
    """Writes a PNG file to a temporary file that replaces `path` when complete.

    Parameters
    ----------
    path : path
        File to write.
    image : array_like of uint8, (height, width, 3)
        Pixels, rows from the top.

    Examples
    --------
    >>> rholm.figures.write_png("black.png", np.zeros((4, 4, 3), np.uint8))
    """
    _core.write_png(named(path, (".png",), "a picture"), _pixels(image))


@public
def spectrum_svg(expansion: Expansion, title: str = "", tolerance: float | None = None) -> str:
    """Returns the energy per degree on logarithmic scales as an SVG document.

    Parameters
    ----------
    expansion : Expansion
        Expansion that has the spectrum.
    title : str
        Text above it.
    tolerance : float, optional
        Wanted rms error, in the function's unit. It adds its energy, and the energy of all degrees
        beyond l.

    Examples
    --------
    >>> s = rholm.expand(rholm.bumpy_sphere(3), degree=4)
    >>> "<svg" in rholm.figures.spectrum_svg(s, title="A body")
    True
    """
    return as_expansion(expansion).spectrum_svg(title, tolerance)


@public
@takes(_core.ReportOptions)
def report_html(
    model: Expansion | Atlas,
    path: str | os.PathLike[str] | None = None,
    *,
    shape: Any = None,
    commands: Sequence[tuple[str, str]] = (),
    interactive: bool = False,
    threads: int = 0,
    progress: Progress = None,
    **options: Unpack[ReportKeywords],
) -> str:
    """Makes a report of a model on one HTML page that needs no other file.

    Parameters
    ----------
    model : Expansion or Atlas
        Model to report.
    path : path, optional
        File to write as well.
    shape : mesh-like, optional
        Mesh of the model. By default the mesh of `expand` or `compress`, if known.
    commands : sequence of (what, command)
        Titles and commands, shown unchanged.
    interactive : bool
        For an expansion: adds a viewer in which the surface can be turned and truncated at any
        degree. It needs no network.
    {options}
    threads, progress
        See ``help(rholm)``.

    Raises
    ------
    InvalidInputError
        For an interactive report of an atlas, options out of range, or a model without a surface.
    UnsupportedError
        If `interactive` and the package was built without the viewer.

    Examples
    --------
    >>> s = rholm.expand(rholm.bumpy_sphere(3), degree=4)
    >>> page = rholm.report_html(s, "body.html", title="A body", picture_size=64)
    >>> "A body" in page
    True
    """
    if interactive and isinstance(model, Atlas):
        raise InvalidInputError("interactive pages are of expansions, not of atlases")
    if path is not None:
        named(path, (".html", ".htm"), "a page")  # checked before the work
    if not isinstance(model, Atlas):
        model = as_expansion(model)
    known = model._shape if shape is None else shape
    mesh = None if known is None else outward_mesh(known)
    given = {**options}
    given["title"] = given.get("title") or model._name or "model"
    given["shape_name"] = given.get("shape_name") or model._name
    viewer = viewer_script() if interactive else ""
    wanted = options_of(_core.ReportOptions, given, "report_html", viewer=viewer)
    wanted.set_commands([(what, command) for what, command in commands])
    with caller(threads, progress) as how:
        page = _core.report_html(model._core, None if mesh is None else mesh._core, wanted, how)
    if path is not None:
        _core.write_file(os.fspath(path), page.encode())
    return page


# Notebooks


def notebook_png(thing: Any) -> bytes | None:
    """Returns a small picture; None for an object without a surface."""
    try:
        return render(thing, _NOTEBOOK_SIZE, scale_bar=False, progress=False).png()
    except Error:
        return None


def _figure(thing: Any) -> str:
    png = notebook_png(thing)
    if png is None:
        return ""
    data = base64.b64encode(png).decode()
    return f'<img alt="" style="float:left;margin-right:1em" src="data:image/png;base64,{data}">'


def _table(rows: list[tuple[str, str]]) -> str:
    cells = "".join(
        f"<tr><th style='text-align:left'>{html.escape(k)}</th><td>{html.escape(v)}</td></tr>"
        for k, v in rows
    )
    return f"<table>{cells}</table>"


def notebook_html(model: Expansion | Atlas) -> str:
    """Returns HTML with a picture and numbers of a model."""
    return _atlas_html(model) if isinstance(model, Atlas) else _expansion_html(model)


def _expansion_html(expansion: Expansion) -> str:
    """Returns HTML with a picture, numbers and the spectrum of an expansion."""
    unit = f" {expansion.unit}" if expansion.unit else ""
    rows = [
        ("function", expansion.function),
        ("degree", str(expansion.degree)),
        ("center", ", ".join(f"{x:.6g}" for x in expansion.center) + unit),
    ]
    figure = ""
    if expansion.function != "other":
        figure = _figure(expansion)
        try:
            measures = expansion.measure()
            # Numbers of higher or no dimension, such as sphericity, are left out: the table is
            # short.
            powers = {1: "", 2: "²", 3: "³"}
            for row in _core.descriptors():
                if row["length_power"] in powers:
                    value = getattr(measures, row["name"])
                    power = powers[row["length_power"]]
                    text = "not known" if value is None else f"{value:.6g}{unit and unit + power}"
                    rows.append((row["name"], text))
        except Error:
            pass  # a series that crosses its centre has neither picture nor measures
    errors = expansion.errors
    if errors is not None and errors.rms is not None:
        rows.append(("rms radial error", f"{errors.rms:.3g}{unit}"))
    elif expansion.function == "radius":
        rms = expansion.rms_beyond()[-1]
        rows.append(("rms radial error", "not known" if np.isnan(rms) else f"{rms:.3g}{unit}"))
    if errors is not None and errors.measured_max is not None:
        rows.append(("largest radial error", f"{errors.measured_max:.3g}{unit}"))
    svg = expansion.spectrum_svg()
    return f"<div>{figure}{_table(rows)}{svg[svg.index('<svg') :]}</div>"


def _atlas_html(atlas: Atlas) -> str:
    """Returns HTML with a picture and numbers of an atlas."""
    size = atlas.size
    unit = f" {atlas.unit}" if atlas.unit else ""
    rows = [("caps", str(size.caps)), ("numbers", str(size.numbers)), ("highest degree", str(atlas.degree))]
    if atlas.errors is not None:
        rows += [
            ("rms distance", f"{atlas.errors.rms:.3g}{unit}"),
            ("largest distance", f"{atlas.errors.max:.3g}{unit}"),
        ]
    return f"<div>{_figure(atlas)}{_table(rows)}</div>"
