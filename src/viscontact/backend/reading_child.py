"""Process that reads files for its parent, within limits of memory and time.

It takes pickled requests from its standard input, and ends with it. Readings are answered on its
standard output: a line when its libraries are imported, from which the limits count, then a line of
JSON, and the bytes of the arrays that it lists.
"""

from __future__ import annotations

import json
import os
import pickle
import signal
import sys
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, BinaryIO

import numpy as np

from viscontact.backend.errors import is_lack_of_memory
from viscontact.backend.reading_limits import ReadingLimits
from viscontact.backend.record import Record

#: Time without a request after which the process ends [s].
_IDLE = 60


@dataclass(frozen=True)
class ReadingRequest:
    """Reading of one file: functions of modules that the process can import, and arguments."""

    read: Callable[..., Record]
    arguments: tuple[Any, ...]
    prepare: Callable[[], object]  # imports what the reader needs
    limits: ReadingLimits
    by_system: bool = True  # the operating system limits the memory, where it can


def answer_requests() -> None:
    """Answer requests until there are no more."""
    requests = sys.stdin.buffer
    # What libraries print goes to the error output.
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    # The parent, which Ctrl-C reaches as well, ends this process.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    while True:
        _expire(_IDLE)
        try:
            request: ReadingRequest = pickle.load(requests)
        except EOFError:
            return
        _expire(0)
        _answer(request, answers)


def _expire(seconds: int) -> None:
    """End this process after some time, where the system can; 0: never."""
    if sys.platform != "win32":
        signal.alarm(seconds)


def _answer(request: ReadingRequest, answers: BinaryIO) -> None:
    _limit(None)
    request.prepare()
    answers.write(b"ready\n")
    answers.flush()
    _limit(request.limits if request.by_system else None)
    head, arrays = _result(request)
    answers.write(head + b"\n")
    for array in arrays:
        answers.write(memoryview(array).cast("B") if array.size else b"")
    answers.flush()


def _result(request: ReadingRequest) -> tuple[bytes, list[Any]]:
    """Line that describes the record or the error, and the arrays of the record."""
    try:
        record = request.read(*request.arguments)
        arrays = {name: np.ascontiguousarray(array) for name, array in record.arrays.items()}
        shapes = [(name, each.dtype.str, each.shape) for name, each in arrays.items()]
        head = json.dumps({"values": record.values, "arrays": shapes})
        return head.encode("ascii"), list(arrays.values())
    except Exception as error:
        is_lack = is_lack_of_memory(error)
        refusal = {"lacks memory": is_lack, "message": str(error) or type(error).__name__}
    return json.dumps(refusal).encode("ascii"), []


def _limit(limits: ReadingLimits | None) -> None:
    """Limit the memory and the time of this process from now on; None: no longer.

    Time is limited in case that the parent, which watches it, is gone.
    """
    if sys.platform != "linux":
        return
    import resource

    def limit(kind: int, more: float, used: Callable[[], float]) -> None:
        _, hard = resource.getrlimit(kind)
        soft = hard if limits is None else int(used() + more)
        if hard != resource.RLIM_INFINITY:
            soft = min(soft, hard)
        resource.setrlimit(kind, (soft, hard))

    resource.setrlimit(resource.RLIMIT_CORE, (0, resource.getrlimit(resource.RLIMIT_CORE)[1]))
    limit(resource.RLIMIT_DATA, limits.memory if limits else 0, _private_memory)
    limit(resource.RLIMIT_CPU, limits.seconds + 2 if limits else 0, _processor_time)


def _private_memory() -> float:
    """Memory of this process that its limit counts [bytes]."""
    import psutil  # 7 ms, for processes that read alone

    return float(psutil.Process().memory_info().data)


def _processor_time() -> float:
    """Processor time of this process [s]."""
    used = os.times()
    return used.user + used.system
