"""Docstrings as pages: escapes for reStructuredText, default values, links to public names."""

from __future__ import annotations

import re
import sys
from collections.abc import Mapping
from typing import Any

from docutils import nodes
from sphinx.addnodes import pending_xref
from sphinx.application import Sphinx
from sphinx.environment import BuildEnvironment
from sphinx.util.nodes import make_refnode
from sphinx.util.typing import ExtensionMetadata

import viscontact

#: An initial at the beginning of a line or reference: "M. L. Williams" would be item 13 of a list.
_INITIAL = re.compile(r"^(\s*(?:\.\. \[\d+\] )?)([A-Z]\. )")

_CONSTANT = re.compile(r"(?<==)_?[A-Z_]{2,}\b")
_SHOWN = 60  # characters of a default; a longer one is shown by its name
_BACK = re.compile(r"(?<=/generated/)([\w.]+)\.html#([\w.]+)")

#: Modules without their own page, and the pages that describe them.
MODULE_PAGES = {
    "viscontact.identification.overlap": "theory/identification",
    "viscontact.bodies.series_fits.spectrum": "theory/identification",
    "viscontact.plot": "reference/python/plotting",
    "viscontact.mechanics.halfspace.stress": "theory/stresses",
}


def as_written(lines: list[str]) -> list[str]:
    r"""Return a docstring with escaped bars and first initials, except in examples.

    Parameters
    ----------
    lines : list of str
        The docstring.

    Returns
    -------
    list of str
        The same number of lines.

    Examples
    --------
    >>> as_written(["R for |x| <= L", ">>> 1 | 2", "3", "", "K. L. Johnson"])
    ['R for \\|x\\| <= L', '>>> 1 | 2', '3', '', '\\K. L. Johnson']
    """
    escaped, is_example = [], False
    for line in lines:
        is_example = line.lstrip().startswith(">>>") or (is_example and bool(line.strip()))
        escaped.append(line if is_example else _INITIAL.sub(r"\1\\\2", line.replace("|", r"\|")))
    return escaped


def _escape(
    app: Sphinx, what: str, name: str, documented: Any, options: Any, lines: list[str]
) -> None:
    lines[:] = as_written(lines)


def by_value(arguments: str, constants: Mapping[str, Any]) -> str:
    """Return a signature with values in place of the names of constant defaults.

    Parameters
    ----------
    arguments : str
        The signature.
    constants : mapping of str to object
        Values by name.

    Returns
    -------
    str
        The signature; long values are shown by their names.

    Examples
    --------
    >>> by_value("(law, excess=_EXCESS)", {"_EXCESS": 1.05})
    '(law, excess=1.05)'
    """

    def value(found: re.Match[str]) -> str:
        name = found[0]
        shown = repr(constants[name]) if name in constants else name
        return shown if len(shown) <= _SHOWN else name

    return _CONSTANT.sub(value, arguments)


def _show_defaults(
    app: Sphinx, what: str, name: str, documented: Any, options: Any, arguments: str, returns: str
) -> tuple[str, str] | None:
    module = sys.modules.get(getattr(documented, "__module__", ""))
    return (by_value(arguments, vars(module)), returns) if arguments and module else None


def _public(
    app: Sphinx, env: BuildEnvironment, node: pending_xref, shown: nodes.Element
) -> nodes.Element | None:
    # A name that is public in another module than that of the docstring, or a module.
    target = str(node["reftarget"])
    if target in MODULE_PAGES:
        return make_refnode(app.builder, node["refdoc"], MODULE_PAGES[target], "", shown)
    name = target.rpartition(".")[2]
    if node.get("refdomain") != "py" or name not in viscontact.__all__:
        return None
    return env.domains.python_domain.resolve_xref(
        env, node["refdoc"], app.builder, "obj", f"viscontact.{name}", node, shown
    )


def linked_back(body: str) -> str:
    """Return a source page whose links point to the documentation of its names.

    Parameters
    ----------
    body : str
        The page of one module. Sphinx assumes that all its names are documented in the package
        that documents the first of them.

    Returns
    -------
    str
        The page, with each anchor in the package of the page it is on.

    Examples
    --------
    >>> linked_back("../generated/viscontact.plot.Animation.html#viscontact.Animation.seconds")
    '../generated/viscontact.plot.Animation.html#viscontact.plot.Animation.seconds'
    """

    def relinked(found: re.Match[str]) -> str:
        page, anchor = found.groups()
        if anchor.startswith(page):
            return found[0]
        return f"{page}.html#{page}{anchor.partition(page.rpartition('.')[2])[2]}"

    return _BACK.sub(relinked, body)


def _link_back(app: Sphinx, page: str, template: str, context: dict[str, Any], tree: Any) -> None:
    if page.startswith("_modules/"):
        context["body"] = linked_back(context["body"])


def setup(app: Sphinx) -> ExtensionMetadata:
    """Escape docstrings before numpydoc parses them, and resolve missing links."""
    app.connect("autodoc-process-docstring", _escape, priority=100)
    app.connect("autodoc-process-signature", _show_defaults)
    app.connect("missing-reference", _public)
    app.connect("html-page-context", _link_back)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
