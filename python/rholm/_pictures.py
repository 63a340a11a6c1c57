"""Pictures, pages, and how objects show themselves in notebooks."""

from __future__ import annotations

import base64
import html
import os
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import float_rows, floats, plain_array
from ._encode import as_expansion
from ._errors import Error, InvalidInputError
from ._expansion import Expansion
from ._interop import required
from ._options import options_of, takes
from ._run import Progress, caller, named
from ._shapes import Mesh, PointCloud, finite_points, outward_mesh
from ._surfaces import surface_of

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._atlas import Atlas
    from ._keywords import RenderKeywords, ReportKeywords

Pixels = npt.NDArray[np.uint8]

_NOTEBOOK_SIZE = (480, 400)  # pixels; chosen: fits beside text


class Picture(np.ndarray[Any, np.dtype[np.uint8]]):
    """Pixels, (height, width, 3) uint8, as a screen shows them (sRGB): an array that can be saved
    and shows itself in notebooks.
    """

    def png(self) -> bytes:
        """The bytes of a PNG file."""
        return encode_png(self)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes a PNG file.

        Parameters
        ----------
        path : path
            Replaced when complete.
        """
        write_png(path, self)

    def _repr_png_(self) -> bytes | None:
        return self.png() if self.ndim == 3 and self.shape[2] == 3 else None


class Panel:
    """One thing in a picture.

    Parameters
    ----------
    shape : mesh-like, Expansion, Atlas, Reconstruction, PointCloud or array_like (N, 3)
        What is shown; a file may hold points, too. Points of other packages: `rholm.as_points`.
    label : str
        Below it.
    scalars : array_like, (N,), optional
        Per vertex or point, coloured by the colour map.
    colors : array_like, (N, 3), optional
        Per vertex or point, 0 ... 1; by default the shape's own, if there are no scalars.
    smooth : bool, optional
        Of meshes: shaded with their normals; by default if there are any.
    point_radius : float, optional
        Of points: each is a ball of this radius, in their unit; by default their usual distance, so
        that those of a surface close it.

    Raises
    ------
    InvalidInputError
        For scalars and colors, for arrays of another shape.
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

    def __reduce__(self) -> Any:
        return (_panel_of, (self.shape, self._arguments))


def _panel_of(shape: Mesh | PointCloud, arguments: dict[str, Any]) -> Panel:
    return Panel(shape, **arguments)


def _drawable(shape: Any) -> Mesh | PointCloud:
    """The surface of what has one, or points."""
    drawn: Mesh | PointCloud = surface_of(shape, points=True)
    return drawn


def _positive(radius: float) -> float:
    if not radius > 0:
        raise InvalidInputError(f"point_radius is {radius}; it must be above 0, or None")
    return float(radius)


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
    """A picture of one or several shapes, side by side.

    Parameters
    ----------
    shape : mesh-like, Expansion, Atlas, Reconstruction, PointCloud, array_like (N, 3), Panel, or a list
        What is shown; a list has several of these.
    size : (width, height)
        Of the whole picture, pixels, 16 ... 16384.
    scalars : array_like, (N,), optional
        Of one shape: per vertex or point, coloured by the colour map.
    colors : array_like, (N, 3), optional
        Of one shape: per vertex or point, 0 ... 1; by default its own, if there are no scalars.
    label : str
        Of one shape, below it.
    point_radius : float, optional
        Of points, which are balls: as in `Panel`.
    scale : (lowest, highest)
        Of the colour map; None: that of all scalars.
    path : path, optional
        Where a PNG file is written, too.
    {options}
    threads, progress
        See `rholm.caller`.

    Returns
    -------
    picture : Picture
        uint8, (height, width, 3).

    Raises
    ------
    InvalidInputError
        For a shape without triangles or points, more than 20 million points, arrays of another
        length, sizes out of range.
    """
    if path is not None:
        named(path, (".png",), "a picture")  # before the work
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


def encode_png(image: npt.ArrayLike) -> bytes:
    """The bytes of a PNG file.

    Parameters
    ----------
    image : array_like of uint8, (height, width, 3)
        Rows from the top.
    """
    return _core.encode_png(_pixels(image))


