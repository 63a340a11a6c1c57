"""Bindings of the C++ library; use the package rholm instead."""

from collections.abc import Mapping, Sequence
import os
import pathlib
from typing import Annotated, Any, overload

import numpy
import numpy.typing
from numpy.typing import NDArray


VERSION: str = '0.3.0'

MAX_DEGREE: int = 16384

NO_CAP: int = 4294967295

ERRORS: tuple = ...

class Caller:
    """Threads and progress callback of one call."""

    def __init__(self, threads: int, progress: object | None) -> None: ...

def after_fork_in_child() -> None:
    """
    Tells the library that it is in a child of fork(), where there are no threads.
    """

class Mesh:
    """A mesh of triangles that share vertices."""

    def __init__(self, arg0: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], arg1: Annotated[NDArray[numpy.uint32], dict(shape=(None, 3), order='C', device='cpu', writable=False)], arg2: Sequence[tuple[str, str, Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)]]], /) -> None: ...

    def __getstate__(self) -> tuple: ...

    def __setstate__(self, arg: object, /) -> None: ...

    @property
    def vertices(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)]: ...

    @property
    def faces(self) -> Annotated[NDArray[numpy.uint32], dict(writable=False)]: ...

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
    """A mesh in a mapped file."""

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
    """A box with sides along the axes."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """Returns all fields by name; records in fields become dicts, too."""

    @property
    def min(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)]:
        """Corner with the smallest coordinates."""

    @property
    def max(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)]:
        """Corner with the largest coordinates."""

    @property
    def diagonal(self) -> float:
        """Length of the diagonal."""

class Inspection:
    """
    Properties of a mesh. Counts are of the given mesh: weld it first to close seams.
    """

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """Returns all fields by name; records in fields become dicts, too."""

    @property
    def vertices(self) -> int:
        """Number of vertices, used or not."""

    @property
    def faces(self) -> int:
        """Number of faces, with an area or not."""

    @property
    def edges(self) -> int:
        """Number of pairs of vertices that a face joins."""

    @property
    def boundary_edges(self) -> int:
        """Number of edges of only one face."""

    @property
    def non_manifold_edges(self) -> int:
        """Number of edges of three or more faces."""

    @property
    def misoriented_edges(self) -> int:
        """Number of edges that two faces use in the same direction."""

    @property
    def non_manifold_vertices(self) -> int:
        """Number of vertices whose faces do not form one fan."""

    @property
    def isolated_vertices(self) -> int:
        """Number of vertices that no face uses."""

    @property
    def degenerate_faces(self) -> int:
        """Number of faces thinner than the rounding of their coordinates."""

    @property
    def duplicate_faces(self) -> int:
        """Number of faces with the same three vertices as an earlier face."""

    @property
    def components(self) -> int:
        """Number of parts connected through edges."""

    @property
    def euler_characteristic(self) -> int:
        """Number of used vertices minus edges plus faces."""

    @property
    def genus(self) -> int:
        """Number of handles of all parts together, for closed manifold meshes."""

    @property
    def closed(self) -> bool:
        """True if the mesh has at least one face and no boundary edge."""

    @property
    def manifold(self) -> bool:
        """True if the mesh has no non-manifold edge or vertex."""

    @property
    def oriented(self) -> bool:
        """True if the mesh has no misoriented edge."""

    @property
    def inside_out(self) -> bool:
        """
        True if the mesh is closed and oriented, but encloses a negative volume.
        """

    @property
    def bounds(self) -> Bounds:
        """Bounding box of all vertices."""

    @property
    def area(self) -> float:
        """Area of all faces, in the squared unit of the vertices."""

    @property
    def volume(self) -> float:
        """
        Signed volume of a closed oriented mesh, in the cubed unit of the vertices.
        """

    @property
    def vertex_centroid(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)]:
        """Mean of the used vertices."""

    @property
    def volume_centroid(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)]:
        """
        Centroid of the solid, if the mesh is closed and its volume is not zero.
        """

class RepairReport:
    """Report of `repair`: changes, and defects that remain."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """Returns all fields by name; records in fields become dicts, too."""

    @property
    def before(self) -> Inspection:
        """State of the mesh before the repair, welded exactly."""

    @property
    def merged_vertices(self) -> int:
        """Number of vertices merged by welding."""

    @property
    def collapsed_faces(self) -> int:
        """Number of faces dropped because welding merged two of their corners."""

    @property
    def isolated_vertices(self) -> int:
        """Number of vertices dropped because no face uses them."""

    @property
    def duplicate_faces(self) -> int:
        """Number of faces dropped because an earlier face has the same vertices."""

    @property
    def degenerate_faces(self) -> int:
        """
        Number of faces dropped or swapped because they are thinner than rounding.
        """

    @property
    def junctions(self) -> int:
        """
        Number of vertices on edges of other faces (T-junctions) that were joined.
        """

    @property
    def flipped_faces(self) -> int:
        """Number of faces that were turned."""

    @property
    def inside_out_parts(self) -> int:
        """Number of closed parts that were turned as a whole."""

    @property
    def cavities(self) -> int:
        """
        Number of closed parts inside another part, which are oriented inwards.
        """

    @property
    def split_vertices(self) -> int:
        """Number of new vertices where sheets met in one vertex."""

    @property
    def closed_holes(self) -> int:
        """Number of holes closed by new faces."""

    @property
    def hole_faces(self) -> int:
        """Number of new faces that close holes."""

    @property
    def large_holes(self) -> int:
        """Number of holes left open because they have more edges than allowed."""

    @property
    def largest_hole(self) -> int:
        """Number of edges of the largest hole with more edges than allowed."""

    @property
    def sheets(self) -> int:
        """Number of holes left open because they are borders of open sheets."""

    @property
    def one_sided_parts(self) -> int:
        """Number of parts left without an orientation (Moebius strips)."""

    @property
    def closes_at(self) -> float | None:
        """
        Tolerance of welding that would join the remaining borders; None if there is none.
        """

    @property
    def after(self) -> Inspection:
        """State of the mesh after the repair, welded exactly."""

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
    """Options of `repair`."""

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
    """Options of `simplify`: when it stops."""

    def __init__(self, **fields: Any) -> None: ...

    def __repr__(self) -> str: ...

    @property
    def faces(self) -> int: ...

    @faces.setter
    def faces(self, arg: int | None, /) -> None: ...

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
    """
    Options of `sample_surface`: errors, outliers and places of the samples.
    """

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
    """Report of `clean`."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """Returns all fields by name; records in fields become dicts, too."""

    @property
    def points(self) -> int:
        """Number of points before cleaning."""

    @property
    def not_finite(self) -> int:
        """Number of points dropped because a coordinate is NaN or infinite."""

    @property
    def duplicates(self) -> int:
        """
        Number of points dropped because an earlier point has the same position.
        """

    @property
    def opposite_normals(self) -> int:
        """
        Number of dropped duplicates whose normal opposes the normal of the earlier point.
        """

    @property
    def zero_normals(self) -> int:
        """Number of remaining points with a zero normal."""

def clean(arg0: PointCloud, arg1: Caller, /) -> tuple: ...

class ScanAlignment:
    """Report of `align_scans`; lengths are in the unit of the points."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """Returns all fields by name; records in fields become dicts, too."""

    @property
    def scans(self) -> int:
        """
        Number of scans: different values of the attribute 'scan'; 0 without the attribute.
        """

    @property
    def pairs(self) -> int:
        """Number of compared pairs of points from different scans."""

    @property
    def distance_before(self) -> float:
        """
        Standard deviation of the distance between paired points along the normal, before the alignment.
        """

    @property
    def distance(self) -> float:
        """
        Standard deviation of the distance between paired points along the normal, after the alignment.
        """

    @property
    def moved(self) -> float:
        """Root mean square displacement of all points."""

def align_scans(arg0: PointCloud, arg1: Caller, /) -> tuple: ...

class OrientOptions:
    """Options of `orient`."""

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
    """Report of `orient`."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """Returns all fields by name; records in fields become dicts, too."""

    @property
    def points(self) -> int:
        """Number of given points."""

    @property
    def duplicates(self) -> int:
        """
        Number of points at the position of an earlier point, whose normal they share.
        """

    @property
    def neighbors(self) -> int:
        """Number of neighbours that a normal is fitted to."""

    @property
    def components(self) -> int:
        """
        Number of connected parts of the neighbour graph; 0 with a centre or a sensor.
        """

    @property
    def computed(self) -> int:
        """Number of normals with a newly computed direction."""

    @property
    def flipped(self) -> int:
        """Number of normals whose sign was changed."""

    @property
    def outliers(self) -> int:
        """
        Number of isolated points, which got the normal of the nearest point that is not isolated.
        """

    @property
    def undetermined(self) -> int:
        """
        Number of points with a zero normal, because their neighbours lie on a line.
        """

    @property
    def mean_confidence(self) -> float:
        """
        Mean confidence of all points; a sign is right with at least the probability (1 + confidence) / 2.
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
    Errors of an expansion relative to its shape, in the unit of lengths; None where unknown.
    """

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """Returns all fields by name; records in fields become dicts, too."""

    @property
    def rms(self) -> float | None:
        """Root mean square radial error over solid angle."""

    @property
    def rms_is_exact(self) -> bool:
        """True if rms is exact by Parseval's identity, false if it is measured."""

    @property
    def predicted_max(self) -> float | None:
        """Largest radial error at the vertices, predicted in closed form."""

    @property
    def predicted_max_distance(self) -> float | None:
        """
        Largest distance between the surfaces at the vertices, predicted in closed form.
        """

    @property
    def measured_max(self) -> float | None:
        """Largest radial error measured at `points` points of the shape."""

    @property
    def max_bound(self) -> float | None:
        """
        Upper bound of the radial error, by branch and bound; None for a gauge, or if larger than the diagonal.
        """

    @property
    def measured_max_distance(self) -> float | None:
        """
        Largest distance between the surfaces, measured at `points` points of the shape.
        """

    @property
    def distance_rms(self) -> float | None:
        """
        Root mean square distance between the surfaces over area, the larger of both directions.
        """

    @property
    def distances_are_closest(self) -> bool:
        """
        True if distances are to closest points, false if they are first-order estimates.
        """

    @property
    def points(self) -> int:
        """Number of points of the shape at which errors are measured."""

    @property
    def diagonal(self) -> float:
        """Diagonal of the shape's bounding box; 0 if unknown."""

