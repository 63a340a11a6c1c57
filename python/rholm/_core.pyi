"""The C++ library; use rholm itself."""

from collections.abc import Mapping, Sequence
import os
import pathlib
from typing import Annotated, Any, overload

import numpy
import numpy.typing
from numpy.typing import NDArray


VERSION: str = '0.2.0'

MAX_DEGREE: int = 16384

NO_CAP: int = 4294967295

ERRORS: tuple = ...

class Caller:
    """Threads and progress of one call."""

    def __init__(self, threads: int, progress: object | None) -> None: ...

def after_fork_in_child() -> None:
    """
    Tells the library that it is in a child of fork(), where there are no threads.
    """

class Mesh:
    """Triangles that share vertices."""

    def __init__(self, arg0: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], arg1: Annotated[NDArray[numpy.uint32], dict(shape=(None, 3), order='C', device='cpu', writable=False)], arg2: Sequence[tuple[str, str, Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)]]], /) -> None: ...

    def __getstate__(self) -> tuple: ...

    def __setstate__(self, arg: object, /) -> None: ...

    @property
    def vertices(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)]: ...

    @property
    def triangles(self) -> Annotated[NDArray[numpy.uint32], dict(writable=False)]: ...

    @property
    def attributes(self) -> list: ...

    def __eq__(self, arg: object, /) -> bool: ...

class PointCloud:
    """Points without faces."""

    def __init__(self, arg0: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], arg1: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)] | None, arg2: Sequence[tuple[str, str, Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)]]], /) -> None: ...

    def __getstate__(self) -> tuple: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    @property
    def points(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)]: ...

    @property
    def normals(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)] | None: ...

    @property
    def attributes(self) -> list: ...

@overload
def validate(arg: Mesh, /) -> None: ...

@overload
def validate(arg: PointCloud, /) -> None: ...

def shape_formats() -> list: ...

def is_shape_file(arg0: bytes, arg1: str, /) -> bool | None: ...

def read_shape(arg0: str, arg1: bool, arg2: str, arg3: Caller, /) -> tuple: ...

def parse_shape(arg0: bytes, arg1: str, arg2: bool, arg3: str, arg4: Caller, /) -> tuple: ...

def points_of_rows(arg0: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], arg1: int, arg2: str, /) -> tuple: ...

def write_shape(arg0: Mesh | PointCloud, arg1: str, arg2: str | None, arg3: bool, arg4: Caller, /) -> list[str]: ...

def attributes_left_out(arg0: Sequence[str], arg1: str, /) -> list[str]: ...

class MappedMesh:
    """A mesh where it lies in a file."""

    @property
    def vertex_bytes(self) -> Annotated[NDArray[numpy.uint8], dict(writable=False)]: ...

    @property
    def vertex_layout(self) -> tuple: ...

    @property
    def triangle_bytes(self) -> Annotated[NDArray[numpy.uint8], dict(writable=False)]: ...

    @property
    def triangle_layout(self) -> tuple: ...

def map_mesh(arg0: str, arg1: Caller, /) -> MappedMesh | None: ...

class Bounds:
    """A box along the axes."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """All fields by name; records within it are dicts, too."""

    @property
    def min(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)]:
        """The corner with the smallest coordinates."""

    @property
    def max(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)]:
        """The corner with the largest coordinates."""

    @property
    def diagonal(self) -> float:
        """Its length."""

class Inspection:
    """
    What a mesh is. Counts are those of the mesh given: weld first to close seams.
    """

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """All fields by name; records within it are dicts, too."""

    @property
    def vertices(self) -> int:
        """Number of vertices, used or not."""

    @property
    def triangles(self) -> int:
        """Number of triangles, with an area or not."""

    @property
    def edges(self) -> int:
        """Pairs of vertices that a triangle joins."""

    @property
    def boundary_edges(self) -> int:
        """Edges in one triangle only."""

    @property
    def non_manifold_edges(self) -> int:
        """Edges in three triangles or more."""

    @property
    def misoriented_edges(self) -> int:
        """Edges in two triangles that run through them in the same sense."""

    @property
    def non_manifold_vertices(self) -> int:
        """Vertices whose triangles do not form one fan."""

    @property
    def isolated_vertices(self) -> int:
        """Vertices in no triangle."""

    @property
    def degenerate_triangles(self) -> int:
        """Triangles thinner than the rounding of their coordinates."""

    @property
    def duplicate_triangles(self) -> int:
        """Triangles with the three vertices of an earlier one."""

    @property
    def components(self) -> int:
        """Parts connected through edges."""

    @property
    def euler_characteristic(self) -> int:
        """Used vertices - edges + triangles."""

    @property
    def genus(self) -> int:
        """Handles, of all parts together; of closed manifold meshes."""

    @property
    def closed(self) -> bool:
        """No boundary edge, at least one triangle."""

    @property
    def manifold(self) -> bool:
        """No non-manifold edge or vertex."""

    @property
    def oriented(self) -> bool:
        """No misoriented edge."""

    @property
    def inside_out(self) -> bool:
        """Closed and oriented, but the enclosed volume is negative."""

    @property
    def bounds(self) -> Bounds:
        """Box around all vertices."""

    @property
    def area(self) -> float:
        """Of all triangles, in the squared unit of the vertices."""

    @property
    def volume(self) -> float:
        """Signed, of closed oriented meshes, in the cubed unit."""

    @property
    def vertex_centroid(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)]:
        """Mean of the used vertices."""

    @property
    def volume_centroid(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)]:
        """Of the solid, if it is closed and its volume is not zero."""

class RepairReport:
    """Report of a repair: changes, and defects that remain."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """All fields by name; records within it are dicts, too."""

    @property
    def before(self) -> Inspection:
        """State of the mesh welded exactly."""

    @property
    def merged_vertices(self) -> int:
        """Vertices merged by welding."""

    @property
    def collapsed_triangles(self) -> int:
        """Triangles of which welding made two corners one."""

    @property
    def isolated_vertices(self) -> int:
        """Vertices dropped: in no triangle."""

    @property
    def duplicate_triangles(self) -> int:
        """Triangles dropped: same vertices as an earlier one."""

    @property
    def degenerate_triangles(self) -> int:
        """Triangles thinner than rounding, dropped or swapped."""

    @property
    def junctions(self) -> int:
        """Vertices on edges of others' triangles (T-junctions), joined."""

    @property
    def flipped_triangles(self) -> int:
        """Triangles that were turned."""

    @property
    def inside_out_parts(self) -> int:
        """Closed parts that were turned as a whole."""

    @property
    def cavities(self) -> int:
        """Closed parts within another: they face inwards."""

    @property
    def split_vertices(self) -> int:
        """New vertices where sheets met in one."""

    @property
    def closed_holes(self) -> int:
        """Holes closed by new triangles."""

    @property
    def hole_triangles(self) -> int:
        """Triangles put into them."""

    @property
    def large_holes(self) -> int:
        """Holes left: more edges than allowed."""

    @property
    def largest_hole(self) -> int:
        """Edges of the largest of these."""

    @property
    def sheets(self) -> int:
        """Holes left: borders of open sheets."""

    @property
    def one_sided_parts(self) -> int:
        """Parts left without an orientation (Moebius strips)."""

    @property
    def closes_at(self) -> float | None:
        """
        Tolerance of welding that would join the borders left; none if none would.
        """

    @property
    def after(self) -> Inspection:
        """State of the result, welded exactly."""

def weld(arg0: Mesh, arg1: float, /) -> tuple: ...

def pair_edges(arg: Mesh, /) -> NDArray[numpy.uint32]: ...

def cut_polygons(arg0: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], arg1: Annotated[NDArray[numpy.uint32], dict(shape=(None, None), order='C', device='cpu', writable=False)], /) -> NDArray[numpy.uint32]: ...

def bounds(arg: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], /) -> Bounds: ...

def inspect(arg: Mesh, /) -> Inspection: ...

def outward(arg: Mesh, /) -> Mesh: ...

def closing_tolerance(arg: Mesh, /) -> float | None: ...

def largest_component(arg: Mesh, /) -> Mesh: ...

def flip(arg: Mesh, /) -> Mesh: ...

def area_normals(arg: Mesh, /) -> NDArray[numpy.float64]: ...

def surface_area(arg: Mesh, /) -> float: ...

def enclosed_volume(arg: Mesh, /) -> float: ...

class RepairOptions:
    """Steps of the repair of a mesh."""

    def __init__(self, **fields: Any) -> None: ...

    def __repr__(self) -> str: ...

    @property
    def weld(self) -> float: ...

    @weld.setter
    def weld(self, arg: float | None, /) -> None: ...

    @property
    def max_hole(self) -> int: ...

    @max_hole.setter
    def max_hole(self, arg: int | None, /) -> None: ...

    FIELDS: tuple = ...

def repair(arg0: Mesh, arg1: RepairOptions, arg2: Caller, /) -> tuple: ...

class SimplifyOptions:
    """Where simplify() stops."""

    def __init__(self, **fields: Any) -> None: ...

    def __repr__(self) -> str: ...

    @property
    def triangles(self) -> int: ...

    @triangles.setter
    def triangles(self, arg: int | None, /) -> None: ...

    @property
    def share(self) -> float: ...

    @share.setter
    def share(self, arg: float | None, /) -> None: ...

    @property
    def max_error(self) -> float: ...

    @max_error.setter
    def max_error(self, arg: float | None, /) -> None: ...

    FIELDS: tuple = ...

def simplify(arg0: Mesh, arg1: SimplifyOptions, arg2: Caller, /) -> tuple: ...

