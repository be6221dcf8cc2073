"""Cluster of `--scheduler`: its connection, its workers, and their memory."""

from __future__ import annotations

import json
import logging
import signal
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

from viscontact.cli.terminal.messages import refuse, say, stop
from viscontact.runs.processes.job import Job
from viscontact.units.formatting import format_number

if TYPE_CHECKING:
    from viscontact.studies.executors.remote import RemoteTasks

#: Largest time for the connection to a scheduler [s].
_PATIENCE = 30
#: Place of Dask's status page, on this machine only.
_ANY_PORT = "127.0.0.1:0"


@contextmanager
def cluster_tasks(
    scheduler: str, count: int, directory: Path, jobs: Sequence[Job], *, quiet: bool
) -> Iterator[RemoteTasks]:
    """Tasks of the workers of a scheduler, whose memory must suffice for the runs."""
    from viscontact.studies.executors.dask import dask_executor
    from viscontact.studies.executors.remote import RemoteTasks

    with connected(scheduler, count, quiet=quiet) as client:
        with _answering(scheduler):
            if scheduler != "local":
                _check_memory(client, scheduler, jobs, quiet=quiet)
            executor = dask_executor(client)
        with RemoteTasks(executor, directory) as tasks:
            yield tasks


@contextmanager
def connected(scheduler: str, count: int, *, quiet: bool) -> Iterator[Any]:
    """Connect to a scheduler by its address or file; `local` starts `count` workers here."""
    address = "" if scheduler == "local" else _address(scheduler)
    try:
        distributed: Any = import_module("distributed")
    except ImportError:
        refuse("--scheduler needs Dask: install it with: pip install 'viscontact[cluster]'")
    from viscontact.studies.executors.local import signals_blocked

    _silence()
    with ExitStack() as opened:
        try:
            if scheduler == "local":
                # Ctrl-C reaches them at the terminal, too; this process tells them.
                with signals_blocked([signal.SIGINT]):
                    # Without a limit of memory: the runs at once were chosen to fit.
                    cluster = distributed.LocalCluster(
                        n_workers=count,
                        threads_per_worker=1,
                        memory_limit=0,
                        dashboard_address=_ANY_PORT,
                        silence_logs=logging.CRITICAL,
                    )
                client = distributed.Client(opened.enter_context(cluster))
            else:
                client = distributed.Client(address, timeout=_PATIENCE)
        except RuntimeError as error:  # Dask's word for a worker that ends before it has begun
            stop(
                f"--scheduler {scheduler}: a worker ended while it started ({error}); it was"
                " killed, or there is too little memory; start again"
            )
        except (OSError, TimeoutError, ValueError) as error:
            at = "" if address == scheduler else f" at {address}"
            refuse(f"--scheduler {scheduler}: no scheduler answers{at}: {error}")
        opened.enter_context(client)
        if scheduler != "local":
            with _answering(scheduler):
                if not quiet and not client.scheduler_info()["workers"]:
                    say(f"--scheduler {scheduler}: waiting for its first worker")
                client.wait_for_workers(1)
        yield client


@contextmanager
def _answering(scheduler: str) -> Iterator[None]:
    """Stop the command if its scheduler ends before the first run is submitted."""
    try:
        yield
    except (OSError, TimeoutError) as error:  # a closed connection is an OSError of Dask
        stop(f"--scheduler {scheduler}: its scheduler has ended: {error}; start it again")


def _silence() -> None:
    """Leave what happens to workers and scheduler to this program's messages, not Dask's log."""
    for name in ("distributed", "distributed.client", "tornado.application"):
        logging.getLogger(name).setLevel(logging.CRITICAL)


def _address(scheduler: str) -> str:
    """Address of a scheduler, which may be given by its file."""
    if not scheduler.strip():
        refuse("--scheduler: is empty; give the address or the file of one, or local")
    file = Path(scheduler)
    if not file.is_file():
        if ":" in scheduler and file.suffix != ".json":
            return scheduler
        refuse(
            f"--scheduler {scheduler}: no such file; give an address, as tcp://node17:8786, the "
            "file that `dask scheduler --scheduler-file` has written, or local"
        )
    try:
        found = json.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError):
        found = None
    address = found.get("address") if isinstance(found, dict) else None
    if not isinstance(address, str):
        refuse(
            f"--scheduler {scheduler}: is not a scheduler file, which `dask scheduler "
            f"--scheduler-file` writes; it states no address"
        )
    return address


def _check_memory(client: Any, scheduler: str, jobs: Sequence[Job], *, quiet: bool) -> None:
    """Refuse runs that need more memory than any worker declares; say so if none declares any."""
    from viscontact.studies.executors.dask import RESOURCE, declared_memory

    largest, needed = max(declared_memory(client)), max((job.memory for job in jobs), default=0.0)
    if not largest and not quiet:
        say(
            f"--scheduler {scheduler}: its workers declare no memory, so that several runs on one "
            f'may need too much; start them with --resources "{RESOURCE}=16e9" (in bytes)'
        )
    if largest and needed > largest:
        refuse(
            f"--scheduler {scheduler}: a run needs about {format_number(needed / 1e9, 3)} GB of "
            f"memory, its workers declare {format_number(largest / 1e9, 3)} GB at most"
        )
