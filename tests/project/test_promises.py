"""The page of promises names tests that exist."""

from __future__ import annotations

import ast
import re
from functools import cache
from pathlib import Path

from returned import some

TESTS = Path(__file__).parents[1]
PAGE = (TESTS.parent / "docs" / "promises.md").read_text(encoding="utf-8")


@cache
def functions_in(file: str) -> set[str]:
    """Return the names of a file's functions."""
    tree = ast.parse((TESTS / file).read_text(encoding="utf-8"))
    return {node.name for node in tree.body if isinstance(node, ast.FunctionDef)}


def test_every_promise_is_held_by_a_test_that_exists() -> None:
    named = re.findall(r"`([\w/]+\.py)::(\w+)`", PAGE)
    assert len(named) > 25
    for file, test in named:
        assert test in functions_in(file)


def test_every_row_of_promises_names_its_tests() -> None:
    for table in some(re.findall(r"\| promise \| held by \|\n\|---\|---\|\n((?:\|.*\n)+)", PAGE)):
        for row in table.splitlines():
            assert "::test_" in row, row
