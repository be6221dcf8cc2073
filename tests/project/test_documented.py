"""Every command and every line of Python that the documentation shows works unchanged."""

from __future__ import annotations

import ast
import re
import sys
from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_loader
from pathlib import Path

import pytest
import typer

import viscontact as vc
from project.documented import PAGES, ROOT, Reader, blocks, commands, pictures, why_not_run, words
from returned import some
from viscontact.cli.shell import application

COMMANDS = typer.main.get_group(application()).commands

ZENER = """
```{code-block} yaml
:caption: zener.yaml

indenter: {shape: paraboloid, radius_x: 10 mm, radius_y: 10 mm}
material: {law: zener, shear_modulus: 10 MPa, viscosity: 10 MPa s, delayed_modulus: 10 MPa,
  poisson_ratio: 0.5}
load: {kind: step, force: 4 N}
time: {end: 3 s, steps: 20}
grid: {shape: [48, 48], size: [4 mm, 4 mm]}
```
"""

#: What lies in the reader's directory before a page begins.
GIVEN = {
    "docs/report.md": ZENER
    + """
```sh
viscontact run zener.yaml -o viscontact-demo
```
```python
import shutil
import viscontact as vc
shutil.copy("viscontact-demo/result.nc", "result.nc")
ds = vc.open_results("result.nc").load()
```
""",
    "docs/accuracy.md": ZENER
    + """
```sh
viscontact run zener.yaml -o my
```
""",
}


def named(pages: list[Path]) -> list[object]:
    return [pytest.param(page, id=str(page.relative_to(ROOT))) for page in pages]


def kinds(page: Path, *wanted: str) -> list[str]:
    found = blocks(page.read_text(encoding="utf-8"))
    return [block.text for block in found if block.kind in wanted]


def require_known(command: str) -> None:
    """Refuse a command or an option that the command line does not have."""
    _, *arguments = words(command.split(" > ")[0])
    subcommand = next(iter(arguments), "--help")
    if subcommand.startswith("-"):
        return
    known = COMMANDS[subcommand].params
    options = {option for one in known for option in (*one.opts, *one.secondary_opts)}
    for word in arguments[1:]:
        if word.startswith("-"):
            assert word.split("=")[0] in options | {"--help"}, command


@pytest.mark.slow
@pytest.mark.parametrize(
    "page", named([page for page in PAGES if kinds(page, "commands", "python")])
)
@pytest.mark.filterwarnings("default::viscontact.AccuracyWarning")
def test_what_a_page_says_comes_true(
    page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "80")
    markdown = page.read_text(encoding="utf-8")
    reader = Reader()
    reader.follow(GIVEN.get(str(page.relative_to(ROOT)), ""))
    reader.follow(markdown)
    if page.parent.name == "howto" or page.name == "tutorial.md":
        # Pictures on these pages are what their commands draw.
        for picture in pictures(markdown, page):
            assert (tmp_path / picture.name).exists(), picture.name


@pytest.mark.parametrize("page", named(PAGES))
def test_commands_options_and_names_of_a_page_exist(page: Path) -> None:
    markdown = page.read_text(encoding="utf-8")
    inline = re.findall(r"(?<!`)`(viscontact [^`]+)`(?!`)", markdown)
    shown = [line for text in kinds(page, "commands") for line in commands(text)]
    for command in [*shown, *inline]:
        if command.startswith("viscontact "):
            require_known(command.replace("\n", " "))
    for source in kinds(page, "python"):
        for node in ast.walk(ast.parse(source)):
            if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
                assert node.value.id != "vc" or hasattr(vc, node.attr), node.attr
    for picture in pictures(markdown, page):
        assert picture.exists(), picture


def test_tasks_that_pages_name_exist(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    loader = SourceFileLoader("go", str(ROOT / "go"))
    spec = spec_from_loader("go", loader)
    assert spec is not None
    go = module_from_spec(spec)
    loader.exec_module(go)
    texts = [page.read_text(encoding="utf-8") for page in PAGES]
    for task in some(re.findall(r"\./go (\w+)", "\n".join(texts))):
        assert task in go.TASKS, f"./go {task}"


def test_a_line_of_a_shell_is_run_or_has_its_reason() -> None:
    shown = [
        (page, command)
        for page in PAGES
        for text in kinds(page, "commands")
        for command in commands(text)
    ]
    assert len(shown) > 100
    for page, command in shown:
        program = command.split()[0]
        known = why_not_run(command) or program in ("viscontact", "./go", "python")
        assert known, f"{page.name}: {command}"


def test_pages_show_python_output_and_pictures() -> None:
    """Of what a single page may have none."""
    for kind, least in (("python", 40), ("output", 20)):
        assert sum(len(kinds(page, kind)) for page in PAGES) > least, kind
    drawn = [each for page in PAGES for each in pictures(page.read_text(encoding="utf-8"), page)]
    assert len(drawn) > 40


LIES = {
    "option": "```sh\nviscontact material pmma-paper --colour red\n```",
    "exit code": "```sh\nviscontact check nothing.yaml\n```",
    "refusal": "```sh\nviscontact material pmma-paper  # refused: not so\n```",
    "output": "```sh\nviscontact material pmma-paper\n```\n\n```text\nsource  Hertz, 1882\n```",
    "comment": "```python\nprint(2 + 2)  # 5\n```",
    "later block": "```python\nx = 1\n```\n\n```python\nassert x == 2\n```",
    "file": "```{code-block} yaml\n:caption: a.yaml\n\nload: 1\n```\n"
    "```sh\nviscontact check a.yaml\n```",
    "other program": "```sh\nrm a.yaml\n```",
}


@pytest.mark.parametrize("page", LIES.values(), ids=LIES.keys())
def test_page_that_is_wrong_is_found_out(
    page: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(AssertionError):
        Reader().follow(page)


def test_page_that_is_right_is_followed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Reader().follow(
        "```{code-block} text\n:caption: a.txt\n\none two\n```\n"
        "```python\nwords = open('a.txt').read().split()\n```\n"
        "```python\nprint(len(words))  # 2 words\n```\n\n```text\n2.01\n```\n"
        "```sh\nviscontact check nothing.yaml  # refused: it is not there\ncd elsewhere\n```\n"
    )
