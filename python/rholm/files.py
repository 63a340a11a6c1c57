"""Files of shapes, coefficients and models, and tables of many shapes."""

from __future__ import annotations

from ._batch import BatchTable, batch, read_batch
from ._convert import attributes_left_out, write_shape
from ._formats import FileFormat, coefficients_formats, shape_formats
from ._model_files import (
    CoefficientsFile,
    coefficients_format_of,
    is_atlas_file,
    is_model_file,
    load,
    looks_like_coefficients,
    parse_coefficients,
    read_any_coefficients,
    read_atlas,
    read_coefficients,
    read_model,
    write_atlas,
    write_coefficients,
    write_file,
    write_model,
)
from ._shape_files import ShapeFile, map_mesh, parse_shape, read_shape

__all__ = [
    "BatchTable",
    "CoefficientsFile",
    "FileFormat",
    "ShapeFile",
    "attributes_left_out",
    "batch",
    "coefficients_format_of",
    "coefficients_formats",
    "is_atlas_file",
    "is_model_file",
    "load",
    "looks_like_coefficients",
    "map_mesh",
    "parse_coefficients",
    "parse_shape",
    "read_any_coefficients",
    "read_atlas",
    "read_batch",
    "read_coefficients",
    "read_model",
    "read_shape",
    "shape_formats",
    "write_atlas",
    "write_coefficients",
    "write_file",
    "write_model",
    "write_shape",
]
