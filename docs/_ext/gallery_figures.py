"""Figures of the gallery, found as objects because pyplot does not register them."""

from __future__ import annotations

from collections.abc import Iterator
from textwrap import indent
from typing import Any
from weakref import WeakSet

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from sphinx_gallery.scrapers import figure_rst

_shown: WeakSet[Figure] = WeakSet()

#: A figure wider than this [inch] has panels side by side, with text too small on a phone.
WIDE = 6.5

#: Style of figures drawn by the examples, like that of the package: no axes lines at the top and
#: right, thin lines and small text.
STYLE = {
    "axes.labelsize": 9,
    "axes.linewidth": 0.6,
    "axes.spines.right": False,
    "axes.spines.top": False,
    "axes.titlesize": 9,
    "legend.fontsize": 8,
    "legend.title_fontsize": 8,
    "lines.linewidth": 1.4,
    "xtick.labelsize": 8,
    "xtick.major.width": 0.6,
    "ytick.labelsize": 8,
    "ytick.major.width": 0.6,
}


def set_style(gallery_conf: dict[str, Any], script: str) -> None:
    """Set the style before each example.

    Parameters
    ----------
    gallery_conf, script
        As sphinx-gallery gives them.
    """
    mpl.rcParams.update(STYLE)


def pictures(block: Any, block_vars: dict[str, Any], gallery_conf: dict[str, Any]) -> str:
    """Save each figure created by a block of an example, and return its reStructuredText.

    Parameters
    ----------
    block, block_vars, gallery_conf
        As sphinx-gallery gives them: ``block_vars`` contains the variables of the example and the
        paths of the images.

    Returns
    -------
    str
        The images in reStructuredText.
    """
    paths, wide = [], False
    for figure in _figures(block_vars["example_globals"].values()):
        if figure in _shown:
            continue
        _shown.add(figure)
        path = next(block_vars["image_path_iterator"])
        figure.savefig(path, dpi=110, bbox_inches="tight", facecolor="white")
        paths.append(path)
        wide = wide or figure.get_figwidth() > WIDE
    shown = str(figure_rst(paths, gallery_conf["src_dir"]))
    return f".. container:: wide-figure\n\n{indent(shown, '    ')}" if wide else shown


def _figures(values: Any) -> Iterator[Figure]:
    for value in list(values):
        if isinstance(value, Figure):
            yield value
        elif isinstance(value, Axes) and isinstance(value.figure, Figure):
            yield value.figure