def icosphere(arg: int, /) -> Mesh: ...

def latitude_longitude_sphere(arg0: int, arg1: int, /) -> Mesh: ...

def ellipsoid(arg0: Sequence[float] | numpy.typing.NDArray[numpy.float64], arg1: int, /) -> Mesh: ...

def box(arg0: Sequence[float] | numpy.typing.NDArray[numpy.float64], arg1: int, /) -> Mesh: ...

def torus(arg0: float, arg1: float, arg2: int, arg3: int, /) -> Mesh: ...

def bumpy_sphere(arg0: int, arg1: float, arg2: int, /) -> Mesh: ...

class SampleOptions:
    """Errors, outliers and places of the samples of a surface."""

    def __init__(self, **fields: Any) -> None: ...

    def __repr__(self) -> str: ...

    @property
    def points(self) -> int: ...

    @points.setter
    def points(self, arg: int | None, /) -> None: ...

    @property
    def noise(self) -> float: ...

    @noise.setter
    def noise(self, arg: float | None, /) -> None: ...

    @property
    def normal_noise(self) -> float: ...

    @normal_noise.setter
    def normal_noise(self, arg: float | None, /) -> None: ...

    @property
    def outliers(self) -> float: ...

    @outliers.setter
    def outliers(self, arg: float | None, /) -> None: ...

    @property
    def holes(self) -> int: ...

    @holes.setter
    def holes(self, arg: int | None, /) -> None: ...

    @property
    def hole_radius(self) -> float: ...

    @hole_radius.setter
    def hole_radius(self, arg: float | None, /) -> None: ...

    @property
    def density_ratio(self) -> float: ...

    @density_ratio.setter
    def density_ratio(self, arg: float | None, /) -> None: ...

    @property
    def pattern(self) -> str: ...

    @pattern.setter
    def pattern(self, arg: str, /) -> None: ...

    @property
    def pattern_ratio(self) -> float: ...

    @pattern_ratio.setter
    def pattern_ratio(self, arg: float | None, /) -> None: ...

    @property
    def pattern_axis(self) -> numpy.typing.NDArray[numpy.float64]: ...

    @pattern_axis.setter
    def pattern_axis(self, arg: Sequence[float] | numpy.typing.NDArray[numpy.float64] | None, /) -> None: ...

    @property
    def scans(self) -> int: ...

    @scans.setter
    def scans(self, arg: int | None, /) -> None: ...

    @property
    def misalignment(self) -> float: ...

    @misalignment.setter
    def misalignment(self, arg: float | None, /) -> None: ...

    @property
    def scan_noise(self) -> float: ...

    @scan_noise.setter
    def scan_noise(self, arg: float | None, /) -> None: ...

    @property
    def sensor(self) -> bool: ...

    @sensor.setter
    def sensor(self, arg: bool | None, /) -> None: ...

    @property
    def normals(self) -> bool: ...

    @normals.setter
    def normals(self, arg: bool | None, /) -> None: ...

    @property
    def seed(self) -> int: ...

    @seed.setter
    def seed(self, arg: int | None, /) -> None: ...

    FIELDS: tuple = ...

def sample_surface(arg0: Mesh, arg1: SampleOptions, arg2: Caller, /) -> PointCloud: ...

class CleanReport:
    """Report of clean()."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """All fields by name; records within it are dicts, too."""

    @property
    def points(self) -> int:
        """Number of points before."""

    @property
    def not_finite(self) -> int:
        """Points dropped: a coordinate was NaN or infinite."""

    @property
    def duplicates(self) -> int:
        """Points dropped: at the place of an earlier one."""

    @property
    def opposite_normals(self) -> int:
        """Of these, with a normal against the earlier one's."""

    @property
    def zero_normals(self) -> int:
        """Of the points that stay, those with a zero normal."""

def clean(arg0: PointCloud, arg1: Caller, /) -> tuple: ...

class ScanAlignment:
    """Report of align_scans(); lengths are in the unit of the points."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """All fields by name; records within it are dicts, too."""

    @property
    def scans(self) -> int:
        """Different values of the attribute; 0 without one."""

    @property
    def pairs(self) -> int:
        """Points of one scan that were compared with those of another."""

    @property
    def distance_before(self) -> float:
        """
        Of these pairs along the normal, as a standard deviation, before anything moved.
        """

    @property
    def distance(self) -> float:
        """The same after."""

    @property
    def moved(self) -> float:
        """Root mean square way of all points."""

def align_scans(arg0: PointCloud, arg1: Caller, /) -> tuple: ...

class OrientOptions:
    """How normals are found and which side is outside."""

    def __init__(self, **fields: Any) -> None: ...

    def __repr__(self) -> str: ...

    @property
    def neighbors(self) -> int: ...

    @neighbors.setter
    def neighbors(self, arg: int | None, /) -> None: ...

    @property
    def keep_directions(self) -> bool: ...

    @keep_directions.setter
    def keep_directions(self, arg: bool | None, /) -> None: ...

    @property
    def center(self) -> numpy.typing.NDArray[numpy.float64] | None: ...

    @center.setter
    def center(self, arg: Sequence[float] | numpy.typing.NDArray[numpy.float64] | None, /) -> None: ...

    @property
    def sensor(self) -> numpy.typing.NDArray[numpy.float64] | None: ...

    @sensor.setter
    def sensor(self, arg: Sequence[float] | numpy.typing.NDArray[numpy.float64] | None, /) -> None: ...

    @property
    def keep_outliers(self) -> bool: ...

    @keep_outliers.setter
    def keep_outliers(self, arg: bool | None, /) -> None: ...

    @property
    def confidence(self) -> bool: ...

    @confidence.setter
    def confidence(self, arg: bool | None, /) -> None: ...

    FIELDS: tuple = ...

class OrientReport:
    """Report of orient(), with its certainty."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """All fields by name; records within it are dicts, too."""

    @property
    def points(self) -> int:
        """Points given."""

    @property
    def duplicates(self) -> int:
        """Points at the place of an earlier one, whose normal they share."""

    @property
    def neighbors(self) -> int:
        """Points of a fit."""

    @property
    def components(self) -> int:
        """Parts of the graph of neighbours; 0 with a centre or a sensor."""

    @property
    def computed(self) -> int:
        """Normals whose direction is new."""

    @property
    def flipped(self) -> int:
        """Normals that were turned round."""

    @property
    def outliers(self) -> int:
        """Points far from all others, which took the normal of the nearest."""

    @property
    def undetermined(self) -> int:
        """Points whose neighbours lie on a line: their normals are zero."""

    @property
    def mean_confidence(self) -> float:
        """
        Mean over the points: a sign is right with the probability (1 + confidence) / 2.
        """

    @property
    def unsure(self) -> float:
        """Share of the points with a confidence below 0.5."""

def orient(arg0: PointCloud, arg1: OrientOptions, arg2: Caller, /) -> tuple: ...

class Coefficients:
    """
    C_lm and S_lm in the library's own convention: orthonormal, without Condon-Shortley phase.
    """

    def __init__(self, arg: int, /) -> None: ...

    def __getstate__(self) -> NDArray[numpy.float64]: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    @property
    def degree(self) -> int: ...

    @property
    def values(self) -> NDArray[numpy.float64]: ...

    def resized(self, arg: int, /) -> Coefficients: ...

def to_convention(arg0: Coefficients, arg1: str, arg2: int, /) -> Coefficients: ...

def from_convention(arg0: Annotated[NDArray[numpy.float64], dict(shape=(2, None, None), order='C', device='cpu', writable=False)], arg1: str, arg2: int, /) -> Coefficients: ...

def power_spectrum(arg: Coefficients, /) -> NDArray[numpy.float64]: ...

class TruncationErrors:
    """
    How far a surface is from the shape it was made of, in the unit of lengths; None where it is not known.
    """

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """All fields by name; records within it are dicts, too."""

    @property
    def rms(self) -> float | None:
        """Radial, root mean square over solid angle."""

    @property
    def rms_is_exact(self) -> bool:
        """Whether rms is by Parseval's identity, not measured."""

    @property
    def predicted_max(self) -> float | None:
        """Largest radial error at the vertices, in closed form."""

    @property
    def predicted_max_distance(self) -> float | None:
        """The same as a distance."""

    @property
    def measured_max(self) -> float | None:
        """Largest radial error at `points` points of the shape."""

    @property
    def max_bound(self) -> float | None:
        """
        No radial error is larger, by branch and bound; None for a gauge, or beyond the diagonal.
        """

    @property
    def measured_max_distance(self) -> float | None:
        """The same as a distance."""

    @property
    def distance_rms(self) -> float | None:
        """Root mean square of distances over area, the larger of both ways."""

    @property
    def distances_are_closest(self) -> bool:
        """Whether distances are by closest points."""

    @property
    def points(self) -> int:
        """At which was measured."""

    @property
    def diagonal(self) -> float:
        """Of the shape's bounding box; 0 if not known."""

