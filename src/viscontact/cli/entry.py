"""The way in and the way out: signals met from the start, and an exit code, never a traceback."""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from contextlib import suppress

from viscontact.cli.terminal.interruption import Interruption, watched_interruption
from viscontact.cli.terminal.messages import INTERRUPTED, REFUSED, STOPPED, say
from viscontact.cli.terminal.streams import occupy_streams, remember_output, unwritten

#: The libraries take so much before a case has been looked at [bytes]. With a little less some of
#: them hang, or end the process, instead of saying so.
LEAST_MEMORY = 3e8

#: What a loader says of a library for which there is no room.
_NO_ROOM = ("failed to map segment", "cannot allocate memory", "Cannot allocate memory")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line.

    Examples
    --------
    >>> main(["--version"])
    viscontact 0.1.0
    0
    """
    occupy_streams()
    if arguments is None:
        remember_output()
    try:
        return _watched(arguments)
    except KeyboardInterrupt:  # in the first or the last moment
        say("interrupted")
        return INTERRUPTED


def _watched(arguments: Sequence[str] | None) -> int:
    with watched_interruption(until_exit=arguments is None) as interruption:
        # Inner products over a contact are too short for the threads of a BLAS, which then wait
        # for one another: ten times slower on a busy machine. NumPy reads this when imported.
        for library in ("OPENBLAS", "MKL", "OMP", "BLIS"):
            os.environ.setdefault(f"{library}_NUM_THREADS", "1")
        code = _answered(None if arguments is None else list(arguments), interruption)
        interruption.over = True
        return _written(code)


def _answered(typed: list[str] | None, interruption: Interruption) -> int:
    if _address_space() < LEAST_MEMORY:
        return _lacks_memory()
    try:
        # An import that is interrupted may end in any error.
        with interruption.postponed():
            from viscontact.cli.shell import command
        return int(command(typed, prog_name="viscontact", standalone_mode=False) or 0)
    except KeyboardInterrupt:
        return _interrupted(interruption)
    except SystemExit:  # rich and Typer, when the reader of a pipe has had enough
        return STOPPED
    except Exception as error:
        return _error_code(error, interruption)


def _written(code: int) -> int:
    """See to it that all that was printed is written, and say it if not."""
    error = unwritten("stdout")
    if error is not None:
        code = code or STOPPED
        if not isinstance(error, BrokenPipeError):  # `viscontact show DIR | head`
            say(f"viscontact: the output cannot be written: {error.strerror}")
    unwritten("stderr")
    return code


def _interrupted(interruption: Interruption) -> int:
    interruption.over = True  # once more changes nothing
    say("interrupted")
    return INTERRUPTED


def _error_code(error: Exception, interruption: Interruption) -> int:
    # Typer's own errors know how to show themselves; their class has moved between its versions.
    show_itself = getattr(error, "show", None)
    if show_itself is not None:
        with suppress(OSError):
            show_itself()
        return int(getattr(error, "exit_code", REFUSED))
    if interruption.seen:  # whatever an import or a library has made of it
        return _interrupted(interruption)
    if isinstance(error, OSError) and (reason := unwritten("stdout")) is not None:
        if not isinstance(reason, BrokenPipeError):
            say(f"viscontact: the output cannot be written: {reason.strerror}")
        return STOPPED
    if os.environ.get("VISCONTACT_TRACEBACK"):
        raise error
    if _is_lack_of_memory(error):
        return _lacks_memory()
    say(f"viscontact: unexpected {type(error).__name__}: {error}")
    say("This is a fault of viscontact; set VISCONTACT_TRACEBACK=1 to see where, and report it.")
    return STOPPED


def _lacks_memory() -> int:
    say("viscontact: there is too little memory; give it more (`ulimit -v` shows a limit)")
    return STOPPED


def _address_space() -> float:
    """How many bytes the process may take, where the system sets a limit (not on Windows)."""
    try:
        import resource
    except ImportError:
        return math.inf
    limit, _ = resource.getrlimit(resource.RLIMIT_AS)
    return math.inf if limit == resource.RLIM_INFINITY else float(limit)


def _is_lack_of_memory(error: BaseException | None) -> bool:
    while error is not None:
        if isinstance(error, MemoryError) or any(text in str(error) for text in _NO_ROOM):
            return True
        error = error.__cause__ or error.__context__
    return False
