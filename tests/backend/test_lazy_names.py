"""Names of packages that are loaded at their first use."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

import viscontact
from viscontact.backend.lazy_names import stub_names

SOURCES = Path(viscontact.__file__).parent
STUBS = sorted(SOURCES.rglob("__init__.pyi"))


@pytest.mark.parametrize("stub", STUBS, ids=lambda stub: stub.parent.name)
def test_names_of_a_stub_are_those_that_python_reads(stub: Path) -> None:
    text = stub.read_text(encoding="utf-8")
    modules: set[str] = set()
    names: dict[str, list[str]] = {}
    for each in ast.parse(text).body:
        if isinstance(each, ast.ImportFrom) and each.level == 1:
            listed = [alias.name for alias in each.names]
            if each.module:
                names.setdefault(each.module, []).extend(listed)
            else:
                modules.update(listed)
    assert modules or names
    assert stub_names(text) == (modules, names)


def test_there_are_stubs() -> None:
    assert len(STUBS) > 20
