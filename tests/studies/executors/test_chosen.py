"""Number of parallel processes of a study."""

from __future__ import annotations

from viscontact.studies.executors.chosen import number_of_workers
from viscontact.studies.executors.local import LocalWorkers


def test_a_worker_starts_no_further_ones_by_default() -> None:
    with LocalWorkers(1) as pool:
        assert pool.submit(number_of_workers, None).result() == 1
        assert pool.submit(number_of_workers, 3).result() == 3