class GravityField:
    """References of the coefficients of a gravity field."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """All fields by name; records within it are dicts, too."""

    @property
    def gravity_constant(self) -> float:
        """G M in m^3/s^2."""

    @property
    def reference_radius(self) -> float:
        """Of the sphere about the centre, in m."""

class Expansion:
    """A surface as coefficients."""

    def __init__(self, coefficients: Coefficients, function: str = 'radius', center: Sequence[float] | numpy.typing.NDArray[numpy.float64] = (0.0, 0.0, 0.0), unit: str = '', method: str = '', norm_squared: float | None = None, tail_strength: float | None = None, errors: TruncationErrors | None = None, signed_sum: bool = False) -> None: ...

    def __getstate__(self) -> tuple: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    @property
    def coefficients(self) -> Coefficients: ...

    @property
    def function(self) -> str: ...

    @property
    def center(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)]: ...

    @property
    def unit(self) -> str: ...

    def with_unit(self, arg: str, /) -> Expansion: ...

    def with_gravity(self, arg0: float, arg1: float, /) -> Expansion: ...

    @property
    def gravity(self) -> GravityField | None: ...

    @property
    def method(self) -> str: ...

    @property
    def precision(self) -> float | None: ...

    @property
    def norm_squared(self) -> float | None: ...

    @property
    def tail_strength(self) -> float | None: ...

    @property
    def errors(self) -> TruncationErrors | None: ...

    @property
    def signed_sum(self) -> bool: ...

def require_surface(arg: Expansion, /) -> None: ...

def require_star_shaped(arg0: Expansion, arg1: str, /) -> None: ...

def check_unit(arg: str, /) -> None: ...

def metres_of(arg: str, /) -> float | None: ...

def scaled(arg0: Expansion, arg1: float, /) -> Expansion: ...

def truncated(arg0: Expansion, arg1: int, /) -> Expansion: ...

def windows() -> list: ...

def low_pass(arg0: int, arg1: int, arg2: str, arg3: int, arg4: float | None, /) -> NDArray[numpy.float64]: ...

def high_pass(arg0: int, arg1: int, arg2: str, arg3: int, arg4: float | None, /) -> NDArray[numpy.float64]: ...

def band_pass(arg0: int, arg1: int, arg2: int, arg3: str, arg4: int, arg5: float | None, /) -> NDArray[numpy.float64]: ...

def sharpened(arg0: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], arg1: float, /) -> NDArray[numpy.float64]: ...

@overload
def filter(arg0: Coefficients, arg1: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], /) -> Coefficients: ...

@overload
def filter(arg0: Expansion, arg1: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], arg2: str, /) -> Expansion: ...

class Overshoot:
    """How far a filtered step leaves 0 ... 1, in parts of its height."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """All fields by name; records within it are dicts, too."""

    @property
    def above(self) -> float:
        """Largest value - 1."""

    @property
    def below(self) -> float:
        """Minus the smallest value."""

@overload
def overshoot(arg: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], /) -> Overshoot: ...

@overload
def overshoot(arg0: str, arg1: int, /) -> Overshoot: ...

def read_coefficients(arg0: str, arg1: str, arg2: int, arg3: bool, arg4: Caller, /) -> tuple: ...

def read_any_coefficients(arg0: str, arg1: str, arg2: int, arg3: bool, arg4: Caller, /) -> tuple: ...

def parse_coefficients(arg0: bytes, arg1: str, arg2: str, arg3: int, arg4: bool, arg5: Caller, /) -> tuple: ...

def coefficients_format_of(arg: str, /) -> str | None: ...

def coefficients_formats() -> list: ...

def is_model_name(arg: str, /) -> bool: ...

def looks_like_coefficients(arg: bytes, /) -> bool: ...

def write_coefficients(arg0: Expansion, arg1: str, arg2: str | None, arg3: str, arg4: int, arg5: Caller, /) -> None: ...

def write_model(arg0: Expansion, arg1: str, arg2: Caller, /) -> None: ...

def read_model(arg0: str, arg1: Caller, /) -> Expansion: ...

def is_model_file(arg: str, /) -> bool: ...

def evaluate(arg0: Coefficients, arg1: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], arg2: str, arg3: float, arg4: Caller, /) -> NDArray[numpy.float64]: ...

def evaluate_with_gradient(arg0: Coefficients, arg1: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], arg2: str, arg3: float, arg4: Caller, /) -> tuple: ...

def adjoint(arg0: int, arg1: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], arg2: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)] | None, arg3: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)] | None, arg4: Annotated[NDArray[numpy.float64], dict(shape=(None, 6), order='C', device='cpu', writable=False)] | None, arg5: str, arg6: float, arg7: Caller, /) -> Coefficients: ...

def gauss_legendre(arg: int, /) -> tuple: ...

def exact_degree(arg0: str, arg1: int, arg2: int, /) -> int: ...

def smallest_grid(arg0: str, arg1: int, /) -> tuple: ...

def grid_colatitudes(arg0: str, arg1: int, /) -> NDArray[numpy.float64]: ...

def synthesize_grid(arg0: Coefficients, arg1: str, arg2: int, arg3: int, arg4: Caller, /) -> NDArray[numpy.float64]: ...

def analyze_grid(arg0: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], arg1: str, arg2: int, arg3: int, arg4: int, arg5: Caller, /) -> Coefficients: ...

def evaluate_rings(arg0: Coefficients, arg1: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], arg2: int, arg3: Caller, /) -> NDArray[numpy.float64]: ...

class Rotation:
    """A unit quaternion; the same rotation as its negative."""

    def __init__(self, w: float = 1.0, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> None: ...

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """All fields by name; records within it are dicts, too."""

    @property
    def w(self) -> float:
        """cos(a/2), a the angle."""

    @property
    def x(self) -> float:
        """sin(a/2) times the axis."""

    @property
    def y(self) -> float:
        """sin(a/2) times the axis."""

    @property
    def z(self) -> float:
        """sin(a/2) times the axis."""

def rotation_about(arg0: Sequence[float] | numpy.typing.NDArray[numpy.float64], arg1: float, /) -> Rotation: ...

def rotation_of_euler(arg0: float, arg1: float, arg2: float, /) -> Rotation: ...

def rotation_of_matrix(arg: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], /) -> Rotation: ...

def axis_angle_of(arg: Rotation, /) -> tuple: ...

def euler_angles_of(arg: Rotation, /) -> tuple: ...

def matrix_of(arg: Rotation, /) -> NDArray[numpy.float64]: ...

def compose(arg0: Rotation, arg1: Rotation, /) -> Rotation: ...

def inverse(arg: Rotation, /) -> Rotation: ...

def angle_between(arg0: Rotation, arg1: Rotation, /) -> float: ...

@overload
def rotate(arg0: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], arg1: Rotation, /) -> NDArray[numpy.float64]: ...

@overload
def rotate(arg0: Coefficients, arg1: Rotation, arg2: Caller, /) -> Coefficients: ...

@overload
def rotate(arg0: Expansion, arg1: Rotation, arg2: Sequence[float] | numpy.typing.NDArray[numpy.float64], arg3: Caller, /) -> Expansion: ...

@overload
def mirror(arg0: Coefficients, arg1: str, /) -> Coefficients: ...

@overload
def mirror(arg0: Expansion, arg1: str, arg2: Sequence[float] | numpy.typing.NDArray[numpy.float64], /) -> Expansion: ...

class PrincipalAxes:
    """The axes of the quadratic form of degree 2."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """All fields by name; records within it are dicts, too."""

    @property
    def axes(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)]:
        """Rows: right-handed, orthonormal, longest first, (3, 3)."""

    @property
    def values(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)]:
        """Of the form, descending, (3,); their sum is 0."""

    @property
    def to_axes(self) -> Rotation:
        """Turns the axes to x, y and z."""

    @property
    def free_axes(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)]:
        """About these the form turns freely: none, one or three, (n, 3)."""

def principal_axes(arg0: Coefficients, arg1: str, /) -> PrincipalAxes: ...

class AlignOptions:
    """How a rotation is sought."""

    def __init__(self, **fields: Any) -> None: ...

    def __repr__(self) -> str: ...

    @property
    def start(self) -> str: ...

    @start.setter
    def start(self, arg: str, /) -> None: ...

    @property
    def bandwidth(self) -> int: ...

    @bandwidth.setter
    def bandwidth(self, arg: int | None, /) -> None: ...

    @property
    def refine_degree(self) -> int: ...

    @refine_degree.setter
    def refine_degree(self, arg: int | None, /) -> None: ...

    @property
    def margin(self) -> float: ...

    @margin.setter
    def margin(self, arg: float | None, /) -> None: ...

    @property
    def mirror(self) -> bool: ...

    @mirror.setter
    def mirror(self, arg: bool | None, /) -> None: ...

    @property
    def unknown_a(self) -> float: ...

    @unknown_a.setter
    def unknown_a(self, arg: float | None, /) -> None: ...

    @property
    def unknown_b(self) -> float: ...

    @unknown_b.setter
    def unknown_b(self, arg: float | None, /) -> None: ...

    FIELDS: tuple = ...

class AlignedRotation:
    """A rotation of a, and how well it lays a on b."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """All fields by name; records within it are dicts, too."""

    @property
    def rotation(self) -> Rotation:
        """Of the mirror image, if mirrored."""

    @property
    def mirrored(self) -> bool:
        """Whether the reflection x -> -x comes first; y and z stay."""

    @property
    def correlation(self) -> float:
        """Of degrees from 1 on, normalised: 1 is equal up to a factor."""

    @property
    def distance(self) -> float:
        """Root mean square of R a - b over the sphere, all degrees."""

class Alignment:
    """The best rotation, and those that are nearly as good."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """All fields by name; records within it are dicts, too."""

    @property
    def best(self) -> AlignedRotation:
        """Of several that are equal the smallest turn."""

    @property
    def ambiguities(self) -> list[AlignedRotation]:
        """
        Others that are nearly as good, best first, at most 32: symmetries of the shape.
        """

    @property
    def free_axes(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)]:
        """Axes in the frame of b about which turning changes nothing, (n, 3)."""

    @property
    def unaligned_distance(self) -> float:
        """Before any rotation."""

class Placement:
    """
    The point p becomes R (p - from_point) + to_point, of the mirror image if mirrored.
    """

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """All fields by name; records within it are dicts, too."""

    @property
    def alignment(self) -> Alignment:
        """R and whether it is mirrored."""

    @property
    def from_point(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)]:
        """The point of a that is laid on b's, (3,)."""

    @property
    def to_point(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)]:
        """The point of b, (3,)."""

    @property
    def centers(self) -> str:
        """
        Which points these are: "volume", the centroids, or "own", the centres of the expansions.
        """

    @property
    def why_own(self) -> str:
        """
        Why the centroids could not be taken; empty if they were, or not asked for.
        """

