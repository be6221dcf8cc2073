"""Generated parts of pages, so that they are always up to date.

A line ``{{ made: NAME }}`` in a page is replaced by the text that ``PARTS[NAME]`` returns.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from bibliography import bibliography
from case_file import case_file_reference
from command_line import command_line_reference
from sphinx.application import Sphinx
from sphinx.environment import BuildEnvironment
from sphinx.util.typing import ExtensionMetadata
from verification_summary import verification_summary

import viscontact
from viscontact.bodies.materials.library.entry import Entry, entry, names
from viscontact.case.sections import case_schema
from viscontact.results.variables import COORDINATES, FIELDS, SCALARS, Variable
from viscontact.units.formatting import format_quantity

ROOT = Path(__file__).parents[2]


def _changes() -> str:
    text = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    # Page names become links.
    return re.sub(r"`docs/([\w/-]+)\.md`", r"{doc}`/\1`", text)


def _contributing() -> str:
    return (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")


def _citation() -> str:
    text = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    return f"```yaml\n{text.strip()}\n```"


def _variables(kind: dict[str, Variable]) -> str:
    lines = ["| name | unit | what it is |", "|---|---|---|"]
    lines += [f"| `{name}` | {_unit(each)} | {each.long_name} |" for name, each in kind.items()]
    return "\n".join(lines)


def _unit(variable: Variable) -> str:
    """Unit with superscripts, which CF units do not have."""
    return {"m2": "m²", "1": "–"}.get(variable.units, variable.units)


def _library() -> str:
    """Return a section for each shipped material: description, source, case-file section."""
    return "\n\n".join("\n".join(_material(entry(name))) for name in names())


def _material(shipped: Entry) -> Iterator[str]:
    yield from (f"(material-{shipped.name})=", f"## {shipped.name}", "", f"{shipped.title}.", "")
    known = "any time, as it is elastic"
    if shipped.measured is not None:
        first, last = (format_quantity(time, "s") for time in shipped.measured)
        known = f"{first} to {last}; a run outside this range issues a warning"
    rows = {
        "family": shipped.family,
        "measured": f"{shipped.test}, temperature: {shipped.temperature}",
        "data range": known,
        "source": shipped.source,
        "constants": shipped.constants,
        "volume": shipped.volume,
        "checked": shipped.checked,
        "licence": shipped.licence,
    }
    yield from ("| | |", "|---|---|")
    for name, text in rows.items():
        yield f"| {name} | {' '.join(text.split())} |".replace("*", r"\*")
    yield from ("", "```yaml", "material:")
    for key, value in shipped.material.items():
        written = value if not isinstance(value, list) else f"[{', '.join(map(str, value))}]"
        yield f"  {key}: {written}"
    yield "```"


def _in_a_notebook(displayed: Any) -> str:
    return f'```{{raw}} html\n<div class="in-a-notebook">{displayed._repr_html_()}</div>\n```'


def _roller() -> str:
    """Output of the first cell of the page on notebooks."""
    return _in_a_notebook(viscontact.Roller(radius=5e-3, half_length=9.565e-3, crown_radius=75e-3))


def _result() -> str:
    """Output of the second cell of the page on notebooks."""
    rubber = viscontact.Material(viscontact.Zener(1e6, 1e6, 1e6), poisson_ratio=0.5)
    times = viscontact.uniform_times(5.0, 20)
    ds = viscontact.simulate(viscontact.Sphere(0.01), rubber, viscontact.step(0.1), times=times)
    return _in_a_notebook(ds.viscontact)


PARTS: dict[str, Callable[[], str]] = {
    "case file": lambda: case_file_reference(case_schema()),
    "command line": command_line_reference,
    "materials": _library,
    "coordinates": lambda: _variables(COORDINATES),
    "scalars": lambda: _variables(SCALARS),
    "fields": lambda: _variables(FIELDS),
    "changes": _changes,
    "contributing": _contributing,
    "citation": _citation,
    "bibliography": bibliography,
    "verification summary": lambda: verification_summary(ROOT / "docs/verification.md"),
    "a roller in a notebook": _roller,
    "a result in a notebook": _result,
}

_MARK = re.compile(r"^\{\{ made: (.+?) \}\}$", re.MULTILINE)


def _fill_in(app: Sphinx, page: str, source: list[str]) -> None:
    source[0] = _MARK.sub(lambda found: PARTS[found[1]](), source[0])


def _always_outdated(
    app: Sphinx, env: BuildEnvironment, added: set[str], changed: set[str], removed: set[str]
) -> Iterator[str]:
    """Pages with a mark: their sources are not files that Sphinx watches."""
    for page in env.found_docs:
        path = Path(str(env.doc2path(page)))
        if path.suffix == ".md" and _MARK.search(path.read_text(encoding="utf-8")):
            yield page


def setup(app: Sphinx) -> ExtensionMetadata:
    """Replace the marks when pages are read."""
    app.connect("source-read", _fill_in)
    app.connect("env-get-outdated", _always_outdated)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