class GravityField:
    """Reference values of the coefficients of a gravity field."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """Returns all fields by name; records in fields become dicts, too."""

    @property
    def gravity_constant(self) -> float:
        """Gravity constant G M, in m^3/s^2."""

    @property
    def reference_radius(self) -> float:
        """Radius of the reference sphere about the centre, in m."""

class Expansion:
    """A surface as spherical harmonic coefficients."""

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
    """Overshoot of a filtered step beyond 0 ... 1, relative to its height."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """Returns all fields by name; records in fields become dicts, too."""

    @property
    def above(self) -> float:
        """Largest value of the filtered step, minus 1."""

    @property
    def below(self) -> float:
        """Smallest value of the filtered step, times -1."""

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
    """A rotation as a unit quaternion; its negative is the same rotation."""

    def __init__(self, w: float = 1.0, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> None: ...

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """Returns all fields by name; records in fields become dicts, too."""

    @property
    def w(self) -> float:
        """Cosine of half the angle of rotation."""

    @property
    def x(self) -> float:
        """Component x of the axis, times the sine of half the angle."""

    @property
    def y(self) -> float:
        """Component y of the axis, times the sine of half the angle."""

    @property
    def z(self) -> float:
        """Component z of the axis, times the sine of half the angle."""

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
    """Principal axes of the quadratic form of degree 2."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """Returns all fields by name; records in fields become dicts, too."""

    @property
    def axes(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)]:
        """
        Principal axes in rows, right-handed, orthonormal, longest first, (3, 3).
        """

    @property
    def values(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)]:
        """Values of the form along the axes, descending, (3,); their sum is 0."""

    @property
    def to_axes(self) -> Rotation:
        """Rotation that turns the axes to x, y and z."""

    @property
    def free_axes(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)]:
        """
        Axes about which the form can turn without changing: none, one or three, (n, 3).
        """

def principal_axes(arg0: Coefficients, arg1: str, /) -> PrincipalAxes: ...

class AlignOptions:
    """Options of `align`."""

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
    """A rotation of a, and how closely it brings a to b."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """Returns all fields by name; records in fields become dicts, too."""

    @property
    def rotation(self) -> Rotation:
        """Rotation that turns a, or the mirror image of a if mirrored, onto b."""

    @property
    def mirrored(self) -> bool:
        """
        True if the reflection x -> -x is applied before the rotation; y and z stay.
        """

    @property
    def correlation(self) -> float:
        """
        Normalised correlation over the degrees from 1 on; 1 means equal up to a factor.
        """

    @property
    def distance(self) -> float:
        """
        Root mean square difference between the rotated a and b over the sphere, all degrees.
        """

class Alignment:
    """The best rotation, and rotations that are nearly as good."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """Returns all fields by name; records in fields become dicts, too."""

    @property
    def best(self) -> AlignedRotation:
        """
        Rotation with the largest correlation; among equal ones the one with the smallest angle.
        """

    @property
    def ambiguities(self) -> list[AlignedRotation]:
        """
        Other rotations that are nearly as good, best first, at most 32: symmetries of the shape.
        """

    @property
    def free_axes(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)]:
        """
        Axes in the frame of b about which a turn hardly changes the correlation, (n, 3).
        """

    @property
    def unaligned_distance(self) -> float:
        """
        Root mean square difference between a and b over the sphere, before any rotation.
        """

class Placement:
    """
    Rigid motion of a point p to R (p - from_point) + to_point, of the mirror image if mirrored.
    """

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """Returns all fields by name; records in fields become dicts, too."""

    @property
    def alignment(self) -> Alignment:
        """Rotation R, and whether the mirror image is taken."""

    @property
    def from_point(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)]:
        """Point of a that is moved to to_point, (3,)."""

    @property
    def to_point(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)]:
        """Point of b that from_point is moved to, (3,)."""

    @property
    def centers(self) -> str:
        """
        Choice of from_point and to_point: "volume", the centroids, or "own", the centres of the expansions.
        """

    @property
    def why_own(self) -> str:
        """
        Reason why the centroids could not be used; empty if they were used or not wanted.
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
    """Options of the transform from a chart to coefficients."""

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
    """Largest allowed error of a model."""

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
    """Options of the centre."""

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
    """Options of a chart: the centre, and surfaces that are not star-shaped."""

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
    """Options of `expand`: degree, precision and errors."""

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
    """Visibility of a mesh from a centre."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """Returns all fields by name; records in fields become dicts, too."""

    @property
    def center(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)]:
        """Centre in the coordinates of the mesh, (3,)."""

    @property
    def min_d(self) -> float:
        """
        Smallest distance of the centre from the plane of a face; negative if a face points away from the centre.
        """

    @property
    def min_cos_gamma(self) -> float:
        """
        Smallest cosine of the angle between normal and ray from the centre, over all corners of all faces.
        """

    @property
    def bad_faces(self) -> int:
        """Number of faces that point away from the centre."""

    @property
    def star_shaped(self) -> bool:
        """
        True if no face points away from the centre and every direction meets the surface once.
        """

    @property
    def rays(self) -> int:
        """Number of tested directions."""

    @property
    def once_share(self) -> float:
        """Share of the tested directions that meet the surface exactly once."""

    @property
    def multiple_share(self) -> float:
        """Share of the tested directions that meet the surface more than once."""

    @property
    def missed_share(self) -> float:
        """Share of the tested directions that never meet the surface."""

    @property
    def center_fell_back(self) -> bool:
        """
        True if no point sees the whole surface, so that the centre is only the best guess.
        """

def find_center(arg0: Mesh, arg1: CenterOptions, arg2: Caller, /) -> StarReport: ...

def check_star(arg0: Mesh, arg1: Sequence[float] | numpy.typing.NDArray[numpy.float64], arg2: int, arg3: Caller, /) -> StarReport: ...

class StarChart:
    """A mesh relative to its centre."""

    def __getstate__(self) -> tuple: ...

    def __setstate__(self, arg: object, /) -> None: ...

    @property
    def mesh(self) -> Mesh: ...

    @property
    def report(self) -> StarReport: ...

def make_star_chart(arg0: Mesh, arg1: ChartOptions, arg2: Caller, /) -> StarChart: ...

class FastReport:
    """Report of the fast engine."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """Returns all fields by name; records in fields become dicts, too."""

    @property
    def single(self) -> bool:
        """True if sources were spread in single precision."""

    @property
    def width(self) -> int:
        """Number of grid points of the spreading window."""

    @property
    def oversampling(self) -> float:
        """Oversampling factor of the grid."""

    @property
    def lumped_faces(self) -> int:
        """Number of faces represented by sources at their vertices."""

    @property
    def nodes(self) -> int:
        """Number of sources that are not at vertices."""

    @property
    def vertices(self) -> int:
        """Number of sources at vertices."""

    @property
    def error(self) -> float:
        """
        L2 error of the coefficients from degree 1 on, relative to the norm of the function without its mean.
        """

    @property
    def band_error(self) -> float:
        """
        L2 error of the degrees above 3L/4, relative to the norm of these degrees.
        """

    @property
    def measured_share(self) -> float:
        """
        Share of the faces on which errors were measured; 1: a second, finer pass; less: a sample; 0: errors are estimated.
        """

    @property
    def error_uncertainty(self) -> float:
        """Possible excess of the true error over a measured error."""

    @property
    def passes(self) -> int:
        """Number of passes over the faces."""

    @property
    def reached(self) -> bool:
        """
        True if the error is within the precision, or within the least error that rounding allows.
        """

class Transform:
    """Report of a transform to coefficients."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """Returns all fields by name; records in fields become dicts, too."""

    @property
    def edge_nodes(self) -> int:
        """Number of quadrature nodes on edges."""

    @property
    def face_nodes(self) -> int:
        """Number of quadrature nodes on faces."""

    @property
    def closure_residual(self) -> float | None:
        """
        Closure error of the mesh, zero if it is closed and consistently oriented; None with the fast engine.
        """

    @property
    def fast(self) -> FastReport | None:
        """Report of the fast engine, or None if it was not used."""

    @property
    def precision(self) -> float:
        """Precision that the coefficients were computed for."""

    @property
    def times(self) -> dict:
        """Wall and CPU time of each stage, in seconds: (wall, cpu)."""

    @property
    def truncation_rms(self) -> float | None:
        """
        Root mean square truncation error over solid angle, in the unit of the function; None if too uncertain.
        """

    @property
    def truncation_rms_uncertainty(self) -> float | None:
        """Uncertainty of truncation_rms, from the precision of the coefficients."""

    @property
    def expansion(self) -> Expansion: ...

class ToleranceReport:
    """Report on a wanted tolerance."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """Returns all fields by name; records in fields become dicts, too."""

    @property
    def allowed(self) -> float:
        """Largest allowed error, in the unit of the mesh."""

    @property
    def reached(self) -> float:
        """Error of the model, in the unit of the mesh."""

    @property
    def met(self) -> bool:
        """True if the error of the model is at most the allowed error."""

    @property
    def degrees(self) -> list[int]:
        """
        Degrees that were tried; the model has the last degree or is truncated from it.
        """

class Expanded:
    """Report of `expand`."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """Returns all fields by name; records in fields become dicts, too."""

    @property
    def transform(self) -> Transform:
        """Report of the transform that computed the coefficients."""

    @property
    def tolerance(self) -> ToleranceReport | None:
        """Report on the wanted tolerance, or None without a tolerance."""

    @property
    def star(self) -> StarReport:
        """Centre, and visibility of the surface from the centre."""

    @property
    def diagonal(self) -> float:
        """Diagonal of the bounding box of the mesh."""

    @property
    def vertices(self) -> int:
        """Number of vertices, after welding if the mesh was welded."""

    @property
    def faces(self) -> int:
        """Number of faces, after welding if the mesh was welded."""

    @property
    def edges(self) -> int:
        """Number of edges, after welding if the mesh was welded."""

    @property
    def merged_vertices(self) -> int:
        """Number of vertices removed by welding."""

    @property
    def collapsed_faces(self) -> int:
        """Number of faces removed because welding merged two of their corners."""

    @property
    def flipped(self) -> bool:
        """True if the mesh was inside out and was turned."""

    @property
    def times(self) -> dict:
        """Wall and CPU time of each stage, in seconds: (wall, cpu)."""

def expand_mesh(arg0: Annotated[NDArray, dict(shape=(None, 3), device='cpu', writable=False)], arg1: Annotated[NDArray[numpy.uint32], dict(shape=(None, 3), device='cpu', writable=False)], arg2: ExpandOptions, arg3: Caller, /) -> Expanded: ...

def expand_file(arg0: str, arg1: ExpandOptions, arg2: Caller, /) -> tuple: ...

def expand_chart(arg0: StarChart, arg1: TransformOptions, arg2: Caller, /) -> Transform: ...

def expand_chart_to_tolerance(arg0: StarChart, arg1: Tolerance, arg2: TransformOptions, arg3: Caller, /) -> tuple: ...

def radius_norm_squared(arg: StarChart, /) -> float: ...

def gauge_norm_squared(arg: StarChart, /) -> float: ...

def tail_strength(arg0: StarChart, arg1: str, /) -> float: ...

def vertex_error_strength(arg0: StarChart, arg1: str, /) -> float: ...

class ErrorStrengths:
    """Largest truncation errors at vertices, times 2 pi (L + 1)."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """Returns all fields by name; records in fields become dicts, too."""

    @property
    def radius(self) -> float:
        """
        Largest error of the radius at a vertex, times 2 pi (L + 1), in the unit of the mesh.
        """

    @property
    def gauge(self) -> float:
        """
        Largest error of 1/r at a vertex, times 2 pi (L + 1), in 1/unit of the mesh.
        """

    @property
    def distance(self) -> float:
        """
        Largest distance between the surfaces at a vertex, times 2 pi (L + 1), in the unit of the mesh.
        """

def vertex_error_strengths(arg0: Mesh, arg1: Sequence[float] | numpy.typing.NDArray[numpy.float64], /) -> ErrorStrengths: ...

def rms_beyond(arg: Expansion, /) -> NDArray[numpy.float64]: ...

def truncation_errors(arg0: Mesh, arg1: Expansion, arg2: float | None, arg3: bool, arg4: Caller, /) -> TruncationErrors: ...

class MonteCarloOptions:
    """Options of `monte_carlo`."""

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
    """Coefficients from random points, and their standard errors."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """Returns all fields by name; records in fields become dicts, too."""

    @property
    def places(self) -> int:
        """Number of edges or faces that were sampled."""

    @property
    def samples(self) -> int:
        """Number of points on each sampled edge or face."""

    @property
    def rounds(self) -> int:
        """Number of rounds in which points were added."""

    @property
    def relative_deviation(self) -> float | None:
        """
        Standard error relative to the coefficients without the mean; None with too few points to estimate it.
        """

    @property
    def reached(self) -> bool:
        """
        True if the wanted deviation is reached, or if the number of samples was given.
        """

    @property
    def degree_deviation(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)]:
        """
        Standard error of all coefficients of a degree together, for each degree.
        """

    @property
    def truncation_rms(self) -> float | None:
        """
        Root mean square truncation error over solid angle, in the unit of the function; None if too uncertain.
        """

    @property
    def truncation_rms_uncertainty(self) -> float | None:
        """Uncertainty of truncation_rms: three standard deviations."""

    @property
    def times(self) -> dict:
        """Wall and CPU time of each stage, in seconds: (wall, cpu)."""

    @property
    def expansion(self) -> Expansion: ...

    @property
    def deviation(self) -> Coefficients: ...

def monte_carlo(arg0: StarChart, arg1: MonteCarloOptions, arg2: Caller, /) -> MonteCarlo: ...

def synthesize(arg0: Expansion, arg1: Mesh, arg2: Sequence[int], arg3: Caller, /) -> list: ...

def directions_of(arg0: Mesh, arg1: Sequence[float] | numpy.typing.NDArray[numpy.float64], /) -> Mesh: ...

class SurfaceMeasures:
    """Measures of the solid bounded by a surface."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """Returns all fields by name; records in fields become dicts, too."""

    @property
    def volume(self) -> float | None:
        """
        Volume of the solid bounded by the surface (exact for a radius), in the unit of length to the power 3. None for a signed sum.
        """

    @property
    def area(self) -> float | None:
        """
        Area of the surface (accurate to about 1e-12), in the unit of length to the power 2. None for a signed sum.
        """

    @property
    def sphericity(self) -> float | None:
        """
        Area of the ball of equal volume divided by the area of the surface, at most 1 (Wadell 1935). None for a signed sum.
        """

    @property
    def centroid(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)] | None:
        """Centroid of the solid, (3,)."""

def descriptors() -> list: ...

def measure(arg0: Expansion, arg1: Caller, /) -> SurfaceMeasures: ...

def inertia(arg0: Expansion, arg1: Caller, /) -> NDArray[numpy.float64]: ...

class CompareOptions:
    """Options of `compare`."""

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
    """Distances of all samples, in the unit of the shape."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """Returns all fields by name; records in fields become dicts, too."""

    @property
    def rms(self) -> float:
        """Root mean square distance."""

    @property
    def mean(self) -> float:
        """Mean distance."""

    @property
    def max(self) -> float:
        """Largest distance."""

class Comparison:
    """Distance between two surfaces A and B, in the unit of the shape."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """Returns all fields by name; records in fields become dicts, too."""

    @property
    def samples(self) -> int:
        """Number of sample points on each surface."""

    @property
    def seed(self) -> int:
        """Seed of the random sample points."""

    @property
    def diagonal(self) -> float:
        """Diagonal of A's bounding box."""

    @property
    def a_to_b(self) -> Distances:
        """Distances from samples of A to their closest points on B."""

    @property
    def b_to_a(self) -> Distances:
        """Distances from samples of B to their closest points on A."""

    @property
    def hausdorff(self) -> float:
        """
        Larger of the two largest distances, a lower bound of the Hausdorff distance.
        """

    @property
    def threshold(self) -> float:
        """
        Distance within which a sample counts for precision, recall and F-score.
        """

    @property
    def precision(self) -> float:
        """Share of the samples of B within the threshold of A."""

    @property
    def recall(self) -> float:
        """Share of the samples of A within the threshold of B."""

    @property
    def f_score(self) -> float:
        """Harmonic mean of precision and recall."""

    @property
    def normal_median_degrees(self) -> float:
        """
        Median angle between the normal at a sample and the normal at its closest point, 0 ... 180 degrees.
        """

    @property
    def normal_mean_degrees(self) -> float:
        """
        Mean angle between the normal at a sample and the normal at its closest point, 0 ... 180 degrees.
        """

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
        """Returns all fields by name; records in fields become dicts, too."""

    @property
    def center(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)]:
        """Centre of the cap's sphere, in the coordinates of the shape, (3,)."""

    @property
    def axes(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)]:
        """Axes of the cap's frame, rows x, y, z; z points outwards, (3, 3)."""

    @property
    def radius(self) -> float:
        """Radius of the cap's sphere."""

    @property
    def dilation(self) -> float:
        """Dilation a of the cap: tan(theta'/2) = a tan(theta/2)."""

    @property
    def support(self) -> float:
        """Radius of the points around the seed that the cap was fitted to."""

    @property
    def seed(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)]:
        """Point of the cap's sphere in the middle of the cap, (3,)."""

    @property
    def ellipse(self) -> tuple:
        """
        Ellipse of the cap's support: centre (px, py) and quadratic form (xx, xy, yy).
        """

    @property
    def basis(self) -> str:
        """Set of harmonics of the cap: full or even."""

    @property
    def degree(self) -> int:
        """Highest degree of the cap."""

    @property
    def first(self) -> int:
        """Index of the cap's first coefficient in the coefficients of the atlas."""

    @property
    def error(self) -> float:
        """Root mean square distance of the fitted points from the cap."""

    @property
    def area(self) -> float:
        """
        Area of the surface assigned to the cap; the areas of all caps add up to the whole.
        """

    @property
    def weight(self) -> float:
        """Factor of the blend weight of the cap."""

    @property
    def deviation(self) -> float:
        """
        Largest distance of the cap's surface from the tangent plane at its seed.
        """

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
    Rules with which `reconstruct` made a surface from caps; an atlas with them makes the same surface again.
    """

    def __getstate__(self) -> tuple: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __repr__(self) -> str: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """Returns all fields by name; records in fields become dicts, too."""

    @property
    def holes(self) -> str:
        """
        Places without points; 'fill': they are closed; 'keep': they are cut open.
        """

    @property
    def min_component(self) -> float:
        """Share of the largest part's area below which a part is dropped."""

    @property
    def simplified(self) -> bool:
        """True if the surface was simplified."""

    @property
    def tiles(self) -> bool:
        """
        True if the surface was made in several tiles. `Atlas.mesh` then has another order of vertices and faces, and closed holes may differ by some steps of the grid.
        """

    @property
    def left_out(self) -> list[str]:
        """
        Names of attributes that the surface has from the points, and the atlas does not hold.
        """