@overload
def align(arg0: Coefficients, arg1: Coefficients, arg2: AlignOptions, arg3: Caller, /) -> Alignment: ...

@overload
def align(arg0: Expansion, arg1: Expansion, arg2: str, arg3: AlignOptions, arg4: Caller, /) -> Placement: ...

def placed(arg0: Expansion, arg1: Placement, arg2: Caller, /) -> Expansion: ...

def distance(arg0: Coefficients, arg1: Coefficients, /) -> float: ...

def descriptor_distance(arg0: Coefficients, arg1: Coefficients, /) -> float: ...

def volume_centroid(arg0: Expansion, arg1: Caller, /) -> numpy.typing.NDArray[numpy.float64]: ...

def seen_center(arg0: Expansion, arg1: Sequence[float] | numpy.typing.NDArray[numpy.float64], arg2: Caller, /) -> numpy.typing.NDArray[numpy.float64]: ...

def recentered(arg0: Expansion, arg1: Sequence[float] | numpy.typing.NDArray[numpy.float64], arg2: Caller, /) -> Expansion: ...

class TransformOptions:
    """Function to expand, and method."""

    def __init__(self, **fields: Any) -> None: ...

    def __repr__(self) -> str: ...

    @property
    def degree(self) -> int: ...

    @degree.setter
    def degree(self, arg: int | None, /) -> None: ...

    @property
    def method(self) -> str: ...

    @method.setter
    def method(self, arg: str, /) -> None: ...

    @property
    def engine(self) -> str: ...

    @engine.setter
    def engine(self, arg: str, /) -> None: ...

    @property
    def precision(self) -> float: ...

    @precision.setter
    def precision(self, arg: float | None, /) -> None: ...

    FIELDS: tuple = ...

class Tolerance:
    """The largest error that is allowed."""

    def __init__(self, **fields: Any) -> None: ...

    def __repr__(self) -> str: ...

    @property
    def error(self) -> float: ...

    @error.setter
    def error(self, arg: float | None, /) -> None: ...

    @property
    def unit(self) -> str: ...

    @unit.setter
    def unit(self, arg: str, /) -> None: ...

    @property
    def norm(self) -> str: ...

    @norm.setter
    def norm(self, arg: str, /) -> None: ...

    @property
    def measure(self) -> str: ...

    @measure.setter
    def measure(self, arg: str, /) -> None: ...

    @property
    def max_degree(self) -> int: ...

    @max_degree.setter
    def max_degree(self, arg: int | None, /) -> None: ...

    FIELDS: tuple = ...

class CenterOptions:
    """Where the centre is sought."""

    def __init__(self, **fields: Any) -> None: ...

    def __repr__(self) -> str: ...

    @property
    def center(self) -> str: ...

    @center.setter
    def center(self, arg: str, /) -> None: ...

    @property
    def point(self) -> numpy.typing.NDArray[numpy.float64]: ...

    @point.setter
    def point(self, arg: Sequence[float] | numpy.typing.NDArray[numpy.float64] | None, /) -> None: ...

    @property
    def rays(self) -> int: ...

    @rays.setter
    def rays(self, arg: int | None, /) -> None: ...

    FIELDS: tuple = ...

def parse_center(arg: str, /) -> CenterOptions: ...

class ChartOptions:
    """Rules for the centre, and for surfaces that are not star-shaped."""

    def __init__(self, **fields: Any) -> None: ...

    def __repr__(self) -> str: ...

    @property
    def center(self) -> CenterOptions: ...

    @center.setter
    def center(self, arg: CenterOptions | None, /) -> None: ...

    @property
    def signed(self) -> bool: ...

    @signed.setter
    def signed(self, arg: bool | None, /) -> None: ...

    FIELDS: tuple = ...

class ExpandOptions:
    """Degree, precision and error figures of an expansion."""

    def __init__(self, **fields: Any) -> None: ...

    def __repr__(self) -> str: ...

    @property
    def degree(self) -> int: ...

    @degree.setter
    def degree(self, arg: int | None, /) -> None: ...

    @property
    def method(self) -> str: ...

    @method.setter
    def method(self, arg: str, /) -> None: ...

    @property
    def engine(self) -> str: ...

    @engine.setter
    def engine(self, arg: str, /) -> None: ...

    @property
    def precision(self) -> float: ...

    @precision.setter
    def precision(self, arg: float | None, /) -> None: ...

    @property
    def tolerance(self) -> Tolerance | None: ...

    @tolerance.setter
    def tolerance(self, arg: Tolerance | None, /) -> None: ...

    @property
    def errors(self) -> bool: ...

    @errors.setter
    def errors(self, arg: bool | None, /) -> None: ...

    @property
    def chart(self) -> ChartOptions: ...

    @chart.setter
    def chart(self, arg: ChartOptions | None, /) -> None: ...

    @property
    def weld(self) -> float: ...

    @weld.setter
    def weld(self, arg: float | None, /) -> None: ...

    FIELDS: tuple = ...

class StarReport:
    """How a mesh is seen from a centre."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """All fields by name; records within it are dicts, too."""

    @property
    def center(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)]:
        """In the coordinates of the mesh, (3,)."""

    @property
    def min_d(self) -> float:
        """Distance of the nearest face plane; negative if a face turns its back."""

    @property
    def min_cos_gamma(self) -> float:
        """Over all corners of all triangles."""

    @property
    def bad_triangles(self) -> int:
        """Triangles that turn their backs."""

    @property
    def star_shaped(self) -> bool:
        """No such triangle, and every direction covered once."""

    @property
    def rays(self) -> int:
        """Directions tried."""

    @property
    def once_share(self) -> float:
        """Part of them that meet the surface once."""

    @property
    def multiple_share(self) -> float:
        """Part that meet it more than once."""

    @property
    def missed_share(self) -> float:
        """Part that never meet it."""

    @property
    def center_fell_back(self) -> bool:
        """Whether no point sees all faces, and the centre is the best guess."""

def find_center(arg0: Mesh, arg1: CenterOptions, arg2: Caller, /) -> StarReport: ...

def check_star(arg0: Mesh, arg1: Sequence[float] | numpy.typing.NDArray[numpy.float64], arg2: int, arg3: Caller, /) -> StarReport: ...

class StarChart:
    """A mesh seen from a centre."""

    def __getstate__(self) -> tuple: ...

    def __setstate__(self, arg: object, /) -> None: ...

    @property
    def mesh(self) -> Mesh: ...

    @property
    def report(self) -> StarReport: ...

def make_star_chart(arg0: Mesh, arg1: ChartOptions, arg2: Caller, /) -> StarChart: ...

class FastReport:
    """How the fast engine did it."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """All fields by name; records within it are dicts, too."""

    @property
    def single(self) -> bool:
        """Whether sources were spread in single precision."""

    @property
    def width(self) -> int:
        """Grid points of the window."""

    @property
    def oversampling(self) -> float:
        """Of the grid."""

    @property
    def lumped_triangles(self) -> int:
        """Triangles whose sources are those of their vertices."""

    @property
    def nodes(self) -> int:
        """Sources of their own."""

    @property
    def vertices(self) -> int:
        """Sources at vertices."""

    @property
    def error(self) -> float:
        """
        Of the coefficients, l2 over degrees from 1 on, relative to the norm without mean.
        """

    @property
    def band_error(self) -> float:
        """Of the degrees above 3L/4 relative to their own norm."""

    @property
    def measured_share(self) -> float:
        """
        Part of the triangles that errors were measured on: 1 by a second, finer reading, less on a sample; 0 where they are estimates.
        """

    @property
    def error_doubt(self) -> float:
        """By how much more a measured error may be off."""

    @property
    def passes(self) -> int:
        """Over the triangles until the coefficients were found."""

    @property
    def reached(self) -> bool:
        """Whether the error is within the precision."""

class Transform:
    """How coefficients were found."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """All fields by name; records within it are dicts, too."""

    @property
    def edge_nodes(self) -> int:
        """Quadrature nodes on edges."""

    @property
    def face_nodes(self) -> int:
        """Quadrature nodes on faces."""

    @property
    def closure_residual(self) -> float | None:
        """
        Zero for a closed, consistently oriented mesh; None with the fast engine.
        """

    @property
    def fast(self) -> FastReport | None:
        """Of the fast engine, or None."""

    @property
    def precision(self) -> float:
        """That the coefficients were wanted with."""

    @property
    def times(self) -> dict:
        """Stages: (wall, cpu) in seconds."""

    @property
    def truncation_rms(self) -> float | None:
        """
        Truncation error over solid angle, in the unit of the function, or None.
        """

    @property
    def truncation_rms_doubt(self) -> float | None:
        """How far it is at most from that of exact coefficients."""

    @property
    def expansion(self) -> Expansion: ...

class ToleranceReport:
    """How a tolerance was kept."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """All fields by name; records within it are dicts, too."""

    @property
    def allowed(self) -> float:
        """Error, in the mesh's unit."""

    @property
    def reached(self) -> float:
        """Error, in the mesh's unit."""

    @property
    def met(self) -> bool:
        """Whether reached is at most allowed."""

    @property
    def degrees(self) -> list[int]:
        """That were tried; the model's is the last one, or cut off from it."""

