"""`schema`, `example` and `demo`: the case format and the shipped cases."""

from __future__ import annotations

import difflib
import re
import shutil
import sys
from importlib.resources import as_file, files
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Annotated

from viscontact.cli.declared import argument, option
from viscontact.cli.terminal.messages import put, refuse
from viscontact.runs.processes.request import RunRequest

DEMO, DEMO_DIRECTORY = "roller-dogbone-e05", Path("viscontact-demo")
DEMO_FIGURES = ("pressure-map", "pressure-profile", "contact-outline", "history")
SCHEMA_NAME = "viscontact.schema.json"


def schema() -> None:
    """Print the JSON schema of case files, for completion in editors."""
    put(_schema_text())


def example(
    name: Annotated[
        str | None, argument(help="Name of the example; by default all are listed.")
    ] = None,
    output: Annotated[
        Path | None,
        option("-o", "--output", metavar="FILE", help="File to write; stdout by default."),
    ] = None,
    overwrite: Annotated[bool, option("--overwrite", help="Replace FILE.")] = False,
) -> None:
    """Copy a shipped case, to run or to change it."""
    if name is None:
        _list_examples()
        return
    text = _example_text(name)
    if output is None:
        put(text, end="")
        return
    _write_example(output, text, _data_of(text), overwrite=overwrite)


def demo(
    quiet: Annotated[bool, option("--quiet", "-q", help="Print errors only.")] = False,
) -> None:
    """Press a crowned roller on PMMA for 1000 s and draw the results, in ./viscontact-demo."""
    from viscontact.cli.results.figure_files import plot_package
    from viscontact.cli.results.figures import draw
    from viscontact.cli.run.execution import execute

    plot_package()  # refused before the run where figures cannot be drawn after it
    with as_file(_examples()[DEMO]) as case:
        execute(RunRequest(case, DEMO_DIRECTORY, overwrite=True, quiet=quiet))
    for figure in DEMO_FIGURES:
        draw(DEMO_DIRECTORY, figure, [], None)
    if not quiet:
        command = _typed_command()
        put(f"One page to look at and to send: {command} report {DEMO_DIRECTORY}")
        put(f"The same case to change: {command} example {DEMO} -o my.yaml")


def _typed_command() -> str:
    """Command of viscontact: its name, or its path where the shell does not find it."""
    if shutil.which("viscontact"):
        return "viscontact"
    script = shutil.which("viscontact", path=str(Path(sys.executable).parent))
    if script is None:
        return f"{Path(sys.executable).name} -m viscontact"
    here = Path.cwd()
    return str(Path(script).relative_to(here) if Path(script).is_relative_to(here) else script)


def _schema_text() -> str:
    import json

    from viscontact.case import case_schema

    return json.dumps(case_schema(), indent=2)


def _examples() -> dict[str, Traversable]:
    """Shipped case files by name."""
    found = {Path(entry.name): entry for entry in files("viscontact.case.examples").iterdir()}
    return {path.stem: found[path] for path in sorted(found) if path.suffix == ".yaml"}


def _list_examples() -> None:
    examples = _examples()
    width = max(map(len, examples))
    for name, file in examples.items():
        title = re.search(r"^title: *(.*)$", file.read_text(encoding="utf-8"), re.MULTILINE)
        put(f"{name:{width}}  {title[1] if title else ''}".rstrip())


def _example_text(name: str) -> str:
    examples = _examples()
    if name not in examples:
        near = difflib.get_close_matches(name, examples, n=1)
        hint = f"; did you mean {near[0]}?" if near else "."
        refuse(f"no example is called '{name}'{hint} There are {', '.join(examples)}")
    return examples[name].read_text(encoding="utf-8")


def _holds(path: Path, content: bytes) -> bool:
    return path.is_file() and path.read_bytes() == content


def _data_of(text: str) -> dict[str, bytes]:
    """Contents of the shipped files that a case names."""
    named = re.findall(r"^[ -]*file: *([\w.-]+)", text, re.MULTILINE)
    return {name: (files("viscontact.case.examples") / name).read_bytes() for name in named}


def _write_example(output: Path, text: str, data: dict[str, bytes], *, overwrite: bool) -> None:
    """Write a case, its data files, and the schema that its first line names."""
    beside = {output.parent / name: content for name, content in data.items()}
    for path in (output, *beside):
        if path.exists() and not (overwrite or (path in beside and _holds(path, beside[path]))):
            refuse(f"{path}: is there already; choose another name, or --overwrite")
    try:
        output.write_text(text, encoding="utf-8")
        for path, content in beside.items():
            path.write_bytes(content)
        (output.parent / SCHEMA_NAME).write_text(_schema_text() + "\n", encoding="utf-8")
    except OSError as error:
        refuse(f"{output}: cannot be written: {error}")
    for path in beside:
        put(f"{path}, which it reads")
    put(f"{output}, and {SCHEMA_NAME} for completion in editors")
    put(f"Next: viscontact run {output}")
