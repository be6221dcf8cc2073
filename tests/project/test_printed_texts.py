"""Texts of users are printed and drawn as they are, because they can go one way only."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import viscontact
from returned import some

ROOT = Path(viscontact.__file__).parent
#: Modules that read markup or write past the console, and the files that use them with care.
GUARDED: dict[str, set[str]] = {
    "rich": set(),
    "rich.console": {"cli/terminal/console.py"},
    "rich.markup": set(),
    "rich.progress": {"cli/terminal/bars.py", "cli/sweep/progress.py"},
    "rich.text": {"cli/terminal/console.py"},
}
#: Names and methods that write, and the files that call them.
WRITERS: dict[tuple[str, str], set[str]] = {
    # On a terminal: `put` and `say`; and a line that is written over, of names of this package.
    ("cli", "print"): {"cli/terminal/messages.py", "cli/results/verification_table.py"},
    ("cli", ".echo"): set(),
    ("cli", ".from_markup"): set(),
    # In figures of Matplotlib: `add_heading` and `add_legend`.
    ("drawing/matplotlib", ".set_title"): {"drawing/matplotlib/layout/style.py"},
    ("drawing/matplotlib", ".legend"): {"drawing/matplotlib/layout/style.py"},
}


def nodes_of(path: Path) -> Iterator[ast.AST]:
    yield from ast.walk(ast.parse(path.read_text(encoding="utf-8")))


def imported(path: Path) -> list[str]:
    """Modules that a file imports, anywhere in it."""
    text = path.read_text(encoding="utf-8")
    return re.findall(r"^\s*(?:from|import) ([\w.]+)", text, re.MULTILINE)


def called(node: ast.AST) -> str:
    """Function that an expression calls, a method with a dot before its name."""
    if not isinstance(node, ast.Call):
        return ""
    return node.func.id if isinstance(node.func, ast.Name) else f".{getattr(node.func, 'attr', '')}"


def test_markup_and_consoles_of_rich_are_used_in_one_place() -> None:
    for name, allowed in GUARDED.items():
        users = {
            path.relative_to(ROOT).as_posix()
            for path in some(sorted(ROOT.rglob("*.py")))
            if name in imported(path)
        }
        assert users == allowed, name


def test_texts_of_users_are_written_through_functions_that_keep_them() -> None:
    for (room, name), allowed in WRITERS.items():
        users = {
            path.relative_to(ROOT).as_posix()
            for path in some(sorted((ROOT / room).rglob("*.py")))
            if any(called(node) == name for node in nodes_of(path))
        }
        assert users == allowed, (room, name)


def test_texts_in_bars_of_progress_are_no_markup() -> None:
    columns = [
        (column.args[0].value, {word.arg for word in column.keywords})
        for column in nodes_of(ROOT / "cli/terminal/bars.py")
        if isinstance(column, ast.Call) and called(column) == "TextColumn"
        if isinstance(column.args[0], ast.Constant)
    ]
    for text, options in some(columns):
        assert "markup" in options or "{task" not in str(text)
