"""Laws that are tried on a few random examples by default, and on many among the slow tests."""

import functools
import inspect
from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import given, settings


def given_few_or_many(
    few: int, many: int, *inputs: Any, **named: Any
) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Like `given`, on so many examples; arguments that are not given are fixtures.

    Marks of pytest stand above it, `example` below.
    """

    def parametrized(law: Callable[..., None]) -> Callable[..., None]:
        tried = {
            count: settings(max_examples=count)(given(*inputs, **named)(law))
            for count in (few, many)
        }

        @pytest.mark.parametrize("examples", [few, pytest.param(many, marks=pytest.mark.slow)])
        @functools.wraps(law, updated=())  # attributes of `example` belong to `tried`
        def test(examples: int, **fixtures: Any) -> None:
            tried[examples](**fixtures)

        count = inspect.Parameter("examples", inspect.Parameter.POSITIONAL_OR_KEYWORD)
        fixtures = inspect.signature(tried[few]).parameters.values()
        test.__signature__ = inspect.Signature([count, *fixtures])
        return test

    return parametrized
