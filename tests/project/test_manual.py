"""The manual tells all there is, and all its pages can be reached; its build is `./go docs`."""

from __future__ import annotations

import fnmatch
import importlib.util
import pydoc
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path, PurePosixPath
from types import ModuleType
from typing import Any

import pytest
import typer
from sphinx.errors import ExtensionError

import viscontact
import viscontact.identification
import viscontact.plot
from returned import some
from viscontact.case.sections import case_schema
from viscontact.cli.shell import application

DOCS = Path(__file__).parents[2] / "docs"


def extension(name: str) -> ModuleType:
    """A module of the manual's own, which is no package."""
    spec = importlib.util.spec_from_file_location(name, DOCS / "_ext" / f"{name}.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


# --- names in the text ----------------------------------------------------------------------------


def test_names_in_the_manual_are_found_after_import_viscontact() -> None:
    pages = [*DOCS.rglob("*.md"), DOCS.parent / "README.md"]
    text = "\n".join(page.read_text(encoding="utf-8") for page in pages)
    # In code spans, with at least a module and a name in it, as `viscontact.case.read_case`.
    names = set(re.findall(r"`(?:vc|viscontact)((?:\.[a-z]\w*){2,})\(?[^`]*`(?! is not)", text))
    assert ".case.read_case" in names
    # In a new process: in this one, other tests have imported the modules.
    program = "import operator, sys, viscontact\nfor name in sys.argv[1:]:\n"
    program += "    operator.attrgetter(name[1:])(viscontact)\n"
    subprocess.run([sys.executable, "-c", program, *sorted(names)], check=True)


# --- the Python reference -----------------------------------------------------------------------


def listed() -> set[str]:
    """Full names of all that the pages of the Python reference list."""
    names = set()
    for page in (DOCS / "reference" / "python").iterdir():
        module = ""
        for line in page.read_text(encoding="utf-8").splitlines():
            if found := re.match(r"\.\. currentmodule:: (\S+)", line):
                module = found[1]
            elif found := re.match(r"\.\. autofunction:: (viscontact\S+)", line):
                names.add(found[1])
            elif found := re.fullmatch(r"   ([A-Za-z_.]+)|\.\. (?:autodata|py:data):: (\w+)", line):
                names.add(f"{module}.{found[1] or found[2]}")
    return names


@pytest.mark.parametrize(
    "module",
    [
        viscontact,
        viscontact.reference,
        viscontact.plot,
        viscontact.surfaces,
        viscontact.verify,
        viscontact.identification,
    ],
    ids=lambda module: str(module.__name__),
)
def test_the_python_reference_lists_every_public_name(module: ModuleType) -> None:
    public = {name for name in module.__all__ if not isinstance(getattr(module, name), ModuleType)}
    # Some are listed where they are most used: at the top.
    documented = {name.rpartition(".")[2] for name in listed()}
    assert public - {"__version__"} - documented == set()


def test_the_python_reference_lists_nothing_that_is_not_there() -> None:
    for name in some(listed()):
        assert pydoc.locate(name) is not None, name


def test_defaults_of_a_signature_are_shown_by_their_values_unless_these_are_long() -> None:
    constants = {"_EXCESS": 1.05, "CASES": tuple(range(99))}
    shown = extension("docstrings").by_value("(cases=CASES, excess=_EXCESS)", constants)
    assert shown == "(cases=CASES, excess=1.05)"


def test_a_source_links_back_to_the_package_that_documents_a_name() -> None:
    page = "../reference/generated/viscontact.identification.MasterCurve.html"
    relinked = extension("docstrings").linked_back(f"{page}#viscontact.MasterCurve.fit_wlf")
    assert relinked == f"{page}#viscontact.identification.MasterCurve.fit_wlf"
    name = "viscontact.simulation.accuracy.richardson.richardson"
    same = f"../generated/{name}.html#{name}"
    assert extension("docstrings").linked_back(same) == same


def test_a_module_without_a_page_links_to_a_page_that_exists() -> None:
    for module, page in some(extension("docstrings").MODULE_PAGES.items()):
        assert pydoc.locate(module) is not None, module
        assert list(DOCS.glob(f"{page}.*")), page


# --- pages that are made ------------------------------------------------------------------------


def keys(schema: dict[str, Any]) -> Iterator[tuple[str, str]]:
    """Each key of a case file, with the sentence that tells what section it is of."""
    for kind in [schema, *schema["$defs"].values()]:
        for key in kind["properties"]:
            yield kind["description"], key


def test_the_reference_of_case_files_lists_every_key() -> None:
    schema = case_schema()
    page = extension("case_file").case_file_reference(schema)
    rows = set(re.findall(r"^\| `(\w+)` \|", page, re.MULTILINE))
    chosen = set(re.findall(r"^#+ `(\w+): ", page, re.MULTILINE))
    for section, key in some(keys(schema)):
        assert key in rows | chosen, key
        # Each kind has its own place, under the words that the schema has for it.
        assert section in page or section == schema["description"], section
    for kind in ("shape: roller", "law: creep-series", "kind: harmonic", "kind: chamfer"):
        # Of the load, of the temperature and of the tangential load.
        sections = 3 if kind == "kind: harmonic" else 1
        assert page.count(f"# `{kind}`\n") == sections
        # In the lists of the kinds of the sections that have many.
        assert page.count(f"[`{kind}`](#case-") == (2 if kind == "kind: harmonic" else 1)


def test_the_reference_of_case_files_lists_values_bounds_and_required_keys() -> None:
    page = extension("case_file").case_file_reference(case_schema())
    rows = {row.split(" | ")[0]: row for row in page.splitlines() if row.startswith("| `")}
    assert "| required |" in rows["| `end`"]
    assert "above -1, at most 0.5" in rows["| `poisson_ratio`"]
    assert "`uniform` or `log` or `adaptive` or `cells` | `uniform` |" in rows["| `spacing`"]
    assert "e.g. `10 kN`" in rows["| `force`"]
    assert "A name, one of `pmma-paper`" in page
    assert "; or one of the kinds below.\n" in page


def test_every_key_of_a_case_file_says_what_it_means() -> None:
    page = extension("case_file").case_file_reference(case_schema())
    assert re.findall(r"^\| `\w+` \|  \|.*$", page, re.MULTILINE) == []


def test_the_reference_of_commands_lists_every_command_and_option() -> None:
    page = extension("command_line").command_line_reference()
    sections = re.split(r"^## ", page, flags=re.MULTILINE)[1:]
    commands = typer.main.get_command(application()).commands
    assert [section.split("\n")[0] for section in sections] == [f"viscontact {n}" for n in commands]
    for section, command in zip(sections, commands.values(), strict=True):
        for parameter in command.params:
            if parameter.param_type_name == "option":
                assert all(f"`{name}" in section for name in parameter.opts)


# --- pages --------------------------------------------------------------------------------------


def pages() -> set[str]:
    """Names of all pages that are written by hand, and of those that the gallery makes."""
    found = {"examples/index"}
    for path in DOCS.rglob("*"):
        place = path.relative_to(DOCS)
        if path.suffix in (".md", ".rst") and place.parts[0] not in (
            "_templates",
            "_static",
            "examples",
        ):
            found.add(place.with_suffix("").as_posix())
    return {page for page in found if not re.match(r"gallery/|reference/generated/", page)}


def entries(page: str) -> Iterator[str]:
    """Pages and patterns in the tables of contents of a page, from the root."""
    path = DOCS / f"{page}.md"
    text = path.read_text(encoding="utf-8") if path.exists() else ""
    for block in re.findall(r"```\{toctree\}\n(.*?)```", text, re.DOTALL):
        for line in block.splitlines():
            line = re.sub(r".*<(.+)>", r"\1", line)
            if line and not line.startswith(":"):
                inside = PurePosixPath(page).parent
                parts: list[str] = []
                for part in (inside / line.removesuffix(".md")).parts:
                    if part == "..":
                        parts.pop()
                    elif part == "/":
                        parts.clear()
                    else:
                        parts.append(part)
                yield "/".join(parts)


def test_every_page_is_in_one_table_of_contents() -> None:
    for page in some(pages() - {"index"}):
        holders = {
            holder
            for holder in pages() - {page}
            for entry in entries(holder)
            if entry.count("/") == page.count("/") and fnmatch.fnmatch(page, entry)
        }
        assert len(holders) == 1, (page, holders)


def test_what_a_page_would_load_from_the_network_is_seen() -> None:
    find = extension("offline").loaded_from_outside
    assert find('<link rel="stylesheet" href="https://a.org/b.css">')
    assert find("<img class='x'\n src='//a.org/b.png'>")
    assert find("@font-face { src: url(https://a.org/b.woff2) }")
    assert not find('<a href="https://a.org">a</a> <script src="../_static/a.js"></script>')


def test_equations_become_mathml() -> None:
    mathml = extension("equations").mathml
    assert mathml(r"\Phi(t-t')").count("′</mo>") == 1
    assert "′" not in mathml(r"\text{Poisson's ratio}")
    assert 'display="block"' in mathml(r"a = \frac{b}{c}", as_block=True)
    assert mathml(r"\ln t").count("<mspace") == 1
    assert re.findall('form="(\\w+)"', mathml("|f| + |g|")) == ["prefix", "postfix"] * 2


@pytest.mark.parametrize("wrong", [r"\notacommand", r"\frac12 x", r"\tfrac{1}{2}", r"\bar J_n"])
def test_equations_that_would_be_drawn_wrongly_are_refused(wrong: str) -> None:
    with pytest.raises(ExtensionError, match="equation"):
        extension("equations").mathml(wrong)


def test_numbers_keep_their_units() -> None:
    keep = extension("line_breaks").keeping_units
    for whole in ("10 kN", "0.5 %", "26 675 values", "3 µm", "4 mm²"):
        assert " " not in keep(whole).removesuffix(" values")
    for words in ("two cores", "95 of 100", "4 meshes", "1280 pixels", "t = 0"):
        assert keep(words) == words


def test_lines_end_where_a_reader_would_end_them() -> None:
    well = extension("line_breaks").breaking_well
    alone, block = "<p>of <math>t</math> is</p>", '<math display="block">t</math>.'
    assert well(alone) == alone
    assert well(block) == block
    assert well("(<code>-o</code>), or") == '<span class="whole">(<code>-o</code>),</span> or'
    name = '<code><span class="pre">test_kill.py::test_run_that_is_killed</span></code>'
    assert well(name).count("<wbr>") == name.count("_") + 1
    commands = '<div class="highlight-sh notranslate"><div class="highlight"><pre>{}\n</pre></div>'
    assert well(commands.format("plot -o a-map.png a")) == commands.format(
        'plot <span class="whole">-o</span> <span class="whole">a-map.png</span> a'
    )
