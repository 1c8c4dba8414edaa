"""How Sphinx builds the book: ``make docs``."""

from __future__ import annotations

import os
import sys
import warnings
from pathlib import Path

import matplotlib as mpl

import pyfret
from pyfret._util import theme

# What the pages run is run with this interpreter, whichever comes first on PATH otherwise.
os.environ["PATH"] = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])

project = "pyfret"
author = "The pyfret developers"
copyright = "the pyfret developers; MIT or Apache-2.0"
version = release = pyfret.__version__

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    # MathJax comes with the book: formulas show without a network.
    "sphinx-mathjax-offline",
    "sphinx_copybutton",
    "sphinx_gallery.gen_gallery",
    "sphinxcontrib.programoutput",
]
exclude_patterns = ["gallery/*.ipynb", "gallery/GALLERY_HEADER.rst"]
source_suffix = {".rst": "restructuredtext", ".md": "markdown"}

myst_enable_extensions = ["dollarmath", "amsmath"]
myst_heading_anchors = 3
# Pages that other tools write begin at any level.
# A type named "path" is no reference to an attribute of that name.
suppress_warnings = ["myst.header", "config.cache", "ref.python"]

autodoc_member_order = "bysource"
autodoc_typehints = "none"
napoleon_google_docstring = False
napoleon_use_rtype = False

html_theme = "furo"
html_theme_options = {
    f"{name}_css_variables": {
        "color-brand-primary": values["--accent"],
        "color-brand-content": values["--accent"],
        "color-background-primary": values["--ground"],
        "color-foreground-primary": values["--ink"],
        "font-stack": values["--font"],
        # No text below 12 pixels.
        "sidebar-caption-font-size": "0.8rem",
        "toc-title-font-size": "0.8rem",
        "toc-font-size": "0.8rem",
    }
    for name, values in (("light", theme.variables()), ("dark", theme.variables(dark=True)))
}
html_title = f"pyfret {release}"
html_copy_source = False
html_static_path = ["_static"]
html_js_files = ["accessible.js"]

warnings.filterwarnings("ignore", category=pyfret.errors.SceneWarning)


def use_theme(_: object, __: str) -> None:
    """Give the figures of the gallery the theme."""
    mpl.rcParams.update(theme.settings())


sphinx_gallery_conf = {
    "reset_modules": ("matplotlib", use_theme),
    "examples_dirs": [str(Path(__file__).parents[1] / "examples" / "gallery")],
    "gallery_dirs": ["gallery"],
    "filename_pattern": r"\.py$",
    "download_all_examples": False,
    "show_memory": False,
    "remove_config_comments": True,
    "abort_on_example_error": True,
    "write_computation_times": False,
}
