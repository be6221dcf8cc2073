"""Every comparison of floating-point values has a written absolute tolerance, or none at all."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
#: Functions with an absolute tolerance by default, of 1e-12 or 1e-8, and what names another one.
HIDDEN = {
    "isclose": "atol",
    "allclose": "atol",
    "assert_almost_equal": "",
    "assert_array_almost_equal": "",
    "approx": "",
}
#: The one place where pytest's comparison is called.
ALLOWED = ROOT / "tests/closeness.py"


def hidden_tolerances(source: str) -> list[str]:
    """Calls that compare with an absolute tolerance that is not written, as LINE NAME."""
    if not any(name in source for name in HIDDEN):
        return []
    calls = [call for call in _calls(ast.parse(source)) if _hides(*call)]
    return [
        f"{call.lineno} {name}" for call, name in sorted(calls, key=lambda each: each[0].lineno)
    ]


def _calls(tree: ast.AST) -> Iterator[tuple[ast.Call, str]]:
    for each in ast.walk(tree):
        match each:
            case ast.Call(func=ast.Attribute(value=ast.Name(id="math"))):
                pass  # that of Python's own mathematics has none
            case ast.Call(func=ast.Attribute(attr=name)):
                yield each, name


def _hides(call: ast.Call, name: str) -> bool:
    return name in HIDDEN and HIDDEN[name] not in {each.arg for each in call.keywords}


@pytest.mark.parametrize("folder", ["src", "tests", "benchmarks"])
def test_every_absolute_tolerance_is_written(folder: str) -> None:
    files = [path for path in (ROOT / folder).rglob("*.py") if path != ALLOWED]
    assert files
    found = [
        f"{path.relative_to(ROOT)}:{each}"
        for path in files
        for each in hidden_tolerances(path.read_text(encoding="utf-8"))
    ]
    assert not found, "use closeness.close_to, or write atol: " + ", ".join(found)


def test_hidden_tolerances_are_found() -> None:
    lines = [
        "x == pytest.approx(1e-13, rel=1e-3)",
        "np.isclose(x, 0)",
        "np.isclose(x, 0, atol=0)",
        "math.isclose(x, 1)",
        "np.testing.assert_array_almost_equal(x, y)",
        "np.testing.assert_allclose(x, y)",
    ]
    assert hidden_tolerances("\n".join(lines)) == [
        "1 approx",
        "2 isclose",
        "5 assert_array_almost_equal",
    ]