class Expanded:
    """What was found out on the way from a mesh to an expansion."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """All fields by name; records within it are dicts, too."""

    @property
    def transform(self) -> Transform:
        """How the coefficients were found."""

    @property
    def tolerance(self) -> ToleranceReport | None:
        """How the tolerance was kept, or None."""

    @property
    def star(self) -> StarReport:
        """The centre, and how well it sees the surface."""

    @property
    def diagonal(self) -> float:
        """Of the bounding box."""

    @property
    def vertices(self) -> int:
        """After welding, where that was needed."""

    @property
    def faces(self) -> int:
        """Likewise."""

    @property
    def edges(self) -> int:
        """Likewise."""

    @property
    def merged_vertices(self) -> int:
        """By welding."""

    @property
    def collapsed_triangles(self) -> int:
        """By welding."""

    @property
    def flipped(self) -> bool:
        """Whether the mesh was inside out."""

    @property
    def times(self) -> dict:
        """Stages: (wall, cpu) in seconds."""

def expand_mesh(arg0: Annotated[NDArray, dict(shape=(None, 3), device='cpu', writable=False)], arg1: Annotated[NDArray[numpy.uint32], dict(shape=(None, 3), device='cpu', writable=False)], arg2: ExpandOptions, arg3: Caller, /) -> Expanded: ...

def expand_file(arg0: str, arg1: ExpandOptions, arg2: Caller, /) -> tuple: ...

def expand_chart(arg0: StarChart, arg1: TransformOptions, arg2: Caller, /) -> Transform: ...

def expand_chart_to_tolerance(arg0: StarChart, arg1: Tolerance, arg2: TransformOptions, arg3: Caller, /) -> tuple: ...

def radius_norm_squared(arg: StarChart, /) -> float: ...

def gauge_norm_squared(arg: StarChart, /) -> float: ...

def tail_strength(arg0: StarChart, arg1: str, /) -> float: ...

def vertex_error_strength(arg0: StarChart, arg1: str, /) -> float: ...

class ErrorStrengths:
    """The largest truncation errors at vertices, times 2 pi (L + 1)."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """All fields by name; records within it are dicts, too."""

    @property
    def radius(self) -> float:
        """Of the radius, in the mesh's unit."""

    @property
    def gauge(self) -> float:
        """Of 1/r, in 1/unit."""

    @property
    def distance(self) -> float:
        """Of the distance between the surfaces."""

def vertex_error_strengths(arg0: Mesh, arg1: Sequence[float] | numpy.typing.NDArray[numpy.float64], /) -> ErrorStrengths: ...

def rms_beyond(arg: Expansion, /) -> NDArray[numpy.float64]: ...

def truncation_errors(arg0: Mesh, arg1: Expansion, arg2: float | None, arg3: bool, arg4: Caller, /) -> TruncationErrors: ...

class MonteCarloOptions:
    """How much is wanted, and when to stop."""

    def __init__(self, **fields: Any) -> None: ...

    def __repr__(self) -> str: ...

    @property
    def degree(self) -> int: ...

    @degree.setter
    def degree(self, arg: int | None, /) -> None: ...

    @property
    def places(self) -> str: ...

    @places.setter
    def places(self, arg: str, /) -> None: ...

    @property
    def seed(self) -> int: ...

    @seed.setter
    def seed(self, arg: int | None, /) -> None: ...

    @property
    def samples(self) -> int | None: ...

    @samples.setter
    def samples(self, arg: int | None, /) -> None: ...

    @property
    def deviation(self) -> float: ...

    @deviation.setter
    def deviation(self, arg: float | None, /) -> None: ...

    @property
    def most_samples(self) -> int: ...

    @most_samples.setter
    def most_samples(self, arg: int | None, /) -> None: ...

    FIELDS: tuple = ...

class MonteCarlo:
    """Coefficients by random points, and how far they may be off."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """All fields by name; records within it are dicts, too."""

    @property
    def places(self) -> int:
        """Edges or triangles that were sampled."""

    @property
    def samples(self) -> int:
        """Points on each of them."""

    @property
    def rounds(self) -> int:
        """Rounds in which they were added."""

    @property
    def relative_deviation(self) -> float | None:
        """
        Standard error relative to the coefficients without the mean; none if too few points tell.
        """

    @property
    def reached(self) -> bool:
        """Whether the wanted deviation is reached."""

    @property
    def degree_deviation(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)]:
        """For each degree the standard error of its coefficients together."""

    @property
    def truncation_rms(self) -> float | None:
        """Root mean square of what degrees above L would add."""

    @property
    def truncation_rms_doubt(self) -> float | None:
        """How far that may be off, by 3 deviations."""

    @property
    def times(self) -> dict:
        """Seconds of each stage."""

    @property
    def expansion(self) -> Expansion: ...

    @property
    def deviation(self) -> Coefficients: ...

def monte_carlo(arg0: StarChart, arg1: MonteCarloOptions, arg2: Caller, /) -> MonteCarlo: ...

def synthesize(arg0: Expansion, arg1: Mesh, arg2: Sequence[int], arg3: Caller, /) -> list: ...

def directions_of(arg0: Mesh, arg1: Sequence[float] | numpy.typing.NDArray[numpy.float64], /) -> Mesh: ...

class SurfaceMeasures:
    """Of the solid bounded by a surface."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """All fields by name; records within it are dicts, too."""

    @property
    def volume(self) -> float | None:
        """
        The volume of the solid that the surface bounds; exact for a radius, in the unit of length to the power 3. None for a signed sum.
        """

    @property
    def area(self) -> float | None:
        """
        The area of the surface, to about 1e-12, in the unit of length to the power 2. None for a signed sum.
        """

    @property
    def sphericity(self) -> float | None:
        """
        The area of the ball of the same volume over the area of the surface, at most 1 (Wadell 1935). None for a signed sum.
        """

    @property
    def centroid(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)] | None:
        """Of the solid, (3,)."""

def descriptors() -> list: ...

def measure(arg0: Expansion, arg1: Caller, /) -> SurfaceMeasures: ...

def inertia(arg0: Expansion, arg1: Caller, /) -> NDArray[numpy.float64]: ...

class CompareOptions:
    """Where distances are measured."""

    def __init__(self, **fields: Any) -> None: ...

    def __repr__(self) -> str: ...

    @property
    def samples(self) -> int: ...

    @samples.setter
    def samples(self, arg: int | None, /) -> None: ...

    @property
    def seed(self) -> int: ...

    @seed.setter
    def seed(self, arg: int | None, /) -> None: ...

    @property
    def threshold(self) -> float: ...

    @threshold.setter
    def threshold(self, arg: float | None, /) -> None: ...

    FIELDS: tuple = ...

class Distances:
    """Of all samples, in the shape's unit."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """All fields by name; records within it are dicts, too."""

    @property
    def rms(self) -> float:
        """Root mean square."""

    @property
    def mean(self) -> float:
        """Mean."""

    @property
    def max(self) -> float:
        """Largest."""

class Comparison:
    """How far two surfaces lie apart, in the shape's unit."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """All fields by name; records within it are dicts, too."""

    @property
    def samples(self) -> int:
        """Points on each surface."""

    @property
    def seed(self) -> int:
        """That they were drawn with."""

    @property
    def diagonal(self) -> float:
        """Of A's bounding box."""

    @property
    def a_to_b(self) -> Distances:
        """From samples of A to their closest points on B."""

    @property
    def b_to_a(self) -> Distances:
        """From samples of B to their closest points on A."""

    @property
    def hausdorff(self) -> float:
        """
        Larger of the two largest distances: a lower bound of the Hausdorff distance.
        """

    @property
    def threshold(self) -> float:
        """Of the F-score."""

    @property
    def precision(self) -> float:
        """Share of B's samples within the threshold of A."""

    @property
    def recall(self) -> float:
        """Share of A's samples within the threshold of B."""

    @property
    def f_score(self) -> float:
        """Harmonic mean of precision and recall."""

    @property
    def normal_median_degrees(self) -> float:
        """
        Median of the angle between the normal at a sample and that at its closest point, 0 ... 180.
        """

    @property
    def normal_mean_degrees(self) -> float:
        """Mean of that angle."""

def compare(arg0: Mesh, arg1: Mesh, arg2: CompareOptions, arg3: Caller, /) -> Comparison: ...

def distances_to_surface(arg0: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], arg1: Mesh, arg2: Caller, /) -> NDArray[numpy.float64]: ...

class Cap:
    """One cap of an atlas."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """All fields by name; records within it are dicts, too."""

    @property
    def center(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)]:
        """Of its sphere, in the coordinates of the shape, (3,)."""

    @property
    def axes(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)]:
        """Of its frame, rows x, y, z; z points outwards, (3, 3)."""

    @property
    def radius(self) -> float:
        """Of its sphere."""

    @property
    def dilation(self) -> float:
        """a: tan(theta'/2) = a tan(theta/2) opens the sphere."""

    @property
    def support(self) -> float:
        """Radius of the points around the seed that it was made of."""

    @property
    def seed(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)]:
        """The point of the sphere in the middle of the cap, (3,)."""

    @property
    def ellipse(self) -> tuple:
        """Of its support: middle (px, py) and form (xx, xy, yy)."""

    @property
    def basis(self) -> str:
        """Which harmonics it uses."""

    @property
    def degree(self) -> int:
        """Its highest degree."""

    @property
    def first(self) -> int:
        """Where its coefficients start."""

    @property
    def error(self) -> float:
        """Root mean square distance of the fitted points to it."""

    @property
    def area(self) -> float:
        """Of the surface that it was made for."""

    @property
    def weight(self) -> float:
        """A factor of its blend weight."""

    @property
    def deviation(self) -> float:
        """Largest distance of its surface from the tangent plane of the seed."""

