"""Answers of the page's server that refuse a request at one of its fields."""

from __future__ import annotations

from typing import Any


def assert_refused(answer: Any, path: str, message: str) -> None:
    """Fail unless an answer states a problem of a field, in words without folders."""
    assert answer.status_code == 422, answer.text
    problems = [each for each in answer.json()["problems"] if each["path"] == path]
    assert problems, answer.text
    assert message in problems[0]["message"]
    assert "/files/" not in problems[0]["message"]
