"""A test whose assertions all stand in loops has something to loop over.

Where a function returns nothing, a loop over what it returns asserts nothing, and `all` is true.
"""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

from returned import some

TESTS = Path(__file__).parents[1]
#: Calls that give as many values as their arguments have, and as the object that they belong to.
OF_ARGUMENTS = {
    *("enumerate", "reversed", "sorted", "list", "tuple", "set", "pairwise", "product", "array"),
    *("combinations", "permutations", "linspace", "geomspace", "arange", "fromkeys"),
}
OF_OWNER = {"items", "values", "keys", "split", "splitlines"}
#: A page may show nothing, which is followed by calls that assert.
ALLOWED = {
    "test_what_a_page_says_comes_true",
    "test_commands_options_and_names_of_a_page_exist",
}


def empty_loops(source: str) -> list[str]:
    """Tests that assert nothing where what they loop over is empty, as LINE NAME."""
    functions = [each for each in ast.parse(source).body if isinstance(each, ast.FunctionDef)]
    return [
        f"{each.lineno} {each.name}"
        for each in functions
        if each.name.startswith("test_") and _may_assert_nothing(each)
    ]


def _may_assert_nothing(test: ast.FunctionDef) -> bool:
    if any(isinstance(each, ast.Assert) and not _comprehension(each.test) for each in test.body):
        return False
    arguments = test.args
    written = {each.arg for each in (*arguments.args, *arguments.kwonlyargs)}
    return _asserts(test) and not _certainly_asserts(test.body, written)


def _asserts(node: ast.AST) -> bool:
    return any(_is_assertion(each) for each in ast.walk(node))


def _is_assertion(node: ast.AST) -> bool:
    if isinstance(node, ast.Call):
        name = _name(node)
        return name in ("raises", "warns") or name.startswith(("assert_", "require_", "check_"))
    return isinstance(node, ast.Assert)


def _name(call: ast.Call) -> str:
    if isinstance(call.func, ast.Attribute):
        return call.func.attr
    return call.func.id if isinstance(call.func, ast.Name) else ""


def _certainly_asserts(body: list[ast.stmt], written: set[str]) -> bool:
    """Whether these statements assert something; `written` learns the names that they give."""
    for each in body:
        if isinstance(each, ast.For):
            has_values = _has_values(each.iter, written)
            if has_values:
                written |= _names(each.target)
            found = has_values and _certainly_asserts(each.body, written)
        elif isinstance(each, ast.If):
            found = all(_certainly_asserts(part, written) for part in (each.body, each.orelse))
        elif isinstance(each, ast.With):
            found = any(_asserts(item.context_expr) for item in each.items)
            found = found or _certainly_asserts(each.body, written)
        elif isinstance(each, ast.Assert) and (over := _comprehension(each.test)):
            found = _has_values(over, written)
        else:
            found = not isinstance(each, ast.FunctionDef) and _asserts(each)
        if found:
            return True
        if isinstance(each, ast.Assign) and _has_values(each.value, written):
            written |= {name for target in each.targets for name in _names(target)}
    return False


def _comprehension(claim: ast.expr) -> ast.expr | None:
    """What `all(...)` or `not any(...)` holds of, which is true of nothing."""
    wanted = "all"
    if isinstance(claim, ast.UnaryOp) and isinstance(claim.op, ast.Not):
        wanted, claim = "any", claim.operand
    is_of_all = isinstance(claim, ast.Call) and ast.unparse(claim.func) == wanted
    [values] = claim.args if isinstance(claim, ast.Call) and is_of_all else [None]
    return values if isinstance(values, ast.GeneratorExp) else None


def _names(target: ast.expr) -> set[str]:
    return {each.id for each in ast.walk(target) if isinstance(each, ast.Name)}


def _has_values(node: ast.expr, written: set[str]) -> bool:
    """Whether the number of values is written in the test or its file, or asserted by `some`."""
    if isinstance(node, ast.Name):
        return node.id in written or node.id.isupper()
    if isinstance(node, ast.Attribute | ast.Subscript | ast.Starred):
        return _has_values(node.value, written)
    if isinstance(node, ast.Tuple | ast.List | ast.Set | ast.Dict | ast.Constant):
        return True
    if isinstance(node, ast.BinOp):
        others = [] if isinstance(node.op, ast.Sub) else [node.right]  # the rest of a set
        return any(_has_values(each, written) for each in (node.left, *others))
    if isinstance(node, ast.IfExp):
        return _has_values(node.body, written) and _has_values(node.orelse, written)
    if isinstance(node, ast.ListComp | ast.SetComp | ast.DictComp | ast.GeneratorExp):
        return all(not each.ifs and _has_values(each.iter, written) for each in node.generators)
    return isinstance(node, ast.Call) and _gives_values(node, written)


def _gives_values(call: ast.Call, written: set[str]) -> bool:
    name, values = _name(call), call.args
    if isinstance(call.func, ast.Attribute) and name in OF_OWNER:
        values = [call.func.value]
    given = [_has_values(each, written) for each in values]
    if name == "zip":
        is_strict = any(ast.unparse(each) == "strict=True" for each in call.keywords)
        return any(given) if is_strict else all(given)
    return name in ("some", "range") or (name in OF_ARGUMENTS | OF_OWNER and all(given))


def test_no_test_asserts_in_loops_over_what_may_be_empty_only() -> None:
    files = sorted(TESTS.rglob("test_*.py"))
    assert len(files) > 300
    found = [
        f"{path.relative_to(TESTS)}:{each}"
        for path in files
        for each in empty_loops(path.read_text(encoding="utf-8"))
        if each.split()[1] not in ALLOWED
    ]
    assert not found, "loop over `some` of returned.py, or assert the number: " + ", ".join(found)


def test_empty_loops_are_found() -> None:
    loops = {
        "found": "for each in computed(): assert each",
        "found_too": "for each in zip(one(), other(), strict=True): assert each",
        "all": "assert all(each for each in computed())",
        "any": "assert not any(each for each in computed() if each)",
        "behind_a_condition": "\n    ".join(["if computed():", "    assert computed()"]),
        "of_some": "for each in some(computed()): assert each",
        "of_a_list": "for each in (1, 2): assert computed(each)",
        "of_equal_length": "for each in zip(computed(), (1, 2), strict=True): assert each",
        "beside_it": "\n    ".join(["for each in computed(): assert each", "assert computed()"]),
    }
    source = "\n".join(f"def test_{name}():\n    {body}" for name, body in loops.items())
    assert [each.split()[1] for each in empty_loops(source)] == [
        *("test_found", "test_found_too", "test_all", "test_any", "test_behind_a_condition")
    ]


def test_a_loop_over_nothing_fails() -> None:
    assert list(some(iter("ab"))) == ["a", "b"]
    with pytest.raises(AssertionError, match="nothing to loop over"):
        list(some(()))