def write_png(path: str | os.PathLike[str], image: npt.ArrayLike) -> None:
    """Writes a PNG file to a temporary file that replaces `path` when complete.

    Parameters
    ----------
    path : path
        Where.
    image : array_like of uint8, (height, width, 3)
        Rows from the top.
    """
    _core.write_png(named(path, (".png",), "a picture"), _pixels(image))


def write_file(path: str | os.PathLike[str], data: bytes) -> None:
    """Writes bytes to a temporary file that replaces `path` when complete.

    Parameters
    ----------
    path : path
        Where.
    data : bytes
        All of them.
    """
    _core.write_file(os.fspath(path), bytes(data))


def spectrum_svg(expansion: Expansion, title: str = "", tolerance: float | None = None) -> str:
    """Energy per degree on logarithmic scales as an SVG document.

    Parameters
    ----------
    expansion : Expansion
        Whose spectrum.
    title : str
        Above it.
    tolerance : float, optional
        A wanted rms error, in the function's unit: its energy, and that of all degrees beyond.
    """
    return as_expansion(expansion).spectrum_svg(title, tolerance)


def plot_spectrum(expansion: Expansion, ax: Any = None, **options: Any) -> Any:
    """See `Expansion.plot_spectrum`."""
    if ax is None:
        _, ax = required("matplotlib.pyplot", "matplotlib").subplots()
    degrees = np.arange(1, expansion.degree + 1)
    ax.loglog(degrees, expansion.spectrum("energy")[1:], **{"label": expansion._name or "energy", **options})
    if expansion.tail_strength is not None and expansion.degree > 0:
        tail = expansion.tail_strength / (np.pi * degrees**4.0)
        ax.loglog(degrees, tail, ":", color="0.5", label="predicted tail")
    ax.legend()
    ax.set_xlabel("degree l")
    ax.set_ylabel(f"energy per degree [{expansion.unit}²]" if expansion.unit else "energy per degree")
    return ax


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
    """All that is known of a model on one page of HTML that needs no other file.

    Parameters
    ----------
    model : Expansion or Atlas
        What the page is of.
    path : path, optional
        Where it is written, too.
    shape : mesh-like, optional
        The mesh that the model is of; by default that of `expand` or `compress`, if it is known.
    commands : sequence of (what, command)
        Shown as they are.
    interactive : bool
        Of an expansion: the surface is there to be turned, and cut off at any degree; no network is
        needed.
    {options}
    threads, progress
        See `rholm.caller`.

    Raises
    ------
    InvalidInputError
        For an atlas that is to be interactive, options out of range, and what has no surface.
    UnsupportedError
        If it is to be interactive and this package was built without the viewer.
    """
    from ._atlas import Atlas
    from ._view import viewer_script

    if interactive and isinstance(model, Atlas):
        raise InvalidInputError("interactive pages are of expansions, not of atlases")
    if path is not None:
        named(path, (".html", ".htm"), "a page")  # before the work
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
        write_file(path, page.encode())
    return page


# Notebooks


def notebook_png(thing: Any) -> bytes | None:
    """A small picture; None of what has no surface to be shown."""
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


def expansion_html(expansion: Expansion) -> str:
    """A picture, figures and the spectrum of an expansion."""
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
            # Figures without a unit, such as sphericity, are left out: the table is short.
            powers = {1: "", 2: "²", 3: "³"}
            for row in _core.descriptors():
                if row["length_power"] in powers:
                    value = getattr(measures, row["name"])
                    power = powers[row["length_power"]]
                    text = "not known" if value is None else f"{value:.6g}{unit and unit + power}"
                    rows.append((row["name"], text))
        except Error:
            pass  # a series that crosses its centre has neither
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


def atlas_html(atlas: Atlas) -> str:
    """A picture and figures of an atlas."""
    size = atlas.size
    unit = f" {atlas.unit}" if atlas.unit else ""
    rows = [("caps", str(size.caps)), ("numbers", str(size.numbers)), ("highest degree", str(atlas.degree))]
    if atlas.errors is not None:
        rows += [
            ("rms distance", f"{atlas.errors.rms:.3g}{unit}"),
            ("largest distance", f"{atlas.errors.max:.3g}{unit}"),
        ]
    return f"<div>{_figure(atlas)}{_table(rows)}</div>"
