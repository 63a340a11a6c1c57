"""Converts shapes and coefficients of other packages. A package is imported only if one of its
objects is given, or asked for.
"""

from __future__ import annotations

import importlib
import inspect
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import plain_array
from ._errors import InvalidInputError

if TYPE_CHECKING:
    import meshio
    import pyvista
    import trimesh

    from ._coefficients import Normalization
    from ._expansion import Expansion
    from ._shapes import Mesh, PointCloud

Arrays = tuple[Any, Any, dict[str, npt.NDArray[Any]]]


def required(name: str, extra: str | None = None) -> Any:
    """Imports an optional package. The ImportError tells how to install it."""
    try:
        return importlib.import_module(name)
    except ImportError as error:
        text = f"{name} is needed for this: pip install 'rholm[{extra or name}]'"
        raise ImportError(text, name=error.name) from error


def _package(value: Any) -> str:
    """Returns the package that defines an object's class or base class."""
    for kind in type(value).__mro__:
        root = kind.__module__.partition(".")[0]
        if root in ("trimesh", "pyvista", "meshio", "vtkmodules", "pyshtools", "open3d"):
            return root
    return ""


def foreign_has_faces(shape: Any) -> bool | None:
    """Returns True for a mesh of another package, False for points, None for any other object."""
    package = _package(shape)
    if package == "trimesh":
        return hasattr(shape, "faces") or hasattr(shape, "geometry")
    if package in ("pyvista", "vtkmodules"):
        # Points in PyVista also have cells: one without edges for each point.
        return bool(getattr(shape, "n_faces_strict", 1)) or bool(getattr(shape, "n_strips", 0))
    if package == "meshio":
        return any(_is_polygons(block.type) for block in shape.cells)
    if package == "open3d":
        return hasattr(shape, "triangles")
    return None


def foreign_mesh(shape: Any) -> Arrays | None:
    """Returns (vertices, faces, attributes) of another package's mesh; None for any other object."""
    package = _package(shape)
    if package == "trimesh":
        return _trimesh_mesh(shape)
    if package == "pyvista":
        return _pyvista_mesh(shape)
    if package == "meshio":
        return _meshio_mesh(shape)
    if package == "open3d" and hasattr(shape, "triangles"):
        return np.asarray(shape.vertices), np.asarray(shape.triangles), {}
    return None


def _trimesh_mesh(shape: Any) -> Arrays:
    if hasattr(shape, "geometry"):  # a scene
        shape = shape.to_mesh() if hasattr(shape, "to_mesh") else shape.dump(concatenate=True)
    if not hasattr(shape, "faces"):
        raise InvalidInputError(f"a trimesh.{type(shape).__name__} has no faces")
    attributes = {
        name: np.asarray(values)
        for name, values in shape.vertex_attributes.items()
        if np.asarray(values).ndim <= 2 and np.asarray(values).dtype.kind in "fiub"
    }
    if shape.visual.kind == "vertex":
        attributes["rgba"] = np.asarray(shape.visual.vertex_colors)
    return shape.vertices.view(np.ndarray), shape.faces.view(np.ndarray), attributes


def _pyvista_mesh(shape: Any) -> Arrays:
    if not hasattr(shape, "regular_faces"):
        # PyVista from 0.47 on chooses the algorithm only if asked to.
        chosen = "algorithm" in inspect.signature(shape.extract_surface).parameters
        shape = shape.extract_surface(**({"algorithm": None} if chosen else {}))
    if not shape.is_all_triangles:
        shape = shape.triangulate()
    return np.asarray(shape.points), np.asarray(shape.regular_faces), _point_data(shape)


def _point_data(shape: Any) -> dict[str, npt.NDArray[Any]]:
    data = {str(name): np.asarray(values) for name, values in shape.point_data.items()}
    if "Normals" in data:
        data["normals"] = data.pop("Normals")
    return {name: values for name, values in data.items() if values.ndim <= 2 and values.dtype.kind in "fiub"}


