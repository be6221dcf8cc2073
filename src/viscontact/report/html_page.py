"""Page of HTML with interactive figures, which needs nothing from outside."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from importlib.resources import files
from string import Template
from xml.etree.ElementTree import Element

from plotly.graph_objects import Figure
from plotly.offline import get_plotlyjs

from viscontact import __version__
from viscontact.drawing.plotly.parts import plain
from viscontact.drawing.svg.html import as_script, element, written


def html_page(title: str, parts: Iterable[Element], figures: Sequence[Figure] = ()) -> str:
    """Page of some parts; interactive figures are drawn in the boxes with their names."""
    folder = files("viscontact.report")
    template = Template((folder / "page.html").read_text(encoding="utf-8"))
    return template.substitute(
        generator=f"viscontact {__version__}",
        title=written(element("title", title)),
        style=(folder / "page.css").read_text(encoding="utf-8"),
        body="\n".join(map(written, parts)),
        scripts=_scripts(figures),
    )


def _scripts(figures: Sequence[Figure]) -> str:
    """Scripts that draw figures in the boxes with their names; empty without a figure."""
    if not figures:
        return ""
    data = as_script([plain(each) for each in figures])
    return f"""<script type="application/json" id="figures">{data}</script>
<script>
{get_plotlyjs()}
</script>
<script>
(() => {{
"use strict";
{_figures_script()}
open(JSON.parse(document.getElementById("figures").textContent));
}})();
</script>
"""


def _figures_script() -> str:
    """Script of the figures, which is a module on the calculator page, as part of another."""
    script = (files("viscontact.drawing.plotly") / "linked.js").read_text(encoding="utf-8")
    return script.replace("export function", "function")
