"""One surface as coefficients."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Literal, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import whole
from ._arrays import FloatArray, float_row, floats, plain_array, read_only, triple
from ._arrays import directions as unit_rows
from ._coefficients import (
    Function,
    Normalization,
    SpectrumKind,
    SpectrumUnit,
    array_of,
    core_of,
    from_convention,
    power_spectrum,
)
from ._errors import InvalidInputError, UnsupportedError
from ._formats import coefficients_formats
from ._interop import to_pyshtools, to_xarray
from ._primitives import directions_for
from ._rotations import RotationLike, as_rotation
from ._run import Progress, caller, named
from ._shapes import Mesh, MeshLike
from ._tables import Described

if TYPE_CHECKING:
    import matplotlib.axes
    import pyshtools
    import xarray

    from ._tables import Window


class Expansion(Described):
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
        function: Function = "radius",
        unit: str = "",
        method: str = "",
    ) -> None:
        self._core = _core.Expansion(core_of(coeffs), function, triple(center, "center"), unit, method)
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
        Condon-Shortley phase), (2, L+1, L+1), in the unit of lengths. Read-only: `to_array` gives an
        array that can be changed, and `rholm.from_array` makes an expansion of it.
        """
        return read_only(self.to_array())

    def to_array(self, normalization: Normalization = "4pi", csphase: int = 1) -> FloatArray:
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
        """Of the expansion, in the coordinates of the shape, (3,); read-only."""
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
    def gravity(self) -> _core.GravityField | None:
        """What the coefficients of a gravity field are relative to: its ``gravity_constant``, G M in
        m^3/s^2, and its ``reference_radius`` in m; None if not known. Set by `with_gravity`.
        """
        return self._core.gravity

    @property
    def method(self) -> str:
        """How the coefficients were found; empty if not known."""
        return self._core.method

    @property
    def errors(self) -> _core.TruncationErrors | None:
        """How far the surface is from the shape it was made of; None if not known. After `truncate`,
        `filter` and `recenter` what follows without the shape: see there.
        """
        return self._core.errors

    @property
    def precision(self) -> float | None:
        """Relative error that the coefficients were computed with, of the mean and in l2 of all others
        together; of random points three deviations. None if not known: `rms_beyond` then assumes 1e-8.
        """
        return self._core.precision

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
    def signed_sum(self) -> bool:
        """Whether it is the signed sum of the radii of a surface that is not star-shaped.

        Such an expansion does not give back the body: its descriptors (`volume` and so on), `centroid`
        and `mean_radius` are None.
        """
        return self._core.signed_sum

    @property
    def mean_radius(self) -> float | None:
        """Mean of r over directions, of a gauge 1 / the mean of 1/r. None for a signed sum."""
        if self.signed_sum:
            return None
        mean = float(self._core.coefficients.values[0, 0, 0]) / float(np.sqrt(4 * np.pi))
        return 1 / mean if self.function == "gauge" else mean

    @property
    def centroid(self) -> FloatArray | None:
        """Of the solid, in the coordinates of the shape, (3,). None for a signed sum."""
        return self.measure().centroid

    def measure(self, *, threads: int = 0) -> _core.SurfaceMeasures:
        """All descriptors and the centroid in one go.

        Parameters
        ----------
        threads : int
            See `rholm.caller`.
        """
        self._require_surface()
        with caller(threads, False) as how:
            return _core.measure(self._core, how)

    def inertia(self, *, threads: int = 0) -> FloatArray:
        """Tensor of inertia of the solid about its centroid; see `rholm.inertia`.

        Parameters
        ----------
        threads : int
            See `rholm.caller`.
        """
        self._require_surface()
        with caller(threads, False) as how:
            return _core.inertia(self._core, how)

    def spectrum(
        self,
        kind: SpectrumKind = "power",
        unit: SpectrumUnit = "per_l",
        base: float = 10.0,
    ) -> FloatArray:
        """Spectrum by degree, l = 0 ... L, (L+1,), in the squared unit of lengths.

        Parameters
        ----------
        kind, unit, base
            As in `rholm.power_spectrum`, but that "power", as pyshtools has it, is the default.
        """
        return power_spectrum(self._core.coefficients, kind, unit, base)

    def rms_beyond(self) -> FloatArray:
        """What is left out when the series ends at each degree, l = 0 ... L, (L+1,).

        Returns
        -------
        rms : float64, (L+1,)
            Root mean square over all directions of what lies above degree l, by Parseval's identity,
            in the function's unit. NaN where it is not known: without `norm_squared`, and where it
            is below what the `precision` of the coefficients tells (1e-8 if that is not known). The last
            one is the truncation error of the expansion itself.
        """
        return _core.rms_beyond(self._core)

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
        wanted = [
            whole(degree, "meshes(): a degree") for degree in np.atleast_1d(plain_array(degrees, "degrees"))
        ]
        self._require_surface()
        highest = min(max(wanted, default=0), self.degree)
        sphere = directions_for(highest, subdivisions, grid, like, self.center)
        with caller(threads, progress) as how:
            meshes = _core.synthesize(self._core, sphere, wanted, how)
        return [Mesh._of(mesh) for mesh in meshes]

    # Operations

    def truncate(self, degree: int) -> Expansion:
        """The series cut off at a degree; unchanged from its own degree on.

        Parameters
        ----------
        degree : int
            The highest that stays.

        Returns
        -------
        expansion : Expansion
            Of the errors, those of a radius have ``rms``: the energy of what is cut off adds to it.
        """
        return Expansion._of(_core.truncated(self._core, degree), shape=self._shape, name=self._name)

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
        at = triple(about, "about")
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
        return Expansion._of(_core.mirror(self._core, axis, triple(about, "about")))

    def filter(self, gains: npt.ArrayLike, name: str = "filter") -> Expansion:
        """Each degree times a factor.

        Parameters
        ----------
        gains : array_like, (n,)
            Of the degrees from 0 on, as `low_pass` makes them; degrees beyond have gain 0.
        name : str
            Says what was done; added to `method`.

        Returns
        -------
        expansion : Expansion
            Of the errors, those of a radius have ``rms``, to which sum (1 - g_l)^2 E_l adds.
        """
        return Expansion._of(_core.filter(self._core, floats(gains, "gains"), name))

    def low_pass(
        self, cutoff: int, window: Window = "lanczos", *, order: int = 4, time: float | None = None
    ) -> Expansion:
        """The surface without the degrees above a cutoff: `filter` by the gains of `rholm.low_pass`.

        Parameters
        ----------
        cutoff, window, order, time
            As in `rholm.low_pass`.

        Returns
        -------
        expansion : Expansion
            Cut off at the cutoff; "heat" keeps all degrees. What was done is added to `method`.
        """
        given = {"order": order, "time": time}
        in_place_of_cutoff = [
            given[one["name"]]
            for row in _core.windows()
            for one in row["parameters"]
            if row["name"] == window and one["replaces_cutoff"] and given[one["name"]] is not None
        ]
        name = f"{window} {in_place_of_cutoff[0]:g}" if in_place_of_cutoff else f"low-pass {cutoff} {window}"
        return self.filter(_core.low_pass(cutoff, self.degree, window, order, time), name)

    def recenter(
        self, center: npt.ArrayLike | None = None, *, threads: int = 0, progress: Progress = None
    ) -> Expansion:
        """The same surface as seen from another centre, of the same degree.

        Parameters
        ----------
        center : array_like, (3,), optional
            By default the centroid of the solid, or as near to it as the whole surface is seen: see
            `rholm.seen_center`.
        threads, progress
            See `rholm.caller`.

        Returns
        -------
        expansion : Expansion
            Of the errors, only the diagonal of the shape is known: `rholm.truncation_errors` of the
            shape measures them about the new centre.
        """
        with caller(threads, progress) as how:
            if center is None:
                at = _core.seen_center(self._core, _core.volume_centroid(self._core, how), how)
            else:
                at = float_row(center, "center")
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
        return Expansion._of(self._core.with_unit(unit), self._encoded, self._shape, self._name)

    def with_gravity(self, gravity_constant: float, reference_radius: float) -> Expansion:
        """The same numbers as those of a gravity field relative to these two.

        `rotate`, `filter`, `truncate` and arithmetic keep them, and all formats of files but .npy.

        Parameters
        ----------
        gravity_constant : float
            G M in m^3/s^2.
        reference_radius : float
            Of the sphere about the centre, in m.

        Raises
        ------
        InvalidInputError
            For numbers that are not above 0, and an expansion whose function is not "other".
        """
        core = self._core.with_gravity(gravity_constant, reference_radius)
        return Expansion._of(core, self._encoded, self._shape, self._name)

    def principal_axes(self) -> _core.PrincipalAxes:
        """The axes of the coefficients of degree 2, longest first, about the expansion's centre; see
        `rholm.principal_axes`. Those of inertia are of `inertia`.
        """
        return _core.principal_axes(self._core.coefficients, self.function)

    def __add__(self, other: Expansion) -> Expansion:
        combined: Expansion = self._combined(other, 1)
        return combined

    def __sub__(self, other: Expansion) -> Expansion:
        combined: Expansion = self._combined(other, -1)
        return combined

    def __mul__(self, factor: float) -> Expansion:
        if not _is_number(factor):
            return NotImplemented
        self._require_linear("multiplied by a number")
        function = "radius" if self.function == "radius" and factor > 0 else "other"
        values = float(factor) * self._core.coefficients.values
        return self._linear(values, function, f"times {factor:g}", self.signed_sum, self.gravity)

    __rmul__ = __mul__

    def __truediv__(self, divisor: float) -> Expansion:
        if not _is_number(divisor):
            return NotImplemented
        if divisor == 0:
            raise ZeroDivisionError("an expansion is divided by 0")
        return self * (1 / float(divisor))

    def __neg__(self) -> Expansion:
        return self * -1.0

    __array_ufunc__ = None  # NumPy's numbers leave products to the operators above

    def _combined(self, other: Any, sign: int) -> Any:
        what = "added" if sign > 0 else "subtracted"
        if not isinstance(other, Expansion):
            return NotImplemented
        for one in (self, other):
            one._require_linear(what)
        if not np.array_equal(self.center, other.center):
            raise InvalidInputError(
                f"expansions about other centres cannot be {what}, {tuple(map(float, self.center))} and "
                f"{tuple(map(float, other.center))}: recenter() one of them first"
            )
        if self.unit != other.unit:
            raise InvalidInputError(
                f"an expansion in {self.unit or 'no unit'} and one in {other.unit or 'no unit'} cannot be "
                f"{what}: with_unit() or scale() first"
            )
        if self.gravity and other.gravity and self.gravity != other.gravity:
            raise InvalidInputError(
                f"gravity fields relative to {self.gravity} and {other.gravity} cannot be {what}: their "
                "coefficients are of different units"
            )
        degree = max(self.degree, other.degree)
        a, b = (one._core.coefficients.resized(degree).values for one in (self, other))
        # Radii add up to radii; what two of them differ by is a function that may be negative.
        surfaces = [self.function, other.function].count("radius")
        function = "radius" if surfaces and not (sign < 0 and other.function == "radius") else "other"
        signed = self.signed_sum or other.signed_sum
        method = "sum" if sign > 0 else "difference"
        gravity = self.gravity if self.gravity == other.gravity else None
        return self._linear(a + sign * b, function, method, signed, gravity)

    def _require_linear(self, what: str) -> None:
        if self.function == "gauge":
            raise UnsupportedError(
                f"a gauge, 1/r, cannot be {what}: its coefficients are not linear in the radius; expand() "
                "with another method, or scale()"
            )

    def _linear(
        self, values: FloatArray, function: str, method: str, signed: bool, gravity: _core.GravityField | None
    ) -> Expansion:
        coefficients = from_convention(values, "orthonormal")
        known = (function, tuple(self.center), self.unit, method)
        core = _core.Expansion(coefficients, *known, signed_sum=signed)
        if gravity is not None:
            core = core.with_gravity(gravity.gravity_constant, gravity.reference_radius)
        return Expansion._of(core)

    # To others

    def to_pyshtools(self, normalization: Normalization = "4pi", csphase: int = 1) -> pyshtools.SHCoeffs:
        """A `pyshtools.SHCoeffs` with these coefficients.

        Parameters
        ----------
        normalization : {"4pi", "orthonormal", "schmidt"}
            Of the result.
        csphase : {1, -1}
            Of the result.
        """
        return to_pyshtools(self, normalization, csphase)

    def to_xarray(self, normalization: Normalization = "4pi", csphase: int = 1) -> xarray.DataArray:
        """A `xarray.DataArray` with dimensions kind ("c", "s"), l and m, and what is known as attributes.

        Parameters
        ----------
        normalization, csphase
            Of the result.
        """
        return to_xarray(self, normalization, csphase)

    def save(
        self,
        path: str | os.PathLike[str],
        *,
        format: str | None = None,
        normalization: Normalization = "4pi",
        csphase: int = 1,
        gravity_constant: float | None = None,
        reference_radius: float | None = None,
    ) -> None:
        """Writes a model file (.h5: all that is known), or a file of coefficients.

        Parameters
        ----------
        path : path
            Its extension says the format: one of `rholm.coefficients_formats`.
        format : str, optional
            The format, whatever the extension: a name of `rholm.coefficients_formats`, or "hdf5" for "h5".
        normalization, csphase
            Of the numbers, in formats other than the model file.
        gravity_constant, reference_radius : float, optional
            As in `with_gravity`, which the file is then written of. All formats but .npy keep both, and
            other programs read them in .gfc.

        Raises
        ------
        IoError
            If it cannot be written; a file that was there is whole then.
        """
        target = os.fspath(path)
        kind = format or ("h5" if _core.is_model_name(target) else None)
        core = self._with_gravity(target, kind, gravity_constant, reference_radius)
        with caller(0, False) as how:
            if kind in ("h5", "hdf5"):
                _core.write_model(core, named(target, (".h5", ".hdf5"), "a model file"), how)
            else:
                _core.write_coefficients(core, target, format, normalization, csphase, how)

    def report_html(self, path: str | os.PathLike[str] | None = None, **options: Any) -> str:
        """All that is known on one page of HTML that needs no other file; see `rholm.report_html`."""
        from ._pictures import report_html

        return report_html(self, path, **options)

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
        from ._pictures import plot_spectrum

        drawn: matplotlib.axes.Axes = plot_spectrum(self, ax, **options)
        return drawn

    def __repr__(self) -> str:
        unit = f" {self.unit}" if self.unit else ""
        at = ", ".join(f"{x:.6g}" for x in self.center)
        field = ""
        if self.gravity is not None:
            field = f", GM {self.gravity.gravity_constant:.6g}, R {self.gravity.reference_radius:.6g}"
        return f"<rholm.Expansion: {self.function} to degree {self.degree}, center ({at}){unit}{field}>"

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Expansion):
            return NotImplemented
        return (
            self.function == other.function
            and bool(np.array_equal(self.center, other.center))
            and self.gravity == other.gravity
            and bool(np.array_equal(self._core.coefficients.values, other._core.coefficients.values))
        )

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> Any:
        # Without the shape it is of, which may be large, or of a type that cannot be pickled.
        return (Expansion._of, (self._core, self._encoded, None, self._name))

    def __copy__(self) -> Expansion:
        return Expansion._of(self._core, self._encoded, self._shape, self._name)

    def __deepcopy__(self, memo: dict[int, Any]) -> Expansion:
        return self.__copy__()  # nothing in it can be changed

    def _repr_png_(self) -> bytes | None:
        from ._pictures import notebook_png

        return notebook_png(self)

    def _repr_html_(self) -> str:
        from ._pictures import expansion_html

        return expansion_html(self)

    def _with_gravity(
        self, target: str, format: str | None, constant: float | None, radius: float | None
    ) -> _core.Expansion:
        """With what `save` was given, if it was and the format has room for it."""
        if constant is None and radius is None:
            return self._core
        if constant is None or radius is None:
            raise InvalidInputError("gravity_constant and reference_radius belong together: give both")
        written = format or _core.coefficients_format_of(target)
        for known in coefficients_formats():
            if known.name == written and "meaning" not in known.holds:
                raise UnsupportedError(
                    f"{target}: {known.title} files have no room for a gravity constant and a reference "
                    "radius"
                )
        return self.with_gravity(constant, radius)._core

    def _require_surface(self) -> None:
        _core.require_surface(self._core)


#: What stands for coefficients: an `Expansion`, pyshtools.SHCoeffs, or an array (2, L+1, L+1) in
#: pyshtools' default convention: 4 pi-normalised, without Condon-Shortley phase.
CoefficientsLike = Union[Expansion, npt.ArrayLike, Any]


def _is_number(value: Any) -> bool:
    """Whether a value is a real number that coefficients can be multiplied by."""
    return (
        isinstance(value, (int, float, np.number)) and bool(np.isreal(value)) and not isinstance(value, bool)
    )