class Atlas:
    """A surface of any genus as overlapping caps."""

    def __getstate__(self) -> object: ...

    def __setstate__(self, arg: object, /) -> None: ...

    @property
    def n_caps(self) -> int: ...

    def cap(self, arg: int, /) -> Cap: ...

    def coefficients_of(self, arg: int, /) -> NDArray[numpy.float64]: ...

    @property
    def blend(self) -> str: ...

    @property
    def spacing(self) -> float: ...

    @property
    def noise(self) -> float: ...

    @property
    def diagonal(self) -> float: ...

    @property
    def band(self) -> float: ...

def highest_degree(arg: Atlas, /) -> int: ...

def n_coefficients(arg0: str, arg1: int, /) -> int: ...

def evaluate_cap(arg0: Atlas, arg1: int, arg2: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], /) -> tuple: ...

class SurfaceRules:
    """
    How `reconstruct` made the surface of its caps; an atlas with them makes the same again.
    """

    def __getstate__(self) -> tuple: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __repr__(self) -> str: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """All fields by name; records within it are dicts, too."""

    @property
    def holes(self) -> str:
        """'fill': places without points are closed; 'keep': cut open."""

    @property
    def min_component(self) -> float:
        """Parts with less than this share of the largest one's area are dropped."""

    @property
    def simplified(self) -> bool:
        """Whether the surface has fewer triangles than its grid gave."""

    @property
    def tiles(self) -> bool:
        """
        Whether it was made in several tiles: `Atlas.mesh` has another order of vertices and faces, and what closes holes may differ by some steps of the grid.
        """

    @property
    def left_out(self) -> list[str]:
        """
        Attributes of the surface from the points, which the atlas does not hold.
        """

class AtlasErrors:
    """What a model is measured by, in the shape's unit."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """All fields by name; records within it are dicts, too."""

    @property
    def rms_from(self) -> float:
        """Root mean square distance from the shape to the model's surface."""

    @property
    def max_from(self) -> float:
        """Largest of these distances."""

    @property
    def rms_to(self) -> float:
        """
        Root mean square distance from the model's surface to the shape; 0 if that is points.
        """

    @property
    def max_to(self) -> float:
        """Largest of these distances; 0 if the shape is points."""

    @property
    def rms(self) -> float:
        """The larger of both ways."""

    @property
    def max(self) -> float:
        """The larger of both ways."""

    @property
    def two_sided(self) -> bool:
        """Whether both ways were measured."""

class AtlasSize:
    """How large a model is."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """All fields by name; records within it are dicts, too."""

    @property
    def caps(self) -> int:
        """Number of caps."""

    @property
    def coefficients(self) -> int:
        """Coefficients that are not zero."""

    @property
    def frame_numbers(self) -> int:
        """Numbers of the caps' frames."""

    @property
    def numbers(self) -> int:
        """Of the whole model."""

class AtlasModel:
    """An atlas and what its file says of it."""

    def __getstate__(self) -> tuple: ...

    def __setstate__(self, arg: object, /) -> None: ...

    @property
    def atlas(self) -> Atlas: ...

    @property
    def step(self) -> float: ...

    @property
    def tolerance(self) -> float: ...

    @property
    def errors(self) -> AtlasErrors | None: ...

    @property
    def input_numbers(self) -> int: ...

    @property
    def unit(self) -> str: ...

    @property
    def method(self) -> str: ...

    @property
    def rules(self) -> SurfaceRules | None: ...

    def with_unit(self, arg: str, /) -> AtlasModel: ...

def size_of(arg: Atlas, /) -> AtlasSize: ...

def write_atlas(arg0: AtlasModel, arg1: str, arg2: Caller, /) -> None: ...

def read_atlas(arg0: str, arg1: Caller, /) -> AtlasModel: ...

def is_atlas_file(arg: str, /) -> bool: ...

class CompressOptions:
    """Limits of the size and the error of an atlas."""

    def __init__(self, **fields: Any) -> None: ...

    def __repr__(self) -> str: ...

    @property
    def tolerance(self) -> float: ...

    @tolerance.setter
    def tolerance(self, arg: float | None, /) -> None: ...

    @property
    def samples(self) -> int: ...

    @samples.setter
    def samples(self, arg: int | None, /) -> None: ...

    @property
    def max_degree(self) -> int: ...

    @max_degree.setter
    def max_degree(self, arg: int | None, /) -> None: ...

    @property
    def seed(self) -> int: ...

    @seed.setter
    def seed(self, arg: int | None, /) -> None: ...

    @property
    def max_numbers(self) -> int: ...

    @max_numbers.setter
    def max_numbers(self, arg: int | None, /) -> None: ...

    FIELDS: tuple = ...

class CompressReport:
    """How a model came about, and what it keeps."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """All fields by name; records within it are dicts, too."""

    @property
    def samples(self) -> int:
        """Points that caps were fitted to."""

    @property
    def turned_normals(self) -> bool:
        """Whether all normals of points pointed into the solid, and were turned."""

    @property
    def hidden(self) -> float:
        """Share of a mesh that lies inside of its solid, and was left out."""

    @property
    def gap(self) -> float:
        """Distance between sheets that face each other."""

    @property
    def aimed(self) -> float:
        """Tolerance that was aimed at."""

    @property
    def uncovered(self) -> float:
        """Share of the samples that no cap met by 4 tolerances."""

    @property
    def components(self) -> int:
        """Parts of the extracted surface."""

    @property
    def genus(self) -> int:
        """Handles of the extracted surface."""

    @property
    def met(self) -> bool:
        """Whether the tolerance is kept."""

    @property
    def topology_kept(self) -> bool:
        """Whether the surface has as many parts and handles as the shape."""

    @property
    def times(self) -> dict:
        """Seconds of each stage."""

def compress(arg0: Mesh | PointCloud, arg1: CompressOptions, arg2: Caller, /) -> tuple: ...

class AtlasSynthesisOptions:
    """How a surface is extracted."""

    def __init__(self, **fields: Any) -> None: ...

    def __repr__(self) -> str: ...

    @property
    def step(self) -> float: ...

    @step.setter
    def step(self, arg: float | None, /) -> None: ...

    @property
    def degree(self) -> int | None: ...

    @degree.setter
    def degree(self, arg: int | None, /) -> None: ...

    @property
    def simplify(self) -> SimplifyOptions | None: ...

    @simplify.setter
    def simplify(self, arg: SimplifyOptions | None, /) -> None: ...

    @property
    def max_memory(self) -> int: ...

    @max_memory.setter
    def max_memory(self, arg: int | None, /) -> None: ...

    FIELDS: tuple = ...

def synthesize_atlas(arg0: AtlasModel, arg1: AtlasSynthesisOptions, arg2: Caller, /) -> Mesh: ...

def dominant_caps(arg0: Atlas, arg1: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], arg2: Caller, /) -> NDArray[numpy.uint32]: ...

def set_cap_colors(arg0: Atlas, arg1: Sequence[int], /) -> list: ...

def set_degree_colors(arg0: Atlas, arg1: Sequence[int], /) -> list: ...

class PatchAtlasOptions:
    """The paper's parameters."""

    def __init__(self, **fields: Any) -> None: ...

    def __repr__(self) -> str: ...

    @property
    def degree(self) -> int: ...

    @degree.setter
    def degree(self, arg: int | None, /) -> None: ...

    @property
    def extension(self) -> str: ...

    @extension.setter
    def extension(self, arg: str, /) -> None: ...

    @property
    def min_cosine(self) -> float: ...

    @min_cosine.setter
    def min_cosine(self, arg: float | None, /) -> None: ...

    @property
    def overlap(self) -> float: ...

    @overlap.setter
    def overlap(self, arg: float | None, /) -> None: ...

    FIELDS: tuple = ...

def patch_atlas(arg0: Mesh | PointCloud, arg1: PatchAtlasOptions, arg2: Caller, /) -> tuple: ...

def patch_picture(arg0: Mesh | PointCloud, arg1: str, arg2: PatchAtlasOptions, arg3: Caller, /) -> tuple: ...

