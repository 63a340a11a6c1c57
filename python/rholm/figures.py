"""Pictures, reports, and views in notebooks."""

from __future__ import annotations

from ._atlas import patch_picture, set_cap_colors, set_degree_colors
from ._pictures import Panel, Picture, encode_png, render, report_html, spectrum_svg, write_png
from ._studio import Studio, studio
from ._view import view, view_data

__all__ = [
    "Panel",
    "Picture",
    "Studio",
    "encode_png",
    "patch_picture",
    "render",
    "report_html",
    "set_cap_colors",
    "set_degree_colors",
    "spectrum_svg",
    "studio",
    "view",
    "view_data",
    "write_png",
]
