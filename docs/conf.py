"""Settings of Sphinx; scripts/docs runs it on a copy of this folder."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent / "site"))

import rholm
import rholm_site

project = "rholm"
author = "The rholm developers"
copyright = "The rholm developers, Apache-2.0"
release = version = rholm.__version__

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "numpydoc",
    "sphinx_gallery.gen_gallery",
    "sphinx_copybutton",
    "sphinx_design",
    "rholm_site",
]
exclude_patterns = [
    "site",
    "gallery/*.ipynb",
    "gallery/*.py",
    "gallery/*.json",
    "sg_execution_times.rst",
]
root_doc = "index"
nitpicky = True
# Words of other packages, named where a function takes or gives one of their objects.
nitpick_ignore_regex = [
    ("py:obj", r"(meshio|matplotlib|numpy|pyshtools|pyvista|scipy|trimesh|xarray)\..*")
]
default_role = "py:obj"

myst_enable_extensions = ["colon_fence", "attrs_inline", "attrs_block"]
myst_heading_anchors = 4

autodoc_typehints = "none"
autodoc_docstring_signature = False
suppress_warnings = ["config.cache"]  # sphinx-gallery is given functions
autodoc_member_order = "bysource"
autosummary_generate = False
numpydoc_show_class_members = False
numpydoc_class_members_toctree = False
add_module_names = True
toc_object_entries_show_parents = "hide"

sphinx_gallery_conf = {
    "examples_dirs": "../gallery",
    "gallery_dirs": "gallery",
    "filename_pattern": r"\.py$",
    "within_subsection_order": rholm_site.GalleryOrder,
    "image_scrapers": (rholm_site.pictures, "matplotlib"),
    "capture_repr": ("__str__",),
    "ignore_repr_types": r"NoneType|Picture|Axes|Figure|Text|Line2D|list|tuple|ndarray",
    "thumbnail_size": (640, 240),
    "min_reported_time": 1e9,
    "write_computation_times": False,
    "show_memory": False,
    "show_signature": False,
    "remove_config_comments": True,
    "reset_modules": ("matplotlib", rholm_site.plain_figures),
    "abort_on_example_error": True,
    "download_all_examples": False,
}

html_theme = "pydata_sphinx_theme"
html_title = f"rholm {release}"
html_static_path = ["site/static"]
html_css_files = ["style.css"]
html_show_sphinx = False
html_show_sourcelink = False
html_copy_source = False
html_domain_indices = False
html_theme_options = {
    "logo": {"text": f"rholm {release}"},
    "navbar_align": "left",
    "navbar_persistent": [],
    "navbar_end": ["search-button-field", "theme-switcher"],
    "header_links_before_dropdown": 6,
    "show_prev_next": True,
    "show_nav_level": 1,
    "navigation_with_keys": False,
    "secondary_sidebar_items": ["page-toc"],
    "footer_start": ["copyright"],
    "footer_end": [],
    "pygments_light_style": "tango",
    "pygments_dark_style": "monokai",
}
html_sidebars = {"index": [], "start": []}
copybutton_exclude = ".linenos, .gp, .go"
copybutton_selector = "div:not(.highlight-text) > div.highlight > pre"
