"""Memory that tasks declare to executors."""

from __future__ import annotations

from viscontact.studies.executors.dask import _rounded_up


def test_memory_is_rounded_up_to_two_digits() -> None:
    assert _rounded_up(2.213e8) == 230000000.0
