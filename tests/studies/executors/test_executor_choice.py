"""Number of parallel processes of a study."""

from __future__ import annotations

import pytest

from viscontact.studies.executors import executor_choice
from viscontact.studies.executors.executor_choice import chosen_workers, number_of_workers
from viscontact.studies.executors.local import LocalWorkers


def test_a_worker_starts_no_further_ones_by_default() -> None:
    with LocalWorkers(1) as pool:
        assert pool.submit(number_of_workers, None).result() == 1
        assert pool.submit(number_of_workers, 3).result() == 3


def test_the_cores_that_may_be_used_are_the_default(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(executor_choice, "usable_cores", lambda: 3)
    assert number_of_workers(None) == 3
    for most, count in ((2, 2), (8, 3)):
        with chosen_workers(None, most=most) as found:
            assert found.count == count
