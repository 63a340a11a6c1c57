"""Extends Sphinx for the site: lists of the API, pictures in the gallery."""

import importlib
import inspect
import re
import shutil

import rholm
from docutils import nodes
from docutils.parsers.rst import Directive
from docutils.statemachine import StringList
from sphinx.util.nodes import nested_parse_with_titles

# The gallery's order: from what everybody meets to what few need.
GALLERY = [
    "levels_of_detail",
    "spectrum_and_tail",
    "tolerance",
    "filters",
    "align",
    "recenter",
    "population",
    "reconstruct",
    "compress",
    "scratch",
    "texture",
    "grain",
]


class GalleryOrder:
    """Where a script stands in the gallery."""

    def __init__(self, folder):
        pass

    def __call__(self, name):
        """The place of a script, by the name of its file."""
        return GALLERY.index(name.removesuffix(".py"))


def pictures(block, block_vars, gallery_conf):
    """The pictures of rholm that a block of a script ends with, as sphinx-gallery wants them."""
    from sphinx_gallery.scrapers import figure_rst

    shown = block_vars["example_globals"].get("___")
    paths = []
    if isinstance(shown, rholm.figures.Picture):
        path = next(block_vars["image_path_iterator"])
        shown.save(path)
        paths.append(path)
        block_vars["example_globals"]["___"] = None  # it is shown once
    return figure_rst(paths, gallery_conf["src_dir"])


def plain_figures(gallery_conf, name):
    """Plots that suit the pages: called before each script."""
    from matplotlib import pyplot

    pyplot.rcParams.update(
        {
            "figure.figsize": (7, 4),
            "figure.dpi": 110,
            "figure.constrained_layout.use": True,
            "axes.grid": True,
            "axes.spines.top": False,
            "axes.spines.right": False,
            "grid.color": "0.88",
            "lines.linewidth": 1.6,
            "font.size": 10,
        }
    )


MODULES = ("harmonics", "meshes", "clouds", "files", "figures")
#: The full name of every public name. Names at the top of the package are shown there.
PLACES = {
    **{
        name: f"rholm.{module}.{name}"
        for module in MODULES
        for name in importlib.import_module(f"rholm.{module}").__all__
    },
    **{name: f"rholm.{name}" for name in rholm.__all__},
}


def thing_of(name):
    """The object with a public name."""
    module, _, last = PLACES[name].rpartition(".")
    return getattr(importlib.import_module(module), last)


class Api(Directive):
    """.. api:: NAME...: a table of these names of rholm, then each with its documentation."""

    has_content = True

    def run(self):
        """Returns the nodes that docutils puts in the directive's place."""
        names = " ".join(self.content).split()
        lines = [".. autosummary::", "   :nosignatures:", ""]
        lines += [f"   {PLACES[name].removeprefix('rholm.')}" for name in names] + [""]
        for name in names:
            thing = thing_of(name)
            if inspect.isclass(thing):
                kind = "autoexception" if issubclass(thing, BaseException) else "autoclass"
                lines += [f".. {kind}:: {PLACES[name]}"]
                if kind == "autoclass":
                    lines += ["   :members:"]
                    if thing.__base__.__module__ in ("rholm._tables", "rholm._shown"):
                        lines += ["   :inherited-members:"]
                if issubclass(thing, tuple):  # made by the library only: no signature
                    lines += ["   :exclude-members: count, index"]
                if "__call__" in vars(thing):
                    lines += ["   :special-members: __call__"]
            else:
                kind = "function" if callable(thing) else "data"
                lines += [f".. auto{kind}:: {PLACES[name]}"]
            lines += [""]
        node = nodes.section()
        node.document = self.state.document
        nested_parse_with_titles(self.state, StringList(lines, "api"), node)
        return node.children


def mark_parameters(app, what, name, thing, options, lines):
    """`parameter` in a docstring is code; other words in single backquotes are links."""
    try:
        words = set(inspect.signature(thing).parameters)
    except (TypeError, ValueError):
        words = set()

    def marked(match):
        word, rest = match.groups()
        if word in words and not rest:
            return f"``{word}``"
        return (
            f":py:obj:`{word}{rest} <{PLACES[word]}{rest}>`" if word in PLACES else match[0]
        )

    for i, line in enumerate(lines):
        lines[i] = re.sub(r"(?<![`:])`(\w+)((?:\.\w+)*)`(?!`)", marked, line)


def no_signature(app, what, name, thing, options, signature, answer):
    """Hides the signatures of classes that only the library makes, as users do not call them."""
    made = (
        "Atlas",
        "Picture",
        "SmoothEditor",
        "StarChart",
        "TransferEditor",
        "TransferSource",
    )
    if (
        what == "class"
        and signature
        and (issubclass(thing, tuple) or thing.__name__ in made)
    ):
        return "", None
    return None


def copy_api_of_cpp(app, error):
    """The pages that Doxygen made, beside ours."""
    pages = app.srcdir.parent / "cpp" / "html"
    if error is None and pages.exists():
        shutil.copytree(pages, app.outdir / "cpp", dirs_exist_ok=True)


def setup(app):
    """Called by Sphinx."""
    app.add_directive("api", Api)
    app.connect("autodoc-process-docstring", mark_parameters)
    app.connect("autodoc-process-signature", no_signature)
    app.connect("build-finished", copy_api_of_cpp)
    return {"parallel_read_safe": True}