class AtlasErrors:
    """Measured errors of an atlas, in the unit of the shape."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """Returns all fields by name; records in fields become dicts, too."""

    @property
    def rms_from(self) -> float:
        """Root mean square distance from the shape to the model's surface."""

    @property
    def max_from(self) -> float:
        """Largest distance from the shape to the model's surface."""

    @property
    def rms_to(self) -> float:
        """
        Root mean square distance from the model's surface to the shape; 0 if the shape is points.
        """

    @property
    def max_to(self) -> float:
        """
        Largest distance from the model's surface to the shape; 0 if the shape is points.
        """

    @property
    def rms(self) -> float:
        """Root mean square distance, the larger of both directions."""

    @property
    def max(self) -> float:
        """Largest distance, the larger of both directions."""

    @property
    def two_sided(self) -> bool:
        """True if both directions were measured."""

class AtlasSize:
    """Size of an atlas."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """Returns all fields by name; records in fields become dicts, too."""

    @property
    def caps(self) -> int:
        """Number of caps."""

    @property
    def coefficients(self) -> int:
        """Number of coefficients that are not zero."""

    @property
    def frame_numbers(self) -> int:
        """Number of values that describe the frames of all caps."""

    @property
    def numbers(self) -> int:
        """Number of values of the whole model: coefficients and frame numbers."""

class AtlasModel:
    """An atlas and the metadata of its file."""

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
    """Options of `compress`: limits of the size and the error of an atlas."""

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
    """Report of `compress`."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """Returns all fields by name; records in fields become dicts, too."""

    @property
    def samples(self) -> int:
        """Number of points that caps were fitted to."""

    @property
    def turned_normals(self) -> bool:
        """
        True if all normals of the points pointed into the solid and were turned.
        """

    @property
    def hidden(self) -> float:
        """Share of a mesh that lies inside its own solid and was left out."""

    @property
    def gap(self) -> float:
        """
        Distance between sheets that face each other; it is smaller on a twentieth of the area.
        """

    @property
    def aimed(self) -> float:
        """
        Tolerance that was used; for thin shapes it is smaller than the wanted one.
        """

    @property
    def uncovered(self) -> float:
        """Share of the samples farther than 4 tolerances from every cap."""

    @property
    def components(self) -> int:
        """Number of connected parts of the extracted surface."""

    @property
    def genus(self) -> int:
        """Number of handles of the extracted surface."""

    @property
    def met(self) -> bool:
        """True if the tolerance is met."""

    @property
    def topology_kept(self) -> bool:
        """
        True if the surface has as many parts and handles as the shape, or if they are not compared.
        """

    @property
    def times(self) -> dict:
        """Wall and CPU time of each stage, in seconds: (wall, cpu)."""

def compress(arg0: Mesh | PointCloud, arg1: CompressOptions, arg2: Caller, /) -> tuple: ...

class AtlasSynthesisOptions:
    """Options for extracting the surface of an atlas."""

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
    """Options of `patch_atlas`: the paper's parameters."""

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
    """
    Options of `reconstruct`: resolution, cleaning and holes of the surface.
    """

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
    """Report of `reconstruct`; lengths are in the unit of the points."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """Returns all fields by name; records in fields become dicts, too."""

    @property
    def points(self) -> int:
        """Number of given points."""

    @property
    def dropped_points(self) -> int:
        """
        Number of points dropped: not finite, at the position of another point, or without a normal.
        """

    @property
    def outliers(self) -> int:
        """Number of removed outliers."""

    @property
    def computed_normals(self) -> bool:
        """
        True if all normals were computed, because there were none or they were replaced.
        """

    @property
    def scans(self) -> ScanAlignment:
        """Report on the alignment of the scans, if there are any."""

    @property
    def unsure(self) -> float:
        """Share of the points whose computed normal has an unsure sign."""

    @property
    def turned_normals(self) -> bool:
        """True if all given normals pointed into the solid and were turned."""

    @property
    def mended_normals(self) -> int:
        """
        Number of given normals that contradicted the points around them and were turned.
        """

    @property
    def crooked_normals(self) -> float:
        """
        Share of given normals more than 45 degrees off the surface; above 0.25 all normals are computed instead.
        """

    @property
    def contradicting_normals(self) -> int:
        """
        Number of points whose normals contradict their neighbours even if turned; above half the square root of the number of points the surface is unreliable.
        """

    @property
    def contradictions(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)]:
        """Up to three points whose normals contradict their neighbours, n x 3."""

    @property
    def crossing_length(self) -> float:
        """
        Length of the lines where sheets of the points cross, in diagonals of the points; above 0.12 the surface is unreliable.
        """

    @property
    def crossings(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)]:
        """
        Up to three points near the lines where sheets of the points cross, n x 3.
        """

    @property
    def points_off_surface(self) -> float:
        """
        Share of the points that lie off the surface, between its walls or around it; above 0.5 the surface is unreliable.
        """

    @property
    def places_off_surface(self) -> Annotated[NDArray[numpy.float64], dict(writable=False)]:
        """Up to three points that lie off the surface, n x 3."""

    @property
    def inward_normals(self) -> float:
        """
        Share of the points whose given normal contradicts the winding number; above 0.1 the surface is unreliable.
        """

    @property
    def spacing(self) -> float:
        """Median distance of neighbouring points, as on a square grid."""

    @property
    def noise(self) -> float:
        """
        Standard deviation of the points along the normal; 0 if it is within the shape's own variation.
        """

    @property
    def normal_noise_degrees(self) -> float:
        """Noise of the normals relative to the surface, in degrees."""

    @property
    def neighbours(self) -> int:
        """Number of points of a typical cap."""

    @property
    def caps(self) -> int:
        """Number of caps of the atlas."""

    @property
    def step(self) -> float:
        """Edge length of the grid's cubes."""

    @property
    def holes(self) -> int:
        """Number of places without points that were closed or cut out."""

    @property
    def smooth_holes(self) -> int:
        """Number of holes closed by a surface that continues the rim."""

    @property
    def cut_handles(self) -> int:
        """
        Number of removed bridges and tunnels that are too small for the points to show.
        """

    @property
    def dropped_components(self) -> int:
        """Number of parts of the surface dropped because they are too small."""

    @property
    def full_faces(self) -> int:
        """Number of faces of the surface before simplification."""

    @property
    def simplify_error(self) -> float:
        """Error of the simplification, measured as max_error of simplify."""

    @property
    def area(self) -> float:
        """Area of the surface."""

    @property
    def closed_area(self) -> float:
        """Area of the parts of the surface that close holes."""

    @property
    def points_area(self) -> float:
        """Area that the points represent, from the circles of their neighbours."""

    @property
    def volume(self) -> float:
        """
        Signed volume inside the surface; negative if its normals point inwards.
        """

    @property
    def unseen_area(self) -> float:
        """
        Share of the surface's area without points within three spacings, if confidence is wanted.
        """

    @property
    def thin_area(self) -> float:
        """
        Share of the surface's area thinner than one and a half spacings, if confidence is wanted.
        """

    @property
    def unsure_area(self) -> float:
        """
        Share of the surface's area with a confidence below 1/2, if confidence is wanted.
        """

    @property
    def memory(self) -> int:
        """Estimated memory, in bytes."""

    @property
    def times(self) -> dict:
        """Wall and CPU time of each stage, in seconds: (wall, cpu)."""

    @property
    def bounds(self) -> Bounds:
        """Bounding box of the finite points, without points isolated far away."""

    @property
    def tiles(self) -> int:
        """Number of tiles that space was cut into."""

    @property
    def stored(self) -> int:
        """
        Largest number of bytes stored at a time between the steps of several tiles.
        """

    @property
    def vertices(self) -> int:
        """Number of vertices of the surface."""

    @property
    def faces(self) -> int:
        """Number of faces of the surface."""

    @property
    def coefficients(self) -> int:
        """Number of coefficients of all caps."""

    @property
    def warnings(self) -> list[str]:
        """Warnings from reading the file of points, list of str."""

