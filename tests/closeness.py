"""Comparison of floating-point values in SI units, many of which are tiny."""

from __future__ import annotations

from typing import Any

import pytest


def close_to(
    expected: Any, rel: float | None = None, *, abs: float | None = None, nan_ok: bool = False
) -> Any:
    """Like `pytest.approx`, but without an absolute tolerance unless one is given.

    That of pytest is 1e-12: a flow of 1e-13 is close to 0, and a creep compliance of
    1e-12 1/Pa close to any other. By default the relative tolerance is 1e-6, or none if an absolute
    one is given.
    """
    if abs is None:
        abs = 0.0
        rel = 1e-6 if rel is None else rel
    return pytest.approx(expected, rel=rel, abs=abs, nan_ok=nan_ok)
