"""Scripts of a page with interactive figures, which needs nothing from outside."""

from __future__ import annotations

from collections.abc import Sequence
from importlib.resources import files

from plotly.graph_objects import Figure
from plotly.offline import get_plotlyjs

from viscontact.figures.look import plain
from viscontact.notebook.html import as_script


def scripts_of(figures: Sequence[Figure]) -> str:
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
{_linked()}
open(JSON.parse(document.getElementById("figures").textContent));
}})();
</script>
"""


def _linked() -> str:
    """Script of the figures, which is a module on the calculator page, as part of another."""
    script = (files("viscontact.figures") / "linked.js").read_text(encoding="utf-8")
    return script.replace("export function", "function")