def reconstruct(points: PointCloud | str | os.PathLike, dropped: int, columns: str, options: ReconstructOptions, foreseen: object | None, caller: Caller) -> tuple: ...

class TileForecast:
    """Estimated resources of a reconstruction in tiles."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """Returns all fields by name; records in fields become dicts, too."""

    @property
    def points(self) -> int:
        """Number of finite points, without points isolated far away."""

    @property
    def tiles(self) -> int:
        """Number of tiles that space is cut into."""

    @property
    def memory(self) -> int:
        """Memory in bytes, without the stored bytes."""

    @property
    def stored(self) -> int:
        """
        Number of bytes stored between the steps, in a folder, or in memory if there is room.
        """

    @property
    def written(self) -> int:
        """Size of the surface's file, in bytes."""

def foresee_tiles(arg0: int, arg1: int, /) -> TileForecast: ...

def region_weights(arg0: Mesh, arg1: Sequence[str], arg2: float, /) -> NDArray[numpy.float64]: ...

class PatchOptions:
    """Options of `smooth`: the detail to remove from a region."""

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
    """Vertices of a region that may move, and their positions on the fits."""

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
    """Options of `transfer`: the detail to take, and its size on the target."""

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
    """Options of `transfer` that can be updated quickly."""

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
    """Report of `transfer`; lengths are in the units of the two meshes."""

    def __repr__(self) -> str: ...

    def __getstate__(self) -> dict: ...

    def __setstate__(self, arg: object, /) -> None: ...

    def __eq__(self, arg: object, /) -> bool: ...

    def __hash__(self) -> int: ...

    def to_dict(self) -> dict:
        """Returns all fields by name; records in fields become dicts, too."""

    @property
    def source_radius(self) -> float:
        """Radius of a disc with the area of the source's base."""

    @property
    def target_radius(self) -> float:
        """Radius of a disc with the area of the target's base."""

    @property
    def scale(self) -> float:
        """Length on the target, divided by the length on the source."""

    @property
    def source_wavelength(self) -> float:
        """Wavelength of the source's base."""

    @property
    def target_wavelength(self) -> float:
        """Wavelength of the target's base."""

    @property
    def source_edge(self) -> float:
        """Median edge length of the source."""

    @property
    def target_edge(self) -> float:
        """Median edge length of the target, after refinement."""

    @property
    def source_rms(self) -> float:
        """Root mean square height of the detail in the source region."""

    @property
    def angle(self) -> float:
        """Angle of best correlation, in radians; 0 if it was not searched for."""

    @property
    def correlation(self) -> float:
        """
        Correlation with the target's own detail at the angle of best correlation, -1 ... 1.
        """

    @property
    def new_vertices(self) -> int:
        """Number of vertices added by refinement."""

