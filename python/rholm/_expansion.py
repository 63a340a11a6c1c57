"""A surface as coefficients."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Literal, Protocol, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import form, public, whole
from ._arrays import FloatArray, Rows, float_row, floats, plain_array, read_only, triple
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
from ._convert import MeshLike
from ._errors import InvalidInputError, UnsupportedError
from ._formats import coefficients_formats
from ._interop import required, to_pyshtools, to_xarray
from ._primitives import directions_for
from ._rotations import RotationLike, as_rotation
from ._run import Progress, caller, named
from ._shapes import Mesh
from ._shown import Reported
from ._tables import Described

if TYPE_CHECKING:
    import matplotlib.axes
    import pyshtools
    import xarray

    from ._tables import Window


@public
class Expansion(Described, Reported):
    """A surface x = center + r(u) u, u a direction, as coefficients of spherical harmonics.

    `expand`, `load`, `from_array` and `from_pyshtools` make expansions. Operations return new ones.

    Calling an expansion returns radii: ``s(directions)``.

    Examples
    --------
    >>> s = rholm.expand(rholm.icosphere(4), degree=4)
    >>> s.degree, round(float(s([0, 0, 1])), 1)
    (4, 1.0)
    """

    __slots__ = ("_core", "_expanded", "_name", "_shape")

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
        self._expanded: _core.Expanded | None = None
        self._shape: Any = None
        self._name = ""

    @classmethod
    def _of(cls, core: _core.Expansion, expanded: Any = None, shape: Any = None, name: str = "") -> Expansion:
        self = cls.__new__(cls)
        self._core = core
        self._expanded = expanded
        self._shape = shape
        self._name = name
        return self

    # Properties. "X | Any" stands for values that are missing only in rare cases, then None: type
    # checkers let users read their fields without a check.

    @property
    def degree(self) -> int:
        """Highest degree L."""
        return self._core.coefficients.degree

    @property
    def coeffs(self) -> FloatArray:
        """Coefficients in pyshtools' layout and default convention (4 pi-normalised, without
        Condon-Shortley phase), (2, L+1, L+1), in the unit of lengths. The array is read-only.
        `to_array` returns a writable array, and `rholm.from_array` makes an expansion of it.
        """
        return read_only(self.to_array())

    def to_array(self, normalization: Normalization = "4pi", csphase: int = 1) -> FloatArray:
        """Returns the coefficients as an array in a convention.

        Parameters
        ----------
        normalization : {"4pi", "orthonormal", "schmidt"}
            Mean square of each harmonic over the sphere: 1, 1/(4 pi), 1/(2l+1).
        csphase : {1, -1}
            Phase of the harmonics: -1 for the Condon-Shortley factor (-1)^m.

        Returns
        -------
        coefficients : float64, (2, L+1, L+1)
            Cosine plane, sine plane: ``[0, l, m]`` and ``[1, l, m]``.

        Examples
        --------
        >>> s = rholm.expand(rholm.bumpy_sphere(3), degree=4)
        >>> s.to_array("orthonormal", csphase=-1).shape
        (2, 5, 5)
        """
        return array_of(self._core.coefficients, normalization, csphase)

    @property
    def center(self) -> FloatArray:
        """Centre of the expansion, in the coordinates of the shape, (3,); read-only."""
        return self._core.center

    @property
    def function(self) -> str:
        """Meaning of the function: "radius" (r), "gauge" (1/r) or "other" (no surface, a gravity field)."""
        return self._core.function

    @property
    def unit(self) -> str:
        """Unit of lengths; empty if unknown."""
        return self._core.unit

    @property
    def gravity(self) -> _core.GravityField | Any:
        """Reference values of a gravity field: ``gravity_constant``, G M in m^3/s^2, and
        ``reference_radius`` in m. None if unknown. `with_gravity` sets them.
        """
        return self._core.gravity

    @property
    def method(self) -> str:
        """Method that computed the coefficients; empty if unknown."""
        return self._core.method

    @property
    def errors(self) -> _core.TruncationErrors | Any:
        """Distance of the surface from the original shape; None if unknown. After `truncate`,
        `filter` and `recenter` it holds the errors that follow without the shape: see there.
        """
        return self._core.errors

    @property
    def precision(self) -> float | None:
        """Relative error of the coefficients: of the mean, and in l2 of all others together. For
        Monte Carlo it is three deviations. None if unknown; `rms_beyond` then assumes 1e-8.
        """
        return self._core.precision

    @property
    def norm_squared(self) -> float | None:
        """Integral of f^2 over the sphere, of the expanded function with all its degrees; None if unknown."""
        return self._core.norm_squared

    @property
    def tail_strength(self) -> float | None:
        """S of the predicted tail of the spectrum, E_l = S / (pi l^4); None if unknown."""
        return self._core.tail_strength

    @property
    def expanded(self) -> _core.Expanded | Any:
        """Report of `expand`: centre, star check, times. None for other expansions."""
        return self._expanded

    @property
    def signed_sum(self) -> bool:
        """True for the signed sum of the radii of a surface that is not star-shaped.

        A signed sum does not represent the body: its descriptors (`volume` and so on), `centroid`
        and `mean_radius` are None.
        """
        return self._core.signed_sum

    @property
    def mean_radius(self) -> float | Any:
        """Mean of r over directions; for a gauge 1 / the mean of 1/r. None for a signed sum."""
        if self.signed_sum:
            return None
        mean = float(self._core.coefficients.values[0, 0, 0]) / float(np.sqrt(4 * np.pi))
        return 1 / mean if self.function == "gauge" else mean

    @property
    def centroid(self) -> FloatArray | Any:
        """Centroid of the solid, in the coordinates of the shape, (3,). None for a signed sum."""
        return self.measure().centroid

    def measure(self, *, threads: int = 0) -> _core.SurfaceMeasures:
        """Returns all descriptors and the centroid at once.

        Parameters
        ----------
        threads : int
            Number of threads; see ``help(rholm)``.

        Examples
        --------
        >>> s = rholm.expand(rholm.icosphere(4), degree=4)
        >>> round(s.measure().volume / (4 / 3 * np.pi), 1)
        1.0
        """
        self._require_surface()
        with caller(threads, False) as how:
            return _core.measure(self._core, how)

    def inertia(self, *, threads: int = 0) -> FloatArray:
        """Returns the tensor of inertia of the solid about its centroid; see `rholm.harmonics.inertia`.

        Parameters
        ----------
        threads : int
            Number of threads; see ``help(rholm)``.

        Examples
        --------
        >>> s = rholm.expand(rholm.icosphere(4), degree=4)
        >>> (s.inertia() / (8 / 15 * np.pi)).round(1) + 0.0
        array([[1., 0., 0.],
               [0., 1., 0.],
               [0., 0., 1.]])
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
        """Returns the spectrum per degree, l = 0 ... L, (L+1,), in the squared unit of lengths.

        Parameters
        ----------
        kind, unit, base
            As in `rholm.harmonics.power_spectrum`. The default is "power", as in pyshtools.

        Examples
        --------
        >>> s = rholm.expand(rholm.bumpy_sphere(3), degree=4)
        >>> s.spectrum().shape
        (5,)
        """
        return power_spectrum(self._core.coefficients, kind, unit, base)

    def rms_beyond(self) -> FloatArray:
        """Returns the truncation error of the series at each degree, l = 0 ... L, (L+1,).

        Returns
        -------
        rms : float64, (L+1,)
            Root mean square over all directions of the degrees above l, by Parseval's identity, in
            the function's unit. NaN where it is unknown: without `norm_squared`, and where it is
            below the resolution of `precision` (1e-8 if unknown). The last value is the truncation
            error of the expansion.

        Examples
        --------
        >>> s = rholm.expand(rholm.bumpy_sphere(3), degree=8)
        >>> bool(s.rms_beyond()[0] > s.rms_beyond()[8])
        True
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
        """Returns radii (values of the function if it is no surface) in directions from the centre.

        Parameters
        ----------
        directions : array_like, (..., 3)
            Directions, vectors of any length.
        precision : float
            Precision of the sums; see `rholm.harmonics.evaluate`.
        threads, progress
            See ``help(rholm)``.

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
        """Returns surface gradients of the radius on the unit sphere, tangential at each direction.

        Parameters
        ----------
        directions, precision, threads, progress
            As when the expansion is called.

        Returns
        -------
        gradients : float64, (..., 3)

        Examples
        --------
        >>> s = rholm.expand(rholm.bumpy_sphere(3), degree=4)
        >>> s.gradient([[0, 0, 1], [0, 1, 0]]).shape
        (2, 3)
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
        """Returns points of the surface in directions from the centre, (..., 3).

        Parameters
        ----------
        directions : array_like, (..., 3)
            Directions, vectors of any length.
        **options
            Arguments as when the expansion is called.

        Examples
        --------
        >>> s = rholm.expand(rholm.icosphere(4), degree=4)
        >>> s.points([0, 0, 2]).round(1) + 0.0
        array([0., 0., 1.])
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
        """Returns the surface as a mesh, with the exact unit normals of the surface.

        Parameters
        ----------
        subdivisions : int, optional
            Subdivisions of an icosphere with 20 * 4^n faces, 0 ... 12. By default about two
            vertices per coefficient, 4 ... 7.
        degree : int, optional
            Degree at which the series is truncated.
        grid : (n_theta, n_phi), optional
            Rings and meridians of a latitude-longitude sphere, used instead.
        like : mesh-like, optional
            Mesh whose directions and connectivity are used instead.
        threads, progress
            See ``help(rholm)``.

        Examples
        --------
        >>> s = rholm.expand(rholm.bumpy_sphere(3), degree=8)
        >>> s.mesh(subdivisions=2)
        <rholm.Mesh: 162 vertices, 320 faces, attributes nx, ny, nz>
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
        """Returns the surface truncated at several degrees, on the same directions: levels of
        detail.

        Parameters
        ----------
        degrees : array_like of int
            Degree of each mesh.
        subdivisions, grid, like, threads, progress
            As in `mesh`.

        Examples
        --------
        >>> s = rholm.expand(rholm.bumpy_sphere(3), degree=8)
        >>> len(s.meshes([2, 4, 8], subdivisions=2))
        3
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
        """Returns the series truncated at a degree; unchanged for its own degree or more.

        Parameters
        ----------
        degree : int
            Highest degree to keep.

        Returns
        -------
        expansion : Expansion
            Truncated expansion. For a radius ``errors.rms`` is kept, increased by the energy cut
            off.

        Examples
        --------
        >>> rholm.expand(rholm.bumpy_sphere(3), degree=8).truncate(3).degree
        3
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
        """Returns the surface rotated as a whole.

        Parameters
        ----------
        rotation : Rotation, matrix (3, 3), quaternion (4,), scipy's Rotation
            Rotation that takes the point x to R x.
        about : array_like, (3,)
            Fixed point of the rotation; the centre moves too.
        threads, progress
            See ``help(rholm)``.

        Examples
        --------
        >>> s = rholm.expand(rholm.bumpy_sphere(3), degree=8)
        >>> turned = s.rotate(rholm.rotation_about((0, 0, 1), np.pi / 2), about=s.center)
        >>> bool(np.isclose(turned([0, 1, 0]), s([1, 0, 0])))
        True
        """
        at = triple(about, "about")
        with caller(threads, progress) as how:
            return Expansion._of(_core.rotate(self._core, as_rotation(rotation), at, how))

    def mirror(self, axis: Literal["x", "y", "z"], about: npt.ArrayLike = (0.0, 0.0, 0.0)) -> Expansion:
        """Returns the mirror image in the plane through `about` across an axis.

        Parameters
        ----------
        axis : {"x", "y", "z"}
            The coordinate that changes its sign.
        about : array_like, (3,)
            A point of the plane.

        Examples
        --------
        >>> s = rholm.expand(rholm.bumpy_sphere(3), degree=8)
        >>> bool(np.isclose(s.mirror("x")([1, 0, 0]), s([-1, 0, 0])))
        True
        """
        return Expansion._of(_core.mirror(self._core, axis, triple(about, "about")))

    def filter(self, gains: npt.ArrayLike, name: str = "filter") -> Expansion:
        """Returns the expansion with each degree multiplied by a factor.

        Parameters
        ----------
        gains : array_like, (n,)
            Gains of the degrees from 0 on, for example from `low_pass`. Higher degrees have gain 0.
        name : str
            Name of the filter, which is added to `method`.

        Returns
        -------
        expansion : Expansion
            Filtered expansion. For a radius ``errors.rms`` is kept; 4 pi times its square grows by
            sum (1 - g_l)^2 E_l.

        Examples
        --------
        >>> s = rholm.expand(rholm.bumpy_sphere(3), degree=8)
        >>> ball = s.filter([1])
        >>> bool(ball.coeffs[0, 1:].any())
        False
        """
        return Expansion._of(_core.filter(self._core, floats(gains, "gains"), name))

    def low_pass(
        self, cutoff: int, window: Window = "lanczos", *, order: int = 4, time: float | None = None
    ) -> Expansion:
        """Returns the surface without degrees above a cutoff: `filter` with gains of
        `rholm.low_pass`.

        Parameters
        ----------
        cutoff, window, order, time
            As in `rholm.low_pass`.

        Returns
        -------
        expansion : Expansion
            Expansion truncated at the cutoff; "heat" keeps all degrees. The filter is added to
            `method`.

        Examples
        --------
        >>> s = rholm.expand(rholm.bumpy_sphere(3), degree=8)
        >>> s.low_pass(4).degree
        4
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
        """Returns the surface about another centre, with the same degree.

        Parameters
        ----------
        center : array_like, (3,), optional
            New centre. By default the centroid of the solid, or a point near it that sees the whole
            surface: see `rholm.harmonics.seen_center`.
        threads, progress
            See ``help(rholm)``.

        Returns
        -------
        expansion : Expansion
            Expansion about the new centre. Its errors contain only the diagonal of the shape;
            `rholm.harmonics.truncation_errors` with the shape measures the others.

        Examples
        --------
        >>> s = rholm.expand(rholm.bumpy_sphere(3), degree=8, center=(0, 0, 0))
        >>> bool(np.allclose(s.recenter().center, s.centroid))
        True
        """
        with caller(threads, progress) as how:
            if center is None:
                at = _core.seen_center(self._core, _core.volume_centroid(self._core, how), how)
            else:
                at = float_row(center, "center")
            return Expansion._of(_core.recentered(self._core, tuple(float(x) for x in at), how))

    def scale(self, factor: float, unit: str | None = None) -> Expansion:
        """Returns the expansion with all lengths multiplied by a factor.

        Parameters
        ----------
        factor : float
            Factor, above 0.
        unit : str, optional
            Name of the new unit.

        Examples
        --------
        >>> s = rholm.expand(rholm.icosphere(4), degree=4)
        >>> s.scale(1000, unit="m").unit
        'm'
        """
        scaled = Expansion._of(_core.scaled(self._core, factor))
        return scaled if unit is None else scaled.with_unit(unit)

    def with_unit(self, unit: str) -> Expansion:
        """Returns the expansion with the same numbers and another name of the unit.

        Parameters
        ----------
        unit : str
            Name of the unit: "km", "mm", ...

        Examples
        --------
        >>> rholm.expand(rholm.icosphere(3), degree=4).with_unit("km").unit
        'km'
        """
        return Expansion._of(self._core.with_unit(unit), self._expanded, self._shape, self._name)

    def with_gravity(self, gravity_constant: float, reference_radius: float) -> Expansion:
        """Returns the expansion as a gravity field with these reference values; the numbers stay.

        `rotate`, `filter`, `truncate` and arithmetic keep the values, and so do all file formats
        except .npy.

        Parameters
        ----------
        gravity_constant : float
            G M in m^3/s^2.
        reference_radius : float
            Radius of the sphere about the centre, in m.

        Raises
        ------
        InvalidInputError
            For numbers that are not above 0, or an expansion whose function is not "other".

        Examples
        --------
        >>> field = rholm.from_array(np.zeros((2, 3, 3)), function="other")
        >>> field.with_gravity(3.986004415e14, 6378136.3).gravity.reference_radius
        6378136.3
        """
        core = self._core.with_gravity(gravity_constant, reference_radius)
        return Expansion._of(core, self._expanded, self._shape, self._name)

    def principal_axes(self) -> _core.PrincipalAxes:
        """Returns the axes of the degree-2 coefficients, longest first, about the expansion's
        centre; see `rholm.harmonics.principal_axes`. `inertia` gives the axes of inertia.

        Examples
        --------
        >>> s = rholm.expand(rholm.ellipsoid((1, 2, 3), 4), degree=8)
        >>> np.abs(s.principal_axes().axes[0]).round(6)
        array([0., 0., 1.])
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

    __array_ufunc__ = None  # NumPy scalars leave products to the operators above

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
        # The sum of radii is a radius. The difference of two radii may be negative.
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

    # Conversions

    def to_pyshtools(self, normalization: Normalization = "4pi", csphase: int = 1) -> pyshtools.SHCoeffs:
        """Returns a `pyshtools.SHCoeffs` with these coefficients.

        Parameters
        ----------
        normalization : {"4pi", "orthonormal", "schmidt"}
            Normalization of the result.
        csphase : {1, -1}
            Phase convention of the result.

        Examples
        --------
        >>> s = rholm.expand(rholm.bumpy_sphere(3), degree=4)
        >>> s.to_pyshtools().lmax
        4
        """
        return to_pyshtools(self, normalization, csphase)

    def to_xarray(self, normalization: Normalization = "4pi", csphase: int = 1) -> xarray.DataArray:
        """Returns a `xarray.DataArray` with dimensions kind ("c", "s"), l and m; metadata are
        attributes.

        Parameters
        ----------
        normalization, csphase
            Convention of the result.

        Examples
        --------
        >>> s = rholm.expand(rholm.bumpy_sphere(3), degree=4)
        >>> s.to_xarray().dims
        ('kind', 'l', 'm')
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
        """Writes a model file (.h5, with all metadata), or a file of coefficients.

        Parameters
        ----------
        path : path
            File to write. The extension chooses one of `rholm.files.coefficients_formats`.
        format : str, optional
            Name of the format, used instead of the extension: from `rholm.files.coefficients_formats`, or
            "hdf5".
        normalization, csphase
            Convention of the numbers, in formats other than the model file.
        gravity_constant, reference_radius : float, optional
            Reference values, as in `with_gravity`, for the file. All formats except .npy store
            both; other programs read them from .gfc files.

        Raises
        ------
        IoError
            If the file cannot be written. An existing file is unchanged then.

        Examples
        --------
        >>> s = rholm.expand(rholm.bumpy_sphere(3), degree=4)
        >>> s.save("body.h5")
        >>> rholm.load("body.h5") == s
        True
        """
        target = os.fspath(path)
        kind = format or ("h5" if _core.is_model_name(target) else None)
        core = self._with_gravity(target, kind, gravity_constant, reference_radius)
        with caller(0, False) as how:
            if kind in ("h5", "hdf5"):
                _core.write_model(core, named(target, (".h5", ".hdf5"), "a model file"), how)
            else:
                _core.write_coefficients(core, target, format, normalization, csphase, how)

    def spectrum_svg(self, title: str = "", tolerance: float | None = None) -> str:
        """Returns the spectrum on logarithmic scales as an SVG document; see `rholm.figures.spectrum_svg`.

        Examples
        --------
        >>> s = rholm.expand(rholm.bumpy_sphere(3), degree=4)
        >>> "<svg" in s.spectrum_svg("A body")
        True
        """
        return _core.spectrum_svg(self._core, title or self._name, tolerance)

    def plot_spectrum(self, ax: matplotlib.axes.Axes | None = None, **options: Any) -> matplotlib.axes.Axes:
        """Plots the energy per degree on logarithmic scales, with the predicted tail, in
        matplotlib.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Axes to draw in; by default a new figure.
        **options
            Arguments of ``Axes.loglog``.

        Examples
        --------
        >>> import matplotlib
        >>> matplotlib.use("agg")
        >>> axes = rholm.expand(rholm.bumpy_sphere(3), degree=4).plot_spectrum()
        >>> axes.get_xlabel()
        'degree l'
        """
        if ax is None:
            _, ax = required("matplotlib.pyplot", "matplotlib").subplots()
            assert ax is not None
        degrees = np.arange(1, self.degree + 1)
        ax.loglog(degrees, self.spectrum("energy")[1:], **{"label": self._name or "energy", **options})
        if self.tail_strength is not None and self.degree > 0:
            tail = self.tail_strength / (np.pi * degrees**4.0)
            ax.loglog(degrees, tail, ":", color="0.5", label="predicted tail")
        ax.legend()
        ax.set_xlabel("degree l")
        ax.set_ylabel(f"energy per degree [{self.unit}²]" if self.unit else "energy per degree")
        return ax

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
        # The shape is left out: it may be large, or of a type that cannot be pickled.
        return (Expansion._of, (self._core, self._expanded, None, self._name))

    def __copy__(self) -> Expansion:
        return Expansion._of(self._core, self._expanded, self._shape, self._name)

    def __deepcopy__(self, memo: dict[int, Any]) -> Expansion:
        return self.__copy__()  # nothing in it can be changed

    def _with_gravity(
        self, target: str, format: str | None, constant: float | None, radius: float | None
    ) -> _core.Expansion:
        """Returns the expansion with the gravity values of `save`, if given. Raises
        UnsupportedError if the format cannot store them.
        """
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


class HasCoefficients(Protocol):
    """Coefficients with their convention, as pyshtools has them."""

    @property
    def coeffs(self) -> Any: ...


#: Coefficients: an `Expansion`, pyshtools.SHCoeffs, or an array (2, L+1, L+1) in pyshtools' default
#: convention: 4 pi-normalised, without Condon-Shortley phase.
CoefficientsLike = Union[Expansion, _core.Coefficients, Rows, HasCoefficients]

form(CoefficientsLike, "coefficients: an Expansion, or an array (2, L+1, L+1)")


def _is_number(value: Any) -> bool:
    """Returns True for a real number that coefficients can be multiplied by."""
    return (
        isinstance(value, (int, float, np.number)) and bool(np.isreal(value)) and not isinstance(value, bool)
    )
