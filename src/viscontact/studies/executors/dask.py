"""Executors of a Dask cluster, whose workers may declare their memory as the resource MEMORY."""

from __future__ import annotations

import math
from collections.abc import Callable
from concurrent.futures import Executor
from typing import Any

#: Name of the resource, in bytes: `dask worker ADDRESS --resources "MEMORY=16e9"`.
RESOURCE = "MEMORY"


def declared_memory(client: Any) -> list[float]:
    """Memory that the workers of a cluster declare [bytes]; 0 for one that declares none."""
    workers = client.scheduler_info(n_workers=-1)["workers"].values()
    return [float(worker.get("resources", {}).get(RESOURCE, 0.0)) for worker in workers]


def dask_executor(client: Any) -> Callable[[float], Executor]:
    """Return the function that gives the executor for the memory of a run [bytes]."""
    # If any worker declares its memory, a run is computed where its memory is free.
    declares = any(declared_memory(client))
    executors: dict[float, Executor] = {}

    def executor(memory: float) -> Executor:
        need = _rounded_up(memory) if declares else 0.0
        if need not in executors:
            resources = {RESOURCE: need} if need else None
            executors[need] = client.get_executor(pure=False, resources=resources)
        return executors[need]

    return executor


def _rounded_up(memory: float) -> float:
    """Memory with two digits, so that few executors are made."""
    step = 10.0 ** (math.floor(math.log10(memory)) - 1)
    return math.ceil(memory / step) * step