def _meshio_mesh(shape: Any) -> Arrays:
    blocks = _polygons(shape.cells)
    if not sum(len(block) for block in blocks):
        kinds = ", ".join(sorted({block.type for block in shape.cells})) or "none"
        raise InvalidInputError(f"the meshio.Mesh has no polygons; its cells: {kinds}")
    data = {name: np.asarray(values) for name, values in shape.point_data.items()}
    points = plain_array(shape.points, "points of the meshio.Mesh")
    if points.shape[1] != 3:
        raise InvalidInputError(f"the meshio.Mesh has points of {points.shape[1]} coordinates")
    blocks = [_cut(points, block) for block in blocks]
    return points, np.concatenate(blocks), {k: v for k, v in data.items() if v.dtype.kind in "fiub"}


#: Surface cells of meshio with additional nodes on curved edges.
_CURVED = ("triangle", "quad", "VTK_LAGRANGE_TRIANGLE", "VTK_LAGRANGE_QUADRILATERAL")


def _is_polygons(cell: str) -> bool:
    return cell in ("triangle", "quad") or cell.startswith("polygon")


def _polygons(cells: list[Any]) -> list[npt.NDArray[Any]]:
    """Returns the polygons of meshio cells, one array per block with a row of corners per polygon."""
    blocks = []
    for block in cells:
        if _is_polygons(block.type):
            blocks.append(np.asarray(block.data))
        elif block.type.startswith(_CURVED):
            raise InvalidInputError(
                f"the meshio.Mesh has cells of the type {block.type}, whose edges have nodes between their "
                "ends: make triangles of them first"
            )
    return blocks