class TransferSource:
    """A texture extracted from its source."""

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
    """A mesh or points in a picture; the caller keeps them alive."""

    @overload
    def __init__(self, arg0: Mesh, arg1: str, arg2: bool, arg3: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)] | None, arg4: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)] | None, /) -> None: ...

    @overload
    def __init__(self, arg0: PointCloud, arg1: str, arg2: float, arg3: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)] | None, arg4: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)] | None, /) -> None: ...

class RenderOptions:
    """Options of `render`: size, point of view, light and colours."""

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
    """Options of `report_html`: texts of the page, and size of its pictures."""

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
    """A receiver of the events of a session."""

    def wait(self, seconds: float) -> list: ...

    @property
    def ended(self) -> bool: ...

class Studio:
    """The studio without a transport: takes requests and returns responses."""

    def __init__(self, folder: str, threads: int) -> None: ...

    def handle(self, method: str, path: str, query: Mapping[str, str], body: bytes, session: str) -> tuple: ...

    def offered_session(self) -> str: ...

    def listen(self, session: str) -> StudioListener: ...

    def close(self) -> None: ...

class BatchTable:
    """Table of batch results, column by column."""

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
    """File of the finished rows of a batch."""

    def __init__(self, arg0: str, arg1: Sequence[str], arg2: int, /) -> None: ...

    @property
    def done(self) -> int: ...

    def has(self, arg: int, /) -> bool: ...

    def append(self, arg0: int, arg1: dict, /) -> None: ...

    def read(self, arg: int, /) -> dict: ...

    def remove(self) -> None: ...

def gather_batch(arg0: Sequence[str], arg1: list, /) -> BatchTable: ...

def read_batch(arg: str, /) -> BatchTable: ...
