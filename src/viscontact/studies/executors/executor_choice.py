"""Choice of the executor of the runs of a study, and of the number of runs at a time."""

from __future__ import annotations

import multiprocessing
from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import contextmanager
from typing import Any

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.runs.machine.cores import usable_cores
from viscontact.studies.executors.local import LocalWorkers
from viscontact.units.numbers import whole


@dataclass(frozen=True)
class ChosenWorkers:
    """Executor of the runs, none for this process, and the number of runs at a time."""

    executor: Executor | None = None
    count: int = 1


#: Runs are computed one after the other, without an executor.
IN_THIS_PROCESS: ChosenWorkers = ChosenWorkers()


@contextmanager
def chosen_workers(
    workers: int | None,
    executor: Executor | None = None,
    client: Any = None,
    most: int | None = None,
    *,
    in_processes: bool = False,
) -> Iterator[ChosenWorkers]:
    """Executor of a study: a given one, that of a Dask client, or up to `most` processes."""
    # With one process, the runs are computed in this one, unless they are to be `in_processes`.
    require_executor(executor, client, workers)
    if client is not None:
        yield ChosenWorkers(
            client.get_executor(pure=False), max(1, sum(client.nthreads().values()))
        )
        return
    if executor is not None:
        # Executors of PEP 3148 do not have to tell their number of workers; most do by this name.
        yield ChosenWorkers(executor, getattr(executor, "_max_workers", None) or 1)
        return
    count = number_of_workers(workers)
    if most is not None:
        count = min(count, most)
    if count == 1 and not in_processes:
        yield IN_THIS_PROCESS
        return
    pool = LocalWorkers(count)
    try:
        yield ChosenWorkers(pool, count)
    except BaseException:
        pool.kill()
        raise
    finally:
        pool.shutdown(cancel_futures=True)


def number_of_workers(workers: int | None) -> int:
    """Number of parallel processes; by default the cores that this process may use.

    A process that another one has started, as a worker, does not start further ones by default:
    those beside it use the other cores.
    """
    if workers is not None:
        return whole("workers", workers, 1)
    return usable_cores() if multiprocessing.parent_process() is None else 1


def require_executor(executor: object, client: object, workers: object) -> None:
    """Raise TypeError or ValueError for an executor or a client that is none, or for several."""
    # Set by multiprocessing in a new process that is importing the script; its parent says why.
    if getattr(multiprocessing.current_process(), "_inheriting", False):
        raise SystemExit(1)
    given = {"executor": executor, "client": client, "workers": workers}
    named = [name for name, value in given.items() if value is not None]
    if len(named) > 1:
        raise ValueError(f"{' and '.join(named)} are given together; give one of them")
    if executor is not None and not callable(getattr(executor, "submit", None)):
        raise TypeError(
            "executor: must have a method submit, as a ProcessPoolExecutor of concurrent.futures "
            f"has, got {executor!r}"
        )
    if client is not None and not callable(getattr(client, "get_executor", None)):
        raise TypeError(
            "client: must be a Client of dask.distributed, as Client('tcp://10.0.0.1:8786'), got "
            f"{client!r}"
        )