def _cut(points: npt.NDArray[Any], polygons: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """Returns polygons cut into triangles, in the same way as polygons of files."""
    if polygons.shape[1] == 3:
        return polygons
    if polygons.shape[1] < 3:
        return np.empty((0, 3), np.int64)
    rows = np.ascontiguousarray(points, dtype=np.float64)
    if polygons.size and (polygons.min() < 0 or polygons.max() >= len(rows)):
        raise InvalidInputError(
            f"a cell of the meshio.Mesh names a point that is not within 0 ... {len(rows) - 1}"
        )
    return _core.cut_polygons(rows, np.ascontiguousarray(polygons, dtype=np.uint32))


def foreign_points(shape: Any) -> tuple[Any, Any, Any] | None:
    """Returns (points, normals or None, attributes) of another package's points; None for any other
    object.
    """
    package = _package(shape)
    if package == "trimesh":
        if hasattr(shape, "faces"):
            return np.asarray(shape.vertices), np.asarray(shape.vertex_normals), {}
        colors = getattr(shape, "colors", None)
        attributes = {"rgba": np.asarray(colors)} if colors is not None and len(colors) else {}
        return np.asarray(shape.vertices), None, attributes
    if package == "pyvista":
        data = _point_data(shape)
        return np.asarray(shape.points), data.pop("normals", None), data
    if package == "meshio":
        data = {name: np.asarray(values) for name, values in shape.point_data.items()}
        return np.asarray(shape.points), data.pop("normals", None), data
    if package == "open3d":
        normals = np.asarray(shape.normals) if shape.has_normals() else None
        attributes = {"rgb": np.asarray(shape.colors)} if shape.has_colors() else {}
        return np.asarray(shape.points), normals, attributes
    return None


def mesh_to_trimesh(mesh: Mesh) -> trimesh.Trimesh:
    """Converts a mesh; see `Mesh.to_trimesh`."""
    trimesh = required("trimesh")
    attributes = {name: values.copy() for name, values in mesh.attributes.items()}
    normals = mesh.normals if "nx" in attributes else None
    for name in ("nx", "ny", "nz"):
        attributes.pop(name, None)
    colors = mesh.colors
    for name in ("red", "green", "blue"):
        attributes.pop(name, None)
    return trimesh.Trimesh(
        vertices=np.array(mesh.vertices),
        faces=np.array(mesh.faces, dtype=np.int64),
        vertex_normals=normals,
        vertex_colors=None if colors is None else np.round(255 * colors).astype(np.uint8),
        vertex_attributes=attributes,
        process=False,
        validate=False,
    )


def cloud_to_trimesh(cloud: PointCloud) -> trimesh.PointCloud:
    """Converts points; see `PointCloud.to_trimesh`."""
    return required("trimesh").PointCloud(np.array(cloud.points))


def _set_point_data(data: Any, attributes: dict[str, npt.NDArray[Any]]) -> None:
    for names, together in ((("nx", "ny", "nz"), "Normals"), (("red", "green", "blue"), "rgb")):
        if all(name in attributes for name in names):
            data[together] = np.stack([attributes.pop(name) for name in names], axis=1)
    for name, values in attributes.items():
        data[name] = values.copy()  # the other package may share its memory


def mesh_to_pyvista(mesh: Mesh) -> pyvista.PolyData:
    """Converts a mesh; see `Mesh.to_pyvista`."""
    pyvista = required("pyvista")
    faces = np.array(mesh.faces, dtype=np.int64)
    result = pyvista.PolyData.from_regular_faces(np.array(mesh.vertices), faces)
    _set_point_data(result.point_data, mesh.attributes)
    return result


def cloud_to_pyvista(cloud: PointCloud) -> pyvista.PolyData:
    """Converts points; see `PointCloud.to_pyvista`."""
    result = required("pyvista").PolyData(np.array(cloud.points))
    if cloud.normals is not None:
        result.point_data["Normals"] = np.array(cloud.normals)
    _set_point_data(result.point_data, cloud.attributes)
    return result


def mesh_to_meshio(mesh: Mesh) -> meshio.Mesh:
    """Converts a mesh; see `Mesh.to_meshio`."""
    return required("meshio").Mesh(
        np.array(mesh.vertices),
        [("triangle", np.array(mesh.faces, dtype=np.int64))],
        point_data={name: values.copy() for name, values in mesh.attributes.items()},
    )


def to_pyshtools(expansion: Expansion, normalization: Normalization = "4pi", csphase: int = 1) -> Any:
    """Converts an expansion; see `Expansion.to_pyshtools`."""
    pyshtools = required("pyshtools")
    names = {"4pi": "4pi", "orthonormal": "ortho", "schmidt": "schmidt"}
    return pyshtools.SHCoeffs.from_array(
        expansion.to_array(normalization, csphase),
        normalization=names[normalization],
        csphase=csphase,
        units=expansion.unit or None,
        name=expansion.method or None,
    )


def to_xarray(expansion: Expansion, normalization: Normalization = "4pi", csphase: int = 1) -> Any:
    """Converts an expansion; see `Expansion.to_xarray`."""
    degrees = np.arange(expansion.degree + 1)
    return required("xarray").DataArray(
        expansion.to_array(normalization, csphase),
        dims=("kind", "l", "m"),
        coords={"kind": ["c", "s"], "l": degrees, "m": degrees},
        name=expansion.function,
        attrs={
            "normalization": normalization,
            "csphase": csphase,
            "center": expansion.center.copy(),
            "units": expansion.unit,
            "method": expansion.method,
            **_gravity_of(expansion),
        },
    )


def _gravity_of(expansion: Expansion) -> dict[str, float]:
    gravity = expansion.gravity
    if gravity is None:
        return {}
    return {"gravity_constant": gravity.gravity_constant, "reference_radius": gravity.reference_radius}


def coefficients_of_pyshtools(clm: Any) -> tuple[npt.NDArray[np.float64], str, int]:
    """Returns (array, normalization, csphase) of real or complex pyshtools.SHCoeffs."""
    names = {"4pi": "4pi", "ortho": "orthonormal", "schmidt": "schmidt"}
    if clm.normalization not in names:
        clm = clm.convert(normalization="ortho")
    if clm.kind == "complex":
        clm = clm.convert(kind="real", check=True)
    return np.asarray(clm.coeffs, dtype=np.float64), names[clm.normalization], int(clm.csphase)
