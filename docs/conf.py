"""Sphinx configuration of the manual: `./go docs`, or `sphinx-build -W -n docs build/docs/html`."""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent / "_ext"))

import numpydoc.xref

import viscontact
import viscontact.verify
from viscontact import identification

project = "viscontact"
author = "The viscontact developers"
copyright = f"{author}, MIT licence"  # Sphinx requires this name
version = release = viscontact.__version__

extensions = [
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.intersphinx",
    "sphinx.ext.viewcode",
    "numpydoc",
    "myst_parser",
    "sphinx_copybutton",
    "sphinx_gallery.gen_gallery",
    "equations",
    "line_breaks",
    "docstrings",
    "offline",
    "made_pages",
]
numfig = math_numfig = True  # (4.2) is the second equation of the fourth page of the theory
numfig_secnum_depth = 1
numfig_format = {"figure": "%.0s", "table": "%.0s", "code-block": "%.0s"}  # no numbers
templates_path = ["_templates"]
exclude_patterns = [
    "_ext",
    "_inventories",
    "_static",
    "_templates",
    "gallery",
    "generated/gallery/**/*.ipynb",
]
nitpicky = True
suppress_warnings = ["config.cache"]  # due to the gallery's scraper, a function

# --- pages in Markdown --------------------------------------------------------------------------

myst_enable_extensions = ["dollarmath", "colon_fence", "deflist", "attrs_inline", "attrs_block"]
myst_heading_anchors = 3
myst_dmath_double_inline = True

# --- the API ------------------------------------------------------------------------------------

default_role = "autolink"  # links names in docstrings if they are public
nitpick_ignore_regex = [("py:obj", r"functools\..*")]  # not in an inventory below
autosummary_generate = True
autodoc_preserve_defaults = True  # as they are written: some are long
autodoc_typehints = "none"  # numpydoc's sections say it
numpydoc_show_class_members = False
# Types of ours, of NumPy and of xarray are links; other words are not.
numpydoc_xref_param_type = True
numpydoc_xref_ignore = "all"
numpydoc.xref.DEFAULT_LINKS.clear()
numpydoc_xref_aliases = {
    name: f"{package.__name__}.{name}"
    for package in (viscontact.verify, viscontact.reference, identification, viscontact)
    for name in package.__all__
    if name[0].isupper()
} | {
    "Animation": "viscontact.plot.Animation",
    "Richardson": "viscontact.simulation.accuracy.richardson.Richardson",
    "ndarray": "numpy.ndarray",
    # numpydoc links no name that is its own alias; the dot changes nothing else.
    "xarray.DataArray": ".xarray.DataArray",
    "xarray.DataTree": ".xarray.DataTree",
    "xarray.Dataset": ".xarray.Dataset",
}
# The names that are linked, so that the build needs no network; by hand from the manuals at these
# addresses.
intersphinx_mapping = {
    "numpy": ("https://numpy.org/doc/stable/", "_inventories/numpy.inv"),
    "xarray": ("https://docs.xarray.dev/en/stable/", "_inventories/xarray.inv"),
}
# What is copied are the commands, without their prompts and what they print.
copybutton_prompt_text = r">>> |\.\.\. |\$ "
copybutton_prompt_is_regexp = True
add_module_names = False
toc_object_entries_show_parents = "hide"  # the page says whose they are

# --- the gallery --------------------------------------------------------------------------------

sphinx_gallery_conf = {
    "examples_dirs": "gallery",
    "gallery_dirs": "examples",
    "backreferences_dir": "reference/generated/examples",  # which examples use a name
    "doc_module": ("viscontact",),
    "filename_pattern": r"\.py$",
    "image_scrapers": ("gallery_figures.pictures",),
    "reset_modules": ("gallery_figures.set_style",),
    "download_all_examples": False,
    "remove_config_comments": True,
    "show_memory": False,
    "capture_repr": (),  # what a block prints is shown, not what its last line happens to return
    "show_signature": False,
    "write_computation_times": False,
    "within_subsection_order": "FileNameSortKey",
    "copyfile_regex": r".*\.(csv|npz|yaml)",
    "abort_on_example_error": True,
}

# --- looks --------------------------------------------------------------------------------------

html_theme = "pydata_sphinx_theme"
html_context = {"default_mode": "auto"}  # else the theme complains of none at a first visit
html_title = "viscontact"
html_static_path = ["_static"]
html_css_files = ["viscontact.css"]
html_math_renderer = "mathml"
html_copy_source = False
html_show_sourcelink = False
html_show_sphinx = False
html_theme_options = {
    "logo": {"text": "viscontact"},
    "header_links_before_dropdown": 8,
    "navbar_align": "left",
    "navbar_end": ["theme-switcher"],
    "show_toc_level": 2,
    "footer_start": ["copyright"],
    "footer_end": [],
    "secondary_sidebar_items": ["page-toc"],
    "pygments_light_style": "a11y-high-contrast-light",
    "pygments_dark_style": "a11y-high-contrast-dark",
}
html_sidebars = {"index": [], "tutorial": []}
