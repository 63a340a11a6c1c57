"""One surface as coefficients: from a mesh, to a mesh, and what is done with it."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import FloatArray, float_row, floats, triangle_rows, vertex_rows
from ._arrays import directions as unit_rows
from ._coefficients import (
    CoefficientsLike,
    RotationLike,
    align_options,
    array_of,
    as_rotation,
    core_of,
    from_convention,
)
from ._errors import InvalidInputError
from ._interop import foreign_mesh, required, to_pyshtools
from ._run import Progress, caller
from ._shapes import Mesh, MeshLike, _triple, as_mesh, name_of

if TYPE_CHECKING:
    import matplotlib.axes
    import pyshtools
    import xarray

    from ._atlas import Atlas

Method = Literal["edge", "gauge", "curl", "area"]
Unit = Literal["absolute", "diagonal", "radius"]


class Expansion:
    """A surface x = center + r(u) u, u a direction, as coefficients of spherical harmonics.

    Made by `expand`, `load`, `from_array` and `from_pyshtools`; every operation gives a new one.

    Calling it gives radii: ``s(directions)``.
    """

    __slots__ = ("_core", "_encoded", "_name", "_shape")

    def __init__(
        self,
        coeffs: CoefficientsLike,
        *,
        center: npt.ArrayLike = (0.0, 0.0, 0.0),
        function: str = "radius",
        unit: str = "",
        method: str = "",
    ) -> None:
        self._core = _core.Expansion(core_of(coeffs), function, _triple(center, "center"), unit, method)
        self._encoded: _core.Encoded | None = None
        self._shape: Any = None
        self._name = ""

    @classmethod
    def _of(cls, core: _core.Expansion, encoded: Any = None, shape: Any = None, name: str = "") -> Expansion:
        self = cls.__new__(cls)
        self._core = core
        self._encoded = encoded
        self._shape = shape
        self._name = name
        return self

    # What it is

    @property
    def degree(self) -> int:
        """L: the highest degree."""
        return self._core.coefficients.degree

    @property
    def coeffs(self) -> FloatArray:
        """Coefficients in pyshtools' layout and default convention (4 pi-normalised, without
        Condon-Shortley phase), (2, L+1, L+1), in the unit of lengths; a copy.
        """
        return self.to_array()

    def to_array(self, normalization: str = "4pi", csphase: int = 1) -> FloatArray:
        """Coefficients as an array of a convention.

        Parameters
        ----------
        normalization : {"4pi", "orthonormal", "schmidt"}
            What the mean square of each harmonic over the sphere is: 1, 1/(4 pi), 1/(2l+1).
        csphase : {1, -1}
            -1: harmonics with the Condon-Shortley factor (-1)^m.

        Returns
        -------
        coefficients : float64, (2, L+1, L+1)
            Cosine plane, sine plane: ``[0, l, m]`` and ``[1, l, m]``.
        """
        return array_of(self._core.coefficients, normalization, csphase)

    @property
    def center(self) -> FloatArray:
        """Of the expansion, in the coordinates of the shape, (3,)."""
        return self._core.center

    @property
    def function(self) -> str:
        """What is expanded: "radius" (r), "gauge" (1/r) or "other" (no surface: a gravity field)."""
        return self._core.function

    @property
    def unit(self) -> str:
        """Of lengths; empty if not known."""
        return self._core.unit

    @property
    def method(self) -> str:
        """How the coefficients were found; empty if not known."""
        return self._core.method

    @property
    def errors(self) -> _core.TruncationErrors | None:
        """How far the surface is from the shape it was made of; None if not known."""
        return self._core.errors

    @property
    def norm_squared(self) -> float | None:
        """Integral of f^2 over the sphere of the expanded function itself; None if not known."""
        return self._core.norm_squared

    @property
    def tail_strength(self) -> float | None:
        """S of the predicted tail of the spectrum, E_l = S / (pi l^4); None if not known."""
        return self._core.tail_strength

    @property
    def encoded(self) -> _core.Encoded | None:
        """What `expand` found out on the way: centre, star check, times; None for others."""
        return self._encoded

    @property
    def mean_radius(self) -> float:
        """Mean of r over directions, of a gauge 1 / the mean of 1/r."""
        mean = float(self._core.coefficients.values[0, 0, 0]) / float(np.sqrt(4 * np.pi))
        return 1 / mean if self.function == "gauge" else mean

    @property
    def volume(self) -> float:
        """Of the solid, in the cubed unit; exact for a radius."""
        return self.measure().volume

    @property
    def area(self) -> float:
        """Of the surface, in the squared unit; to about 1e-12."""
        return self.measure().area

    @property
    def centroid(self) -> FloatArray:
        """Of the solid, in the coordinates of the shape, (3,)."""
        return self.measure().centroid

    def measure(self, *, threads: int = 0) -> _core.SurfaceMeasures:
        """Volume, area and centroid in one go.

        Parameters
        ----------
        threads : int
            See `rholm.caller`.
        """
        self._require_surface()
        with caller(threads, False) as how:
            return _core.measure(self._core, how)

    def spectrum(self, kind: Literal["power", "energy"] = "power") -> FloatArray:
        """Spectrum by degree, l = 0 ... L, (L+1,).

        Parameters
        ----------
        kind : {"power", "energy"}
            "power": mean square over the sphere, as pyshtools has it by default; "energy": integral
            of the square, 4 pi as much.
        """
        if kind not in ("power", "energy"):
            raise InvalidInputError(f"kind is 'power' or 'energy', not {kind!r}")
        energy = _core.power_spectrum(self._core.coefficients)
        return energy if kind == "energy" else energy / (4 * np.pi)

    # Values

    def __call__(
        self,
        directions: npt.ArrayLike,
        *,
        precision: float = 1e-12,
        threads: int = 0,
        progress: Progress = None,
    ) -> FloatArray:
        """Radii (values of the function, if it is no surface) in directions from the centre.

        Parameters
        ----------
        directions : array_like, (..., 3)
            Vectors of any length.
        precision : float
            Of the sums; see `rholm.evaluate`.
        threads, progress
            See `rholm.caller`.

        Returns
        -------
        radii : float64, (...)
        """
        rows, shape = unit_rows(directions)
        with caller(threads, progress) as how:
            values = _core.evaluate(self._core.coefficients, rows, "fast", precision, how)
        if self.function == "gauge":
            values = 1 / values
        return values.reshape(shape)

    def gradient(
        self,
        directions: npt.ArrayLike,
        *,
        precision: float = 1e-12,
        threads: int = 0,
        progress: Progress = None,
    ) -> FloatArray:
        """Surface gradients of the radius on the unit sphere, tangential at each direction.

        Parameters
        ----------
        directions, precision, threads, progress
            As in calling it.

        Returns
        -------
        gradients : float64, (..., 3)
        """
        rows, shape = unit_rows(directions)
        with caller(threads, progress) as how:
            values, gradients = _core.evaluate_with_gradient(
                self._core.coefficients, rows, "fast", precision, how
            )
        if self.function == "gauge":
            gradients = -gradients / values[:, None] ** 2
        result: FloatArray = gradients.reshape(*shape, 3)
        return result

    def points(self, directions: npt.ArrayLike, **options: Any) -> FloatArray:
        """Points of the surface in directions from the centre, (..., 3).

        Parameters
        ----------
        directions : array_like, (..., 3)
            Vectors of any length.
        **options
            As in calling it.
        """
        self._require_surface()
        rows, shape = unit_rows(directions)
        radii = np.asarray(self(rows, **options))
        return (self.center + radii[:, None] * rows).reshape(*shape, 3)

    # Surfaces

    def mesh(
        self,
        subdivisions: int | None = None,
        degree: int | None = None,
        *,
        grid: tuple[int, int] | None = None,
        like: MeshLike | None = None,
        threads: int = 0,
        progress: Progress = None,
    ) -> Mesh:
        """The surface as a mesh, with the exact unit normals of the surface.

        Parameters
        ----------
        subdivisions : int, optional
            Of an icosphere, 20 * 4^n triangles, 0 ... 12; by default two vertices a coefficient,
            4 ... 7.
        degree : int, optional
            The series is cut off there.
        grid : (n_theta, n_phi), optional
            A latitude-longitude sphere instead.
        like : mesh-like, optional
            The directions and triangles of a mesh instead.
        threads, progress
            See `rholm.caller`.
        """
        return self.meshes(
            [self.degree if degree is None else degree],
            subdivisions,
            grid=grid,
            like=like,
            threads=threads,
            progress=progress,
        )[0]

    def meshes(
        self,
        degrees: npt.ArrayLike,
        subdivisions: int | None = None,
        *,
        grid: tuple[int, int] | None = None,
        like: MeshLike | None = None,
        threads: int = 0,
        progress: Progress = None,
    ) -> list[Mesh]:
        """The surface cut off at several degrees, on the same directions: levels of detail.

        Parameters
        ----------
        degrees : array_like of int
            Of each mesh.
        subdivisions, grid, like, threads, progress
            As in `mesh`.
        """
        wanted = [int(degree) for degree in np.atleast_1d(np.asarray(degrees))]
        if (subdivisions is not None) + (grid is not None) + (like is not None) > 1:
            raise InvalidInputError("subdivisions, grid and like exclude one another: give one of them")
        self._require_surface()
        if grid is not None:
            sphere = _core.latitude_longitude_sphere(*grid)
        elif like is not None:
            sphere = _core.directions_of(as_mesh(like)._core, tuple(self.center))
        else:
            highest = min(max(wanted, default=0), self.degree)
            sphere = _core.icosphere(_subdivisions_for(highest) if subdivisions is None else subdivisions)
        with caller(threads, progress) as how:
            meshes = _core.synthesize(self._core, sphere, wanted, how)
        return [Mesh._of(mesh) for mesh in meshes]

    # Operations

    def truncate(self, degree: int) -> Expansion:
        """The series cut off at a degree, or filled with zeros up to it.

        Parameters
        ----------
        degree : int
            Of the result.
        """
        return self._with(self._core.coefficients.resized(degree))

    def rotate(
        self,
        rotation: RotationLike,
        about: npt.ArrayLike = (0.0, 0.0, 0.0),
        *,
        threads: int = 0,
        progress: Progress = None,
    ) -> Expansion:
        """The surface turned as a whole.

        Parameters
        ----------
        rotation : Rotation, matrix (3, 3), quaternion (4,), scipy's Rotation
            Takes the point x to R x.
        about : array_like, (3,)
            The point it is turned about: the centre moves too.
        threads, progress
            See `rholm.caller`.
        """
        at = _triple(about, "about")
        with caller(threads, progress) as how:
            return Expansion._of(_core.rotate(self._core, as_rotation(rotation), at, how))

    def mirror(self, axis: Literal["x", "y", "z"], about: npt.ArrayLike = (0.0, 0.0, 0.0)) -> Expansion:
        """The mirror image in the plane through `about` across an axis.

        Parameters
        ----------
        axis : {"x", "y", "z"}
            The coordinate that changes its sign.
        about : array_like, (3,)
            A point of the plane.
        """
        return Expansion._of(_core.mirror(self._core, axis, _triple(about, "about")))

    def filter(self, gains: npt.ArrayLike, name: str = "filter") -> Expansion:
        """Each degree times a factor.

        Parameters
        ----------
        gains : array_like, (n,)
            Of the degrees from 0 on, as `low_pass` makes them; degrees beyond have gain 0.
        name : str
            Says what was done; added to `method`.
        """
        return Expansion._of(_core.filter(self._core, floats(gains, "gains"), name))

    def recenter(
        self, center: npt.ArrayLike | None = None, *, threads: int = 0, progress: Progress = None
    ) -> Expansion:
        """The same surface as seen from another centre, of the same degree.

        Parameters
        ----------
        center : array_like, (3,), optional
            By default the centroid of the solid.
        threads, progress
            See `rholm.caller`.
        """
        with caller(threads, progress) as how:
            at = _core.volume_centroid(self._core, how) if center is None else float_row(center, "center")
            return Expansion._of(_core.recentered(self._core, tuple(float(x) for x in at), how))

    def scale(self, factor: float, unit: str | None = None) -> Expansion:
        """All lengths times a factor.

        Parameters
        ----------
        factor : float
            Above 0.
        unit : str, optional
            The name of the new unit.
        """
        scaled = Expansion._of(_core.scaled(self._core, factor))
        return scaled if unit is None else scaled.with_unit(unit)

    def with_unit(self, unit: str) -> Expansion:
        """The same numbers in a unit of that name.

        Parameters
        ----------
        unit : str
            "km", "mm", ...
        """
        e = self._core
        core = _core.Expansion(
            e.coefficients,
            e.function,
            tuple(e.center),
            unit,
            e.method,
            e.norm_squared,
            e.tail_strength,
            e.errors,
        )
        return Expansion._of(core, self._encoded, self._shape, self._name)

    def principal_axes(self) -> _core.PrincipalAxes:
        """The axes of degree 2, longest first; see `rholm.principal_axes`."""
        return _core.principal_axes(self._core.coefficients, self.function)

    # To others

    def to_pyshtools(self, normalization: str = "4pi", csphase: int = 1) -> pyshtools.SHCoeffs:
        """A `pyshtools.SHCoeffs` with these coefficients.

        Parameters
        ----------
        normalization : {"4pi", "orthonormal", "schmidt"}
            Of the result.
        csphase : {1, -1}
            Of the result.
        """
        return to_pyshtools(self, normalization, csphase)

    def to_xarray(self, normalization: str = "4pi", csphase: int = 1) -> xarray.DataArray:
        """A `xarray.DataArray` with dimensions kind ("c", "s"), l and m, and what is known as attributes.

        Parameters
        ----------
        normalization, csphase
            Of the result.
        """
        l_values = np.arange(self.degree + 1)
        return required("xarray").DataArray(
            self.to_array(normalization, csphase),
            dims=("kind", "l", "m"),
            coords={"kind": ["c", "s"], "l": l_values, "m": l_values},
            name=self.function,
            attrs={
                "normalization": normalization,
                "csphase": csphase,
                "center": self.center,
                "units": self.unit,
                "method": self.method,
            },
        )

    def save(
        self,
        path: str | os.PathLike[str],
        *,
        format: str | None = None,
        normalization: str = "4pi",
        csphase: int = 1,
    ) -> None:
        """Writes a model file (.h5: all that is known), or a file of coefficients.

        Parameters
        ----------
        path : path
            Its extension says the format: .h5, .hdf5; .sh, .txt, .shtools; .gfc, .icgem; .json; .npy.
        format : {"hdf5", "shtools", "icgem", "json", "npy"}, optional
            The format, whatever the extension.
        normalization, csphase
            Of the numbers, in formats other than the model file.

        Raises
        ------
        IoError
            If it cannot be written; a file that was there is whole then.
        """
        target = os.fspath(path)
        with caller(0, False) as how:
            if format == "hdf5" or (format is None and target.lower().endswith((".h5", ".hdf5"))):
                _core.write_model(self._core, target, how)
            else:
                _core.write_coefficients(self._core, target, format, normalization, csphase, how)

    def report_html(
        self,
        path: str | os.PathLike[str] | None = None,
        *,
        shape: MeshLike | None = None,
        title: str = "",
        picture_size: int = 480,
        tolerance: float | None = None,
        threads: int = 0,
        progress: Progress = None,
    ) -> str:
        """All that is known on one page of HTML that needs no other file.

        Parameters
        ----------
        path : path, optional
            Where the page is written, too.
        shape : mesh-like, optional
            The mesh that this is of, to be shown and compared; by default that of `expand`.
        title : str
            What the page is of.
        picture_size : int
            Pixels of each picture's side, 16 ... 4096.
        tolerance : float, optional
            A line in the plots: a wanted rms error, in the unit of lengths.
        threads, progress
            See `rholm.caller`.
        """
        from ._pictures import report_html

        return report_html(
            self,
            path,
            shape=shape,
            title=title,
            picture_size=picture_size,
            tolerance=tolerance,
            threads=threads,
            progress=progress,
        )

    def render(self, **options: Any) -> Any:
        """A picture; see `rholm.render`."""
        from ._pictures import render

        return render(self, **options)

    def spectrum_svg(self, title: str = "", tolerance: float | None = None) -> str:
        """The spectrum on logarithmic scales as an SVG document; see `rholm.spectrum_svg`."""
        return _core.spectrum_svg(self._core, title or self._name, tolerance)

    def plot_spectrum(self, ax: matplotlib.axes.Axes | None = None, **options: Any) -> matplotlib.axes.Axes:
        """Energy per degree on logarithmic scales, with the predicted tail, in matplotlib.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where it is drawn; by default a new figure.
        **options
            Of ``Axes.loglog``.
        """
        if ax is None:
            _, ax = required("matplotlib.pyplot", "matplotlib").subplots()
        l_values = np.arange(1, self.degree + 1)
        ax.loglog(l_values, self.spectrum("energy")[1:], **options)
        if self.tail_strength is not None and self.degree > 0:
            ax.loglog(
                l_values,
                self.tail_strength / (np.pi * l_values**4.0),
                ":",
                color="0.5",
                label="predicted tail",
            )
        ax.set_xlabel("degree l")
        ax.set_ylabel(f"energy per degree [{self.unit}²]" if self.unit else "energy per degree")
        return ax

    def __repr__(self) -> str:
        unit = f" {self.unit}" if self.unit else ""
        at = ", ".join(f"{x:.6g}" for x in self.center)
        return f"<rholm.Expansion: {self.function} to degree {self.degree}, center ({at}){unit}>"

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Expansion):
            return NotImplemented
        return (
            self.function == other.function
            and bool(np.array_equal(self.center, other.center))
            and bool(np.array_equal(self._core.coefficients.values, other._core.coefficients.values))
        )

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> Any:
        e = self._core
        errors = None if e.errors is None else e.errors.to_dict()
        known = (e.function, tuple(e.center), e.unit, e.method, e.norm_squared, e.tail_strength, errors)
        return (_expansion_of, (np.array(e.coefficients.values), *known))

    def _repr_png_(self) -> bytes | None:
        from ._pictures import notebook_png

        return notebook_png(self)

    def _repr_html_(self) -> str:
        from ._pictures import expansion_html

        return expansion_html(self)

    def _with(self, coefficients: _core.Coefficients) -> Expansion:
        e = self._core
        return Expansion._of(
            _core.Expansion(
                coefficients, e.function, tuple(e.center), e.unit, e.method, e.norm_squared, e.tail_strength
            ),
            shape=self._shape,
            name=self._name,
        )

    def _require_surface(self) -> None:
        _core.require_surface(self._core)


def as_expansion(thing: Any) -> Expansion:
    """An `Expansion` of one, or of pyshtools.SHCoeffs.

    Parameters
    ----------
    thing : Expansion or pyshtools.SHCoeffs
        Anything else is a TypeError.
    """
    if isinstance(thing, Expansion):
        return thing
    if type(thing).__module__.partition(".")[0] == "pyshtools":
        return from_pyshtools(thing)
    raise TypeError(
        f"an Expansion is needed, not {type(thing).__name__}; expand(), load() and from_array() make one"
    )


def _chart_core(chart: Any) -> _core.StarChart:
    if not isinstance(chart, StarChart):
        raise TypeError(f"a StarChart is needed, not {type(chart).__name__}; make_star_chart() makes one")
    return chart._core


def _expansion_of(
    values: FloatArray, function: str, center: Any, unit: str, method: str, norm: Any, tail: Any, errors: Any
) -> Expansion:
    core = from_convention(values, "orthonormal", 1)
    known = None if errors is None else _core.TruncationErrors(*errors.values())
    return Expansion._of(_core.Expansion(core, function, center, unit, method, norm, tail, known))


def _subdivisions_for(degree: int) -> int:
    """Of an icosphere with two vertices a coefficient, 4 ... 7: as the program has it."""
    n = 4
    while n < 7 and 10 * 4**n + 2 < 2 * (degree + 1) ** 2:
        n += 1
    return n


def require_surface(expansion: Expansion) -> None:
    """Raises UnsupportedError for coefficients that are not of a surface.

    Parameters
    ----------
    expansion : Expansion
        What is asked about.
    """
    as_expansion(expansion)._require_surface()


# From a mesh


def _center_of(center: Any) -> tuple[str, tuple[float, float, float] | None]:
    if isinstance(center, str):
        return center, None
    return "", _triple(center, "center")


def tolerance_of(
    error: float, unit: Unit, norm: str, measure: str | None, max_degree: int
) -> _core.Tolerance:
    """As `expand` takes it."""
    if measure is None:
        measure = "distance" if unit == "diagonal" else "radius"
    return _core.Tolerance(error=error, unit=unit, norm=norm, measure=measure, max_degree=max_degree)


def encode_options(
    degree: int | None,
    tolerance: float | None,
    unit: Unit,
    norm: str,
    measure: str | None,
    max_degree: int,
    method: str,
    engine: str,
    precision: float,
    center: Any,
    rays: int,
    signed: bool,
    errors: bool,
    weld: float,
) -> _core.EncodeOptions:
    """As `expand` takes them."""
    if degree is not None and tolerance is not None:
        raise InvalidInputError("degree and tolerance exclude one another: give one of them")
    analyze = _core.AnalyzeOptions(degree=degree, method=method, engine=engine, precision=precision)
    options = _core.EncodeOptions(analyze=analyze, errors=errors, weld_tolerance=weld)
    if tolerance is not None:
        options.tolerance = tolerance_of(tolerance, unit, norm, measure, max_degree)
    name, point = _center_of(center)
    options.set_chart(name, point, rays, signed)
    return options


def expand(
    shape: MeshLike,
    degree: int | None = None,
    *,
    tolerance: float | None = None,
    unit: Unit = "absolute",
    norm: Literal["rms", "max"] = "rms",
    measure: Literal["radius", "distance"] | None = None,
    max_degree: int = 1024,
    method: Method = "edge",
    engine: Literal["fast", "direct"] = "fast",
    precision: float = 1e-8,
    center: Any = "auto",
    rays: int = 100_000,
    signed: bool = False,
    errors: bool = True,
    weld: float = 0.0,
    length_unit: str = "",
    threads: int = 0,
    progress: Progress = None,
) -> Expansion:
    """Spherical-harmonic coefficients of a closed mesh.

    Parameters
    ----------
    shape : mesh-like
        (vertices, triangles), a path, or a mesh of rholm, trimesh, PyVista or meshio. float32 and
        float64 vertices and 32-bit triangles are not copied; other integers are made 32-bit. A mesh
        that is inside out or has doubled vertices is mended.
    degree : int, optional
        L, by default 64.
    tolerance : float, optional
        The smallest degree that keeps this error, instead.
    unit : {"absolute", "diagonal", "radius"}
        Of the tolerance: the mesh's own, of its bounding box's diagonal, of its mean radius.
    norm : {"rms", "max"}
        Of all errors of the tolerance.
    measure : {"radius", "distance"}, optional
        Of each error: along rays from the centre, or between the surfaces. By default the radius,
        with ``unit="diagonal"`` the distance.
    max_degree : int
        Where the search for a tolerance ends.
    method : {"edge", "gauge", "curl", "area"}
        Which function is expanded (gauge: 1/r, the others r) and by which integrals.
    engine : {"fast", "direct"}
        Of the sums; direct ones are the oracle.
    precision : float
        Wanted error of the coefficients, 1e-14 ... 1e-1: l2 relative to the norm of the function
        without its mean.
    center : {"auto", "cosine", "none", "centroid", "volume"} or array_like, (3,)
        Where the centre is.
    rays : int
        Directions tried by the check for a star shape; 0 leaves them out.
    signed : bool
        Whether a surface that is not star-shaped is taken: by the alternating sum of its radii.
    errors : bool
        Whether truncation errors are measured and predicted.
    weld : float
        Tolerance of welding, in the mesh's unit; 0 joins identical vertices.
    length_unit : str
        Of the vertices: "km", "mm", ...
    threads, progress
        See `rholm.caller`.

    Returns
    -------
    s : Expansion
        With ``s.errors`` and ``s.encoded``, what was found out on the way.

    Raises
    ------
    InvalidInputError
        For a mesh that is not closed or not oriented alike, and options out of range.
    NotStarShapedError
        With figures, unless `signed`; `compress` takes any shape.

    Notes
    -----
    Coefficients are those of the piecewise flat surface itself, by integrals over its edges and
    faces, not of samples: see docs/method.md.

    Examples
    --------
    >>> import rholm
    >>> s = rholm.expand(rholm.ellipsoid((3, 2, 1), 5), degree=16)
    >>> s.degree
    16
    >>> round(s.volume / (4 / 3 * 3.14159265 * 6), 2)
    1.0
    """
    options = encode_options(
        degree,
        tolerance,
        unit,
        norm,
        measure,
        max_degree,
        method,
        engine,
        precision,
        center,
        rays,
        signed,
        errors,
        weld,
    )
    with caller(threads, progress) as how:
        if isinstance(shape, (str, os.PathLike)):
            encoded, _ = _core.encode_file(os.fspath(shape), options, how)
        else:
            encoded = _core.encode(*_mesh_arrays(shape), options, how)
    expansion = Expansion._of(encoded.analysis.expansion, encoded, shape, name_of(shape))
    return expansion.with_unit(length_unit) if length_unit else expansion


def _mesh_arrays(shape: Any) -> tuple[Any, Any]:
    """Vertices and triangles where they lie."""
    if isinstance(shape, Mesh):
        return shape._core.vertices, shape._core.triangles
    arrays = foreign_mesh(shape)
    if arrays is None:
        if not isinstance(shape, (tuple, list)) or len(shape) != 2:
            as_mesh(shape)  # says what is wrong
        arrays = (shape[0], shape[1], {})
    return vertex_rows(arrays[0]), triangle_rows(arrays[1])


def encode(shape: MeshLike, **options: Any) -> _core.Encoded:
    """What `expand` finds out on the way from a mesh to an expansion.

    Parameters
    ----------
    shape, **options
        As in `expand`.
    """
    encoded = expand(shape, **options).encoded
    assert encoded is not None
    return encoded


class StarChart:
    """A mesh seen from a centre: what `analyze` and `monte_carlo` work on."""

    __slots__ = ("_core",)

    def __init__(self, core: _core.StarChart) -> None:
        self._core = core

    @property
    def mesh(self) -> Mesh:
        """Welded, closed, outward, vertices relative to the centre."""
        return Mesh._of(self._core.mesh)

    @property
    def report(self) -> _core.StarReport:
        """The centre, and how well it sees the surface."""
        return self._core.report


def make_star_chart(
    mesh: MeshLike,
    center: Any = "auto",
    *,
    rays: int = 100_000,
    signed: bool = False,
    threads: int = 0,
    progress: Progress = None,
) -> StarChart:
    """Finds the centre, checks, and moves it to the origin.

    Parameters
    ----------
    mesh : mesh-like
        Welded and outward.
    center, rays, signed, threads, progress
        As in `expand`.
    """
    name, point = _center_of(center)
    with caller(threads, progress) as how:
        return StarChart(_core.make_star_chart(as_mesh(mesh)._core, name, point, rays, signed, how))


def find_center(
    mesh: MeshLike, center: Any = "auto", *, rays: int = 100_000, threads: int = 0, progress: Progress = None
) -> _core.StarReport:
    """Finds the centre and checks how it sees the surface.

    Parameters
    ----------
    mesh : mesh-like
        Welded, closed, outward.
    center, rays, threads, progress
        As in `expand`.
    """
    name, point = _center_of(center)
    with caller(threads, progress) as how:
        return _core.find_center(as_mesh(mesh)._core, name, point, rays, how)


def check_star(
    mesh: MeshLike, center: npt.ArrayLike, *, rays: int = 100_000, threads: int = 0, progress: Progress = None
) -> _core.StarReport:
    """Whether a surface is star-shaped from a point.

    Parameters
    ----------
    mesh : mesh-like
        Welded, closed, outward.
    center : array_like, (3,)
        The point.
    rays, threads, progress
        As in `expand`.
    """
    at = _triple(center, "center")
    with caller(threads, progress) as how:
        return _core.check_star(as_mesh(mesh)._core, at, rays, how)


class Analyzed(NamedTuple):
    """What `analyze` made of a chart."""

    expansion: Expansion
    """The coefficients."""
    analysis: _core.Analysis
    """How they were found."""
    tolerance: _core.ToleranceReport | None
    """How a tolerance was kept."""


def analyze(
    chart: StarChart,
    degree: int | None = None,
    *,
    tolerance: float | None = None,
    unit: Unit = "absolute",
    norm: Literal["rms", "max"] = "rms",
    measure: Literal["radius", "distance"] | None = None,
    max_degree: int = 1024,
    method: Method = "edge",
    engine: Literal["fast", "direct"] = "fast",
    precision: float = 1e-8,
    threads: int = 0,
    progress: Progress = None,
) -> Analyzed:
    """Coefficients of a chart by the method that is asked for: a step of `expand`.

    Parameters
    ----------
    chart : StarChart
        Of `make_star_chart`.
    degree, tolerance, unit, norm, measure, max_degree, method, engine, precision, threads, progress
        As in `expand`.
    """
    if degree is not None and tolerance is not None:
        raise InvalidInputError("degree and tolerance exclude one another: give one of them")
    options = _core.AnalyzeOptions(degree=degree, method=method, engine=engine, precision=precision)
    report = None
    with caller(threads, progress) as how:
        if tolerance is None:
            analysis = _core.analyze(_chart_core(chart), options, how)
        else:
            wanted = tolerance_of(tolerance, unit, norm, measure, max_degree)
            analysis, report = _core.analyze_to_tolerance(_chart_core(chart), wanted, options, how)
    return Analyzed(Expansion._of(analysis.expansion), analysis, report)


def radius_norm_squared(chart: StarChart) -> float:
    """Integral of r^2 over directions of a star-shaped surface in closed form.

    Parameters
    ----------
    chart : StarChart
        Of `make_star_chart`.
    """
    return _core.radius_norm_squared(_chart_core(chart))


def gauge_norm_squared(chart: StarChart) -> float:
    """Integral of 1/r^2 over directions in closed form.

    Parameters
    ----------
    chart : StarChart
        Of `make_star_chart`.
    """
    return _core.gauge_norm_squared(_chart_core(chart))


def tail_strength(chart: StarChart, function: str = "radius") -> float:
    """S: the energy per degree is about S / (pi l^4) beyond the mesh's own resolution.

    Parameters
    ----------
    chart : StarChart
        Of `make_star_chart`.
    function : {"radius", "gauge"}
        Which is expanded.
    """
    return _core.tail_strength(_chart_core(chart), function)


def vertex_error_strength(chart: StarChart, function: str = "radius") -> float:
    """The largest truncation error at vertices, times 2 pi (L + 1).

    Parameters
    ----------
    chart : StarChart
        Of `make_star_chart`.
    function : {"radius", "gauge"}
        Which is expanded.
    """
    return _core.vertex_error_strength(_chart_core(chart), function)


def vertex_error_strengths(mesh: MeshLike, center: npt.ArrayLike) -> _core.ErrorStrengths:
    """The same of radius, gauge and distance of a closed mesh as it is.

    Parameters
    ----------
    mesh : mesh-like
        Closed.
    center : array_like, (3,)
        Of the expansion.
    """
    return _core.vertex_error_strengths(as_mesh(mesh)._core, _triple(center, "center"))


def truncation_errors(
    mesh: MeshLike,
    expansion: Expansion,
    *,
    precision: float = 1e-8,
    predict: bool = True,
    threads: int = 0,
    progress: Progress = None,
) -> _core.TruncationErrors:
    """How far the surface of an expansion is from the mesh it was made of.

    Parameters
    ----------
    mesh : mesh-like
        Closed and star-shaped about the expansion's centre.
    expansion : Expansion
        Of its radius or gauge.
    precision : float
        How exact its coefficients are.
    predict : bool
        Whether the largest errors are predicted in closed form, too.
    threads, progress
        See `rholm.caller`.
    """
    with caller(threads, progress) as how:
        return _core.truncation_errors(
            as_mesh(mesh)._core, as_expansion(expansion)._core, precision, predict, how
        )


class MonteCarlo(NamedTuple):
    """What `monte_carlo` found."""

    expansion: Expansion
    """The mean."""
    deviation: FloatArray
    """Of each coefficient, (2, L+1, L+1) in pyshtools' default convention: 3 of it hold the error
    in about 99.7 % of all seeds."""
    report: _core.MonteCarlo
    """How many samples, and how exact."""


def monte_carlo(
    chart: StarChart,
    degree: int = 64,
    *,
    places: Literal["edge", "triangle"] = "edge",
    seed: int = 1,
    samples: int | None = None,
    deviation: float = 1e-2,
    most_samples: int = 4096,
    threads: int = 0,
    progress: Progress = None,
) -> MonteCarlo:
    """Coefficients by random points, as the paper has it, with an honest deviation.

    Parameters
    ----------
    chart : StarChart
        Of `make_star_chart`.
    degree : int
        L.
    places : {"edge", "triangle"}
        Where the points are.
    seed : int
        Of the random numbers.
    samples : int, optional
        Points on each edge or triangle; by default rounds are added until `deviation` is reached.
    deviation : float
        Wanted relative deviation, 1e-8 ... 1.
    most_samples : int
        Where to stop without having reached it.
    threads, progress
        See `rholm.caller`.
    """
    options = _core.MonteCarloOptions(
        degree=degree,
        places=places,
        seed=seed,
        samples=samples,
        deviation=deviation,
        most_samples=most_samples,
    )
    with caller(threads, progress) as how:
        found = _core.monte_carlo(_chart_core(chart), options, how)
    return MonteCarlo(Expansion._of(found.expansion), np.abs(array_of(found.deviation)), found)


# From others


def from_array(
    values: npt.ArrayLike,
    *,
    normalization: str = "4pi",
    csphase: int = 1,
    center: npt.ArrayLike = (0.0, 0.0, 0.0),
    function: str = "radius",
    unit: str = "",
) -> Expansion:
    """An expansion of an array of coefficients.

    Parameters
    ----------
    values : array_like, (2, L+1, L+1)
        Cosine plane, sine plane.
    normalization, csphase
        Of the array; pyshtools' default if not given.
    center : array_like, (3,)
        Of the surface.
    function : {"radius", "gauge", "other"}
        What the function is.
    unit : str
        Of lengths.
    """
    return Expansion(
        from_convention(values, normalization, csphase), center=center, function=function, unit=unit
    )


def from_pyshtools(
    clm: Any, *, center: npt.ArrayLike = (0.0, 0.0, 0.0), function: str = "radius"
) -> Expansion:
    """An expansion of a `pyshtools.SHCoeffs` (SHGrid: of its ``expand()``), of any normalization.

    Parameters
    ----------
    clm : pyshtools.SHCoeffs or pyshtools.SHGrid
        Real, or complex of a real function.
    center : array_like, (3,)
        Of the surface.
    function : {"radius", "gauge", "other"}
        What the function is.
    """
    if hasattr(clm, "expand") and not hasattr(clm, "coeffs"):
        clm = clm.expand()
    unit = getattr(clm, "units", None) or ""
    return Expansion(core_of(clm), center=center, function=function, unit=unit)


def load(path: str | os.PathLike[str], *, normalization: str = "4pi", csphase: int = 1) -> Expansion | Atlas:
    """Reads a model file, of one expansion or of an atlas, or any file of coefficients.

    Parameters
    ----------
    path : path
        The content decides the format.
    normalization, csphase
        Of files that do not say it (bare text, .npy).
    """
    from ._atlas import Atlas

    source = os.fspath(path)
    with caller(0, False) as how:
        if _core.is_atlas_file(source):
            return Atlas._of(_core.read_atlas(source, how))
        expansion, *_ = _core.read_any_coefficients(source, normalization, csphase, False, how)
    return Expansion._of(expansion, name=name_of(path))


def read_model(path: str | os.PathLike[str]) -> Expansion:
    """Reads a model file of one expansion.

    Parameters
    ----------
    path : path
        HDF5; layout in docs/model-file.md.
    """
    with caller(0, False) as how:
        return Expansion._of(_core.read_model(os.fspath(path), how), name=name_of(path))


def write_model(expansion: Expansion, path: str | os.PathLike[str]) -> None:
    """Writes a model file.

    Parameters
    ----------
    expansion : Expansion
        With all that is known of it.
    path : path
        Replaced when complete.
    """
    as_expansion(expansion).save(path, format="hdf5")


def write_coefficients(expansion: Expansion, path: str | os.PathLike[str], **options: Any) -> None:
    """Writes a file of coefficients; see `Expansion.save`.

    Parameters
    ----------
    expansion : Expansion
        What is written.
    path : path
        Its extension says the format.
    **options
        format, normalization, csphase.
    """
    with caller(0, False) as how:
        _core.write_coefficients(
            as_expansion(expansion)._core,
            os.fspath(path),
            options.pop("format", None),
            options.pop("normalization", "4pi"),
            options.pop("csphase", 1),
            how,
        )
    if options:
        raise TypeError(f"no option is called {', '.join(options)}")


def is_model_file(path: str | os.PathLike[str]) -> bool:
    """Whether a file is a model file, by its first bytes.

    Parameters
    ----------
    path : path
        Any file.
    """
    return _core.is_model_file(os.fspath(path))


# Operations as functions


def rotate(
    thing: Any,
    rotation: RotationLike,
    about: npt.ArrayLike = (0.0, 0.0, 0.0),
    *,
    threads: int = 0,
    progress: Progress = None,
) -> Any:
    """An expansion, coefficients or points turned.

    Parameters
    ----------
    thing : Expansion, array_like (2, L+1, L+1), or points (..., 3)
        Arrays of coefficients are in pyshtools' default convention, and so is the result.
    rotation : rotation-like
        Takes the point x to R x; a function f becomes f(R^-1 u).
    about : array_like, (3,)
        The point that an expansion, or points, are turned about.
    threads, progress
        See `rholm.caller`.
    """
    if isinstance(thing, Expansion):
        return thing.rotate(rotation, about, threads=threads, progress=progress)
    turn = as_rotation(rotation)
    array = np.asarray(thing) if not hasattr(thing, "coeffs") else None
    if array is None or (array.ndim == 3 and array.shape[0] == 2 and array.shape[1] == array.shape[2]):
        with caller(threads, progress) as how:
            return array_of(_core.rotate(core_of(thing), turn, how))
    if array.ndim == 0 or array.shape[-1] != 3:
        raise InvalidInputError(
            f"points (..., 3) or coefficients (2, L+1, L+1) are needed, not {array.shape}"
        )
    origin = float_row(about, "about")
    rows = np.ascontiguousarray(array.reshape(-1, 3), dtype=np.float64)
    return (_core.rotate(np.ascontiguousarray(rows - origin), turn) + origin).reshape(array.shape)


def mirror(
    thing: Expansion | CoefficientsLike, axis: Literal["x", "y", "z"], about: npt.ArrayLike = (0.0, 0.0, 0.0)
) -> Any:
    """The mirror image of an expansion, or of coefficients.

    Parameters
    ----------
    thing : Expansion or coefficients-like
        Arrays are in pyshtools' default convention, and so is the result.
    axis : {"x", "y", "z"}
        The coordinate that changes its sign.
    about : array_like, (3,)
        A point of the plane, for an expansion.
    """
    if isinstance(thing, Expansion):
        return thing.mirror(axis, about)
    return array_of(_core.mirror(core_of(thing), axis))


def filter(thing: Expansion | CoefficientsLike, gains: npt.ArrayLike, name: str = "filter") -> Any:
    """Each degree of an expansion, or of coefficients, times a factor.

    Parameters
    ----------
    thing : Expansion or coefficients-like
        Arrays are in pyshtools' default convention, and so is the result.
    gains : array_like, (n,)
        Of the degrees from 0 on.
    name : str
        Says what was done; added to the expansion's method.
    """
    if isinstance(thing, Expansion):
        return thing.filter(gains, name)
    return array_of(_core.filter(core_of(thing), floats(gains, "gains")))


def scaled(expansion: Expansion, factor: float) -> Expansion:
    """All lengths times a factor.

    Parameters
    ----------
    expansion : Expansion
        Stays as it is.
    factor : float
        Above 0.
    """
    return as_expansion(expansion).scale(factor)


def recentered(
    expansion: Expansion, center: npt.ArrayLike, *, threads: int = 0, progress: Progress = None
) -> Expansion:
    """The same surface as seen from another centre.

    Parameters
    ----------
    expansion : Expansion
        Star-shaped about both centres.
    center : array_like, (3,)
        The new one.
    threads, progress
        See `rholm.caller`.
    """
    return as_expansion(expansion).recenter(center, threads=threads, progress=progress)


def volume_centroid(expansion: Expansion, *, threads: int = 0) -> FloatArray:
    """Of the solid within a surface, (3,).

    Parameters
    ----------
    expansion : Expansion
        Of a surface.
    threads : int
        See `rholm.caller`.
    """
    with caller(threads, False) as how:
        return _core.volume_centroid(as_expansion(expansion)._core, how)


def measure(expansion: Expansion, *, threads: int = 0) -> _core.SurfaceMeasures:
    """Volume, area and centroid of the solid bounded by a surface.

    Parameters
    ----------
    expansion : Expansion
        Of a surface.
    threads : int
        See `rholm.caller`.
    """
    return as_expansion(expansion).measure(threads=threads)


def directions_of(mesh: MeshLike, center: npt.ArrayLike) -> Mesh:
    """The directions of a mesh's vertices from a centre, with its triangles.

    Parameters
    ----------
    mesh : mesh-like
        No vertex lies on the centre.
    center : array_like, (3,)
        The centre.
    """
    return Mesh._of(_core.directions_of(as_mesh(mesh)._core, _triple(center, "center")))


def align(
    a: Expansion | CoefficientsLike,
    b: Expansion | CoefficientsLike,
    *,
    centers: Literal["volume", "own"] = "volume",
    start: Literal["correlation", "principal-axes"] = "correlation",
    bandwidth: int = 20,
    refine_degree: int = 64,
    margin: float = 0.01,
    mirror: bool = False,
    unknown: tuple[float, float] = (0.0, 0.0),
    threads: int = 0,
    progress: Progress = None,
) -> _core.Placement | _core.Alignment:
    """Turns a onto b: the rotation of the largest correlation.

    Parameters
    ----------
    a, b : Expansion or coefficients-like
        Two surfaces, or two functions on the sphere.
    centers : {"volume", "own"}
        Which points of surfaces are laid on each other first: centroids of the solids, or the
        centres of the expansions.
    start : {"correlation", "principal-axes"}
        Where the search begins: all rotations, or the four ways to lay axes on axes.
    bandwidth : int
        Degrees used by the search, 1 ... 64.
    refine_degree : int
        Degrees used by Newton's iteration.
    margin : float
        Other rotations are reported if their correlation is at most this below the best.
    mirror : bool
        Whether the mirror image of a is tried, too.
    unknown : (float, float)
        Root mean square over the sphere of what is not known of a and b.
    threads, progress
        See `rholm.caller`.

    Returns
    -------
    placement : Placement
        Of two expansions; `placed` moves a by it. An `Alignment` of two functions.
    """
    options = align_options(start, bandwidth, refine_degree, margin, mirror, unknown)
    with caller(threads, progress) as how:
        if isinstance(a, Expansion) and isinstance(b, Expansion):
            return _core.align(a._core, b._core, centers, options, how)
        return _core.align(core_of(a), core_of(b), options, how)


def placed(
    a: Expansion, placement: _core.Placement, *, threads: int = 0, progress: Progress = None
) -> Expansion:
    """The expansion moved as `align` says.

    Parameters
    ----------
    a : Expansion
        That was aligned.
    placement : Placement
        Of `align`.
    threads, progress
        See `rholm.caller`.
    """
    with caller(threads, progress) as how:
        return Expansion._of(_core.placed(as_expansion(a)._core, placement, how))


def surface_of(shape: Any, threads: int = 0, progress: Progress = None) -> Mesh:
    """The surface of whatever has one: a mesh-like, an expansion, an atlas, a reconstruction."""
    from ._atlas import Atlas, Reconstruction

    if isinstance(shape, Expansion):
        return shape.mesh(threads=threads, progress=progress)
    if isinstance(shape, Atlas):
        return shape.mesh(threads=threads, progress=progress)
    if isinstance(shape, Reconstruction):
        return shape.mesh
    if isinstance(shape, (str, os.PathLike)) and _core.is_model_file(os.fspath(shape)):
        return surface_of(load(shape), threads, progress)
    return as_mesh(shape)


def compare(
    a: Any,
    b: Any,
    *,
    samples: int = 200_000,
    seed: int = 1,
    threshold: float = 0.01,
    threads: int = 0,
    progress: Progress = None,
) -> _core.Comparison:
    """Two-sided distance between surfaces, by exact closest points of random samples.

    Parameters
    ----------
    a, b : mesh-like, Expansion, Atlas or Reconstruction
        Two surfaces.
    samples : int
        On each surface, area-weighted.
    seed : int
        Of the samples.
    threshold : float
        Of the F-score, as a fraction of the diagonal of a's bounding box.
    threads, progress
        See `rholm.caller`.
    """
    options = _core.CompareOptions(samples=samples, seed=seed, threshold=threshold)
    first, second = (surface_of(s, threads, progress) for s in (a, b))
    with caller(threads, progress) as how:
        return _core.compare(first._core, second._core, options, how)