class ReconstructOptions:
    """Resolution, cleaning and holes of the surface."""

    def __init__(self, **fields: Any) -> None: ...

    def __repr__(self) -> str: ...

    @property
    def step(self) -> float: ...

    @step.setter
    def step(self, arg: float | None, /) -> None: ...

    @property
    def tolerance(self) -> float: ...

    @tolerance.setter
    def tolerance(self, arg: float | None, /) -> None: ...

    @property
    def noise(self) -> float | None: ...

    @noise.setter
    def noise(self, arg: float | None, /) -> None: ...

    @property
    def holes(self) -> str: ...

    @holes.setter
    def holes(self, arg: str, /) -> None: ...

    @property
    def blend(self) -> str: ...

    @blend.setter
    def blend(self, arg: str, /) -> None: ...

    @property
    def min_component(self) -> float: ...

    @min_component.setter
    def min_component(self, arg: float | None, /) -> None: ...

    @property
    def keep_outliers(self) -> bool: ...

    @keep_outliers.setter
    def keep_outliers(self, arg: bool | None, /) -> None: ...

    @property
    def sensor(self) -> numpy.typing.NDArray[numpy.float64] | None: ...

    @sensor.setter
    def sensor(self, arg: Sequence[float] | numpy.typing.NDArray[numpy.float64] | None, /) -> None: ...

    @property
    def keep_scans(self) -> bool: ...

    @keep_scans.setter
    def keep_scans(self, arg: bool | None, /) -> None: ...

    @property
    def confidence(self) -> bool: ...

    @confidence.setter
    def confidence(self, arg: bool | None, /) -> None: ...

    @property
    def simplify(self) -> SimplifyOptions | None: ...

    @simplify.setter
    def simplify(self, arg: SimplifyOptions | None, /) -> None: ...

    @property
    def tile_points(self) -> int: ...

    @tile_points.setter
    def tile_points(self, arg: int | None, /) -> None: ...

    @property
    def max_memory(self) -> int: ...

    @max_memory.setter
    def max_memory(self, arg: int | None, /) -> None: ...

    @property
    def output(self) -> pathlib.Path: ...

    @output.setter
    def output(self, arg: str | os.PathLike | None, /) -> None: ...

    @property
    def model(self) -> pathlib.Path: ...

    @model.setter
    def model(self, arg: str | os.PathLike | None, /) -> None: ...

    @property
    def work_dir(self) -> pathlib.Path: ...

    @work_dir.setter
    def work_dir(self, arg: str | os.PathLike | None, /) -> None: ...

    @property
    def resume(self) -> bool: ...

    @resume.setter
    def resume(self, arg: bool | None, /) -> None: ...

    FIELDS: tuple = ...

class ReconstructReport:
    """
    What was found in the points, and what became of them; lengths are in their unit.
    """

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """All fields by name; records within it are dicts, too."""

    @property
    def points(self) -> int:
        """Number of points given."""

    @property
    def dropped_points(self) -> int:
        """Not finite, at the place of another, without a normal."""

    @property
    def outliers(self) -> int:
        """Points removed."""

    @property
    def computed_normals(self) -> bool:
        """Whether the points had none, or given ones were replaced."""

    @property
    def scans(self) -> ScanAlignment:
        """What became of scans, if there are any."""

    @property
    def unsure(self) -> float:
        """Share of the points the sign of whose computed normal is unsure."""

    @property
    def turned_normals(self) -> bool:
        """Whether all pointed into the solid, and were turned."""

    @property
    def mended_normals(self) -> int:
        """Given normals that contradicted those around them, and were turned."""

    @property
    def crooked_normals(self) -> float:
        """
        Share of given normals more than 45 degrees off the surface; above 0.25 all are computed instead.
        """

    @property
    def contradicting_normals(self) -> int:
        """
        Points whose normals contradict those around them, where turning does not help: above half the square root of the number of points the surface should not be trusted.
        """

    @property
    def contradictions(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)]:
        """The first three of these points, n x 3."""

    @property
    def crossing_length(self) -> float:
        """
        Length of the lines along which sheets of the points cross, in diagonals of the points: above 0.12 the surface should not be trusted.
        """

    @property
    def crossings(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)]:
        """The first three points near these lines, n x 3."""

    @property
    def points_off_surface(self) -> float:
        """
        Share of the points that fill what lies between the walls of the surface, or around it: above 0.5 the surface should not be trusted.
        """

    @property
    def places_off_surface(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)]:
        """Up to three of these points, n x 3."""

    @property
    def inward_normals(self) -> float:
        """
        Share of the points at which the winding number contradicts the given normal: above 0.1 the surface should not be trusted.
        """

    @property
    def spacing(self) -> float:
        """Median distance between neighbours, as if on a square grid."""

    @property
    def noise(self) -> float:
        """Standard deviation along the normal."""

    @property
    def normal_noise_degrees(self) -> float:
        """Of the normals against the surface."""

    @property
    def neighbours(self) -> int:
        """Points of a typical cap."""

    @property
    def caps(self) -> int:
        """Of the atlas."""

    @property
    def step(self) -> float:
        """Edge of the grid's cubes."""

    @property
    def holes(self) -> int:
        """Places without points that were closed, or cut out."""

    @property
    def smooth_holes(self) -> int:
        """Of those closed, by a surface that continues the rim."""

    @property
    def cut_handles(self) -> int:
        """
        Bridges and tunnels of the surface that were smaller than points can tell.
        """

    @property
    def dropped_components(self) -> int:
        """Parts of the surface that were too small."""

    @property
    def faces(self) -> int:
        """Of the surface before it was simplified."""

    @property
    def simplify_error(self) -> float:
        """By simplify()."""

    @property
    def area(self) -> float:
        """Of the surface."""

    @property
    def closed_area(self) -> float:
        """Of it, what closes holes."""

    @property
    def points_area(self) -> float:
        """That the points stand for, by the circles of their neighbours."""

    @property
    def volume(self) -> float:
        """Signed, of the surface: negative if its normals point inwards."""

    @property
    def unseen_area(self) -> float:
        """
        Of the surface, if confidence is asked for: share of the area without data nearer than three spacings.
        """

    @property
    def thin_area(self) -> float:
        """
        Of the surface, if confidence is asked for: share of the area thinner than one and a half spacings.
        """

    @property
    def unsure_area(self) -> float:
        """
        Of the surface, if confidence is asked for: share of the area with a confidence below 1/2.
        """

    @property
    def memory(self) -> int:
        """Foreseen, bytes."""

    @property
    def times(self) -> dict:
        """Stages: (wall, cpu) in seconds."""

    @property
    def bounds(self) -> Bounds:
        """
        The box of the points that are finite; of several tiles without far strays.
        """

    @property
    def tiles(self) -> int:
        """Number that space was cut into."""

    @property
    def stored(self) -> int:
        """Bytes between the steps of several tiles, at most at a time."""

    @property
    def vertices(self) -> int:
        """Number of them, of the surface."""

    @property
    def triangles(self) -> int:
        """Number of them, of the surface."""

    @property
    def coefficients(self) -> int:
        """Number of those of all caps."""

    @property
    def warnings(self) -> list[str]:
        """Of the file that the points were read from, list of str."""

def reconstruct(points: PointCloud | str | os.PathLike, dropped: int, columns: str, options: ReconstructOptions, foreseen: object | None, caller: Caller) -> tuple: ...

class TileForecast:
    """What a reconstruction in tiles will take, about."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """All fields by name; records within it are dicts, too."""

    @property
    def points(self) -> int:
        """That are finite, and no far strays."""

    @property
    def tiles(self) -> int:
        """That space is cut into."""

    @property
    def memory(self) -> int:
        """Bytes, beside what is stored."""

    @property
    def stored(self) -> int:
        """
        Bytes between the steps, in a folder, or in memory if there is room for them.
        """

    @property
    def written(self) -> int:
        """Bytes of the surface as a file."""

def foresee_tiles(arg0: int, arg1: int, /) -> TileForecast: ...

def region_weights(arg0: Mesh, arg1: Sequence[str], arg2: float, /) -> NDArray[numpy.float64]: ...

class PatchOptions:
    """Detail to remove from a region."""

    def __init__(self, **fields: Any) -> None: ...

    def __repr__(self) -> str: ...

    @property
    def wavelength(self) -> float: ...

    @wavelength.setter
    def wavelength(self, arg: float | None, /) -> None: ...

    @property
    def transition(self) -> float | None: ...

    @transition.setter
    def transition(self, arg: float | None, /) -> None: ...

    @property
    def fitting(self) -> str: ...

    @fitting.setter
    def fitting(self, arg: str, /) -> None: ...

    @property
    def repair(self) -> bool: ...

    @repair.setter
    def repair(self, arg: bool | None, /) -> None: ...

    FIELDS: tuple = ...

class Patch:
    """The vertices that may move, and where fits want them."""

    def __getstate__(self) -> tuple: ...

    def __setstate__(self, arg: object, /) -> None: ...

    @property
    def wavelength(self) -> float: ...

    @property
    def degree(self) -> int: ...

    @property
    def caps(self) -> int: ...

    @property
    def unreached(self) -> int: ...

    @property
    def vertices(self) -> NDArray[numpy.uint32]: ...

    @property
    def positions(self) -> NDArray[numpy.float64]: ...

    @property
    def weights(self) -> NDArray[numpy.float64]: ...

def analyze_patch(arg0: Mesh, arg1: Sequence[str], arg2: PatchOptions, arg3: Caller, /) -> Patch: ...

def longest_wavelength(arg: Patch, /) -> float: ...

def update_patch(arg0: Patch, arg1: float, arg2: float, /) -> NDArray[numpy.float64]: ...

def apply(arg0: Patch, arg1: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], arg2: Mesh, /) -> Mesh: ...

def apply_in_place(arg0: Patch, arg1: float, arg2: float, arg3: Mesh, /) -> None: ...

def copy_mesh(arg: Mesh, /) -> Mesh: ...

class TransferOptions:
    """Detail to take, and its size on the target."""

    def __init__(self, **fields: Any) -> None: ...

    def __repr__(self) -> str: ...

    @property
    def from_degree(self) -> int: ...

    @from_degree.setter
    def from_degree(self, arg: int | None, /) -> None: ...

    @property
    def scale(self) -> float: ...

    @scale.setter
    def scale(self, arg: float | None, /) -> None: ...

    @property
    def refine(self) -> bool: ...

    @refine.setter
    def refine(self, arg: bool | None, /) -> None: ...

    @property
    def find_angle(self) -> bool: ...

    @find_angle.setter
    def find_angle(self, arg: bool | None, /) -> None: ...

    @property
    def transition(self) -> float | None: ...

    @transition.setter
    def transition(self, arg: float | None, /) -> None: ...

    FIELDS: tuple = ...

class TransferUpdate:
    """Values that sliders change."""

    def __init__(self, **fields: Any) -> None: ...

    def __repr__(self) -> str: ...

    @property
    def height(self) -> float: ...

    @height.setter
    def height(self, arg: float | None, /) -> None: ...

    @property
    def angle(self) -> float | None: ...

    @angle.setter
    def angle(self, arg: float | None, /) -> None: ...

    @property
    def repeat(self) -> bool: ...

    @repeat.setter
    def repeat(self, arg: bool | None, /) -> None: ...

    @property
    def remove_own(self) -> bool: ...

    @remove_own.setter
    def remove_own(self, arg: bool | None, /) -> None: ...

    @property
    def mode(self) -> str: ...

    @mode.setter
    def mode(self, arg: str, /) -> None: ...

    FIELDS: tuple = ...

class TransferReport:
    """Findings of the analysis; lengths are in the units of the two meshes."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """All fields by name; records within it are dicts, too."""

    @property
    def source_radius(self) -> float:
        """Radius of a disc with the area of the source's base."""

    @property
    def target_radius(self) -> float:
        """Radius of a disc with the area of the target's base."""

    @property
    def scale(self) -> float:
        """Lengths on the target per length on the source."""

    @property
    def source_wavelength(self) -> float:
        """Of the source's base."""

    @property
    def target_wavelength(self) -> float:
        """Of the target's base."""

    @property
    def source_edge(self) -> float:
        """Median length of an edge of the source."""

    @property
    def target_edge(self) -> float:
        """Median length of an edge of the target, after refinement."""

    @property
    def source_rms(self) -> float:
        """Height of the texture in its region."""

    @property
    def angle(self) -> float:
        """Turn of best correlation, radians."""

    @property
    def correlation(self) -> float:
        """With the target's own detail there, -1 ... 1."""

    @property
    def new_vertices(self) -> int:
        """Vertices made by refinement."""

class TransferSource:
    """A texture taken from its source."""

    @property
    def from_degree(self) -> int: ...

    @property
    def radius(self) -> float: ...

    @property
    def wavelength(self) -> float: ...

    @property
    def edge(self) -> float: ...

    @property
    def rms(self) -> float: ...

class TransferAnalysis:
    """Result of an analysis of two regions."""

    @property
    def mesh(self) -> Mesh: ...

    @property
    def patch(self) -> Patch: ...

    @property
    def report(self) -> TransferReport: ...

def analyze_source(arg0: Mesh, arg1: Sequence[str], arg2: int, arg3: Caller, /) -> TransferSource: ...

def analyze_transfer(arg0: TransferSource, arg1: Mesh, arg2: Sequence[str], arg3: TransferOptions, arg4: Caller, /) -> TransferAnalysis: ...

def update_transfer(arg0: TransferAnalysis, arg1: TransferUpdate, arg2: Caller, /) -> NDArray[numpy.float64]: ...

def apply_transfer_in_place(arg0: TransferAnalysis, arg1: TransferUpdate, arg2: Mesh, arg3: Caller, /) -> None: ...

class Panel:
    """One thing in a picture; the mesh, or the points, must be kept."""

    @overload
    def __init__(self, arg0: Mesh, arg1: str, arg2: bool, arg3: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)] | None, arg4: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)] | None, /) -> None: ...

    @overload
    def __init__(self, arg0: PointCloud, arg1: str, arg2: float, arg3: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)] | None, arg4: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)] | None, /) -> None: ...

class RenderOptions:
    """Size, point of view, light and colours."""

    def __init__(self, **fields: Any) -> None: ...

    def __repr__(self) -> str: ...

    @property
    def width(self) -> int: ...

    @width.setter
    def width(self, arg: int | None, /) -> None: ...

    @property
    def height(self) -> int: ...

    @height.setter
    def height(self, arg: int | None, /) -> None: ...

    @property
    def perspective(self) -> bool: ...

    @perspective.setter
    def perspective(self, arg: bool | None, /) -> None: ...

    @property
    def fit_each(self) -> bool: ...

    @fit_each.setter
    def fit_each(self, arg: bool | None, /) -> None: ...

    @property
    def view(self) -> numpy.typing.NDArray[numpy.float64]: ...

    @view.setter
    def view(self, arg: Sequence[float] | numpy.typing.NDArray[numpy.float64] | None, /) -> None: ...

    @property
    def up(self) -> numpy.typing.NDArray[numpy.float64]: ...

    @up.setter
    def up(self, arg: Sequence[float] | numpy.typing.NDArray[numpy.float64] | None, /) -> None: ...

    @property
    def samples(self) -> int: ...

    @samples.setter
    def samples(self, arg: int | None, /) -> None: ...

    @property
    def occlusion_rays(self) -> int: ...

    @occlusion_rays.setter
    def occlusion_rays(self, arg: int | None, /) -> None: ...

    @property
    def fine(self) -> bool: ...

    @fine.setter
    def fine(self, arg: bool | None, /) -> None: ...

    @property
    def scale_min(self) -> float | None: ...

    @scale_min.setter
    def scale_min(self, arg: float | None, /) -> None: ...

    @property
    def scale_max(self) -> float | None: ...

    @scale_max.setter
    def scale_max(self, arg: float | None, /) -> None: ...

    @property
    def scale_bar(self) -> bool: ...

    @scale_bar.setter
    def scale_bar(self, arg: bool | None, /) -> None: ...

    @property
    def scale_label(self) -> str: ...

    @scale_label.setter
    def scale_label(self, arg: str | None, /) -> None: ...

    FIELDS: tuple = ...

def render(arg0: Sequence[Panel], arg1: RenderOptions, arg2: Caller, /) -> NDArray[numpy.uint8]: ...

@overload
def vertex_colors(arg: Mesh, /) -> NDArray[numpy.float32]: ...

@overload
def vertex_colors(arg: PointCloud, /) -> NDArray[numpy.float32]: ...

def spectrum_svg(arg0: Expansion, arg1: str, arg2: float | None, /) -> str: ...

def encode_png(arg: Annotated[NDArray[numpy.uint8], dict(shape=(None, None, 3), order='C', device='cpu', writable=False)], /) -> bytes: ...

def write_png(arg0: str, arg1: Annotated[NDArray[numpy.uint8], dict(shape=(None, None, 3), order='C', device='cpu', writable=False)], /) -> None: ...

def write_file(arg0: str, arg1: bytes, /) -> None: ...

class ReportOptions:
    """Texts of a page beside its figures."""

    def __init__(self, **fields: Any) -> None: ...

    def __repr__(self) -> str: ...

    @property
    def title(self) -> str: ...

    @title.setter
    def title(self, arg: str | None, /) -> None: ...

    @property
    def shape_name(self) -> str: ...

    @shape_name.setter
    def shape_name(self, arg: str | None, /) -> None: ...

    @property
    def notes(self) -> list[str]: ...

    @notes.setter
    def notes(self, arg: Sequence[str] | None, /) -> None: ...

    @property
    def tolerance(self) -> float | None: ...

    @tolerance.setter
    def tolerance(self, arg: float | None, /) -> None: ...

    @property
    def weld_tolerance(self) -> float: ...

    @weld_tolerance.setter
    def weld_tolerance(self, arg: float | None, /) -> None: ...

    @property
    def picture_size(self) -> int: ...

    @picture_size.setter
    def picture_size(self, arg: int | None, /) -> None: ...

    @property
    def file_bytes(self) -> int | None: ...

    @file_bytes.setter
    def file_bytes(self, arg: int | None, /) -> None: ...

    @property
    def viewer(self) -> str: ...

    @viewer.setter
    def viewer(self, arg: str | None, /) -> None: ...

    FIELDS: tuple = ...

    def set_commands(self, arg: Sequence[tuple[str, str]], /) -> None: ...

def report_html(arg0: Expansion | AtlasModel, arg1: Mesh | None, arg2: ReportOptions, arg3: Caller, /) -> str: ...

def view_data(arg0: Expansion, arg1: Mesh | None, arg2: str, arg3: Caller, /) -> bytes: ...

class StudioListener:
    """Who listens to a session."""

    def wait(self, seconds: float) -> list: ...

    @property
    def ended(self) -> bool: ...

class Studio:
    """Requests in, responses out."""

    def __init__(self, folder: str, threads: int) -> None: ...

    def handle(self, method: str, path: str, query: Mapping[str, str], body: bytes, session: str) -> tuple: ...

    def offered_session(self) -> str: ...

    def listen(self, session: str) -> StudioListener: ...

    def close(self) -> None: ...

class BatchTable:
    """Rows as columns."""

    def __getstate__(self) -> tuple: ...

    def __setstate__(self, arg: object, /) -> None: ...

    @property
    def rows(self) -> int: ...

    @property
    def leading(self) -> int: ...

    @property
    def columns(self) -> list: ...

    def write(self, arg0: str, arg1: bool, arg2: bool, /) -> None: ...

class BatchJournal:
    """Rows that are done, in a file."""

    def __init__(self, arg0: str, arg1: Sequence[str], arg2: int, /) -> None: ...

    @property
    def done(self) -> int: ...

    def has(self, arg: int, /) -> bool: ...

    def append(self, arg0: int, arg1: dict, /) -> None: ...

    def read(self, arg: int, /) -> dict: ...

    def remove(self) -> None: ...

def gather_batch(arg0: Sequence[str], arg1: list, /) -> BatchTable: ...

def read_batch(arg: str, /) -> BatchTable: ...
