"""Entry point: signals are handled from the start, and errors end in an exit code."""

from __future__ import annotations

import gc
import math
import os
from collections.abc import Callable, Sequence
from contextlib import suppress
from operator import attrgetter

from viscontact.backend.errors import is_lack_of_memory
from viscontact.cli.quick_imports import quick_imports
from viscontact.cli.terminal.interruption import Interruption, watched_interruption
from viscontact.cli.terminal.messages import INTERRUPTED, REFUSED, STOPPED, CommandError, say
from viscontact.cli.terminal.screen_size import forget_unreadable_sizes
from viscontact.cli.terminal.streams import occupy_streams, remember_output, unwritten
from viscontact.units.visible import visible

#: Memory that the libraries take before a case has been read [bytes]. With a little less some of
#: them hang or end the process without a message.
LEAST_MEMORY = 3e8


def main(
    arguments: Sequence[str] | None = None,
    code_of: Callable[[CommandError], int] = attrgetter("code"),
) -> int:
    """Run the command line, and return its exit code, that of a failure by `code_of`.

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
        return _run_watched(arguments, code_of)
    except KeyboardInterrupt:  # before or after the command
        say("interrupted")
        return INTERRUPTED
    finally:
        if arguments is not None:  # the program that asked goes on: it collects what it had frozen
            gc.unfreeze()


def _run_watched(arguments: Sequence[str] | None, code_of: Callable[[CommandError], int]) -> int:
    with watched_interruption(until_exit=arguments is None) as interruption:
        limit_libraries()
        forget_unreadable_sizes()
        typed = None if arguments is None else list(arguments)
        code = _exit_code(typed, interruption, code_of)
        interruption.over = True
        return _flush(code)


def limit_libraries() -> None:
    """Limit linear algebra to one thread, and pydantic to itself, before they are imported."""
    # Inner products over a contact are too short for several threads: up to ten times slower on a
    # busy machine. NumPy reads these variables when it is imported.
    for library in ("OPENBLAS", "MKL", "OMP", "BLIS"):
        os.environ.setdefault(f"{library}_NUM_THREADS", "1")
    # Pydantic would read the metadata of all installed packages to find its plugins.
    os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "1")


def _exit_code(
    typed: list[str] | None, interruption: Interruption, code_of: Callable[[CommandError], int]
) -> int:
    if not has_memory():
        return _lacks_memory()
    try:
        # An import that is interrupted may end in any error.
        with interruption.postponed(), quick_imports():
            from viscontact.cli.shell import call_for

            call = call_for(typed)
        return int(call() or 0)
    except KeyboardInterrupt:
        return _interrupted(interruption)
    except CommandError as end:
        for line in end.lines:
            say(line)
        return code_of(end)
    except SystemExit:  # rich and Typer, when the reader of a pipe has closed it
        return STOPPED
    except Exception as error:
        return _error_code(error, interruption)


def _flush(code: int) -> int:
    """Flush what was printed; where that fails, report it and return another exit code."""
    error = unwritten("stdout")
    if error is not None:
        code = code or STOPPED
        if not isinstance(error, BrokenPipeError):  # `viscontact show DIR | head`
            say(f"viscontact: the output cannot be written: {error.strerror}")
    unwritten("stderr")
    return code


def _interrupted(interruption: Interruption) -> int:
    interruption.over = True  # a further request changes nothing
    say("interrupted")
    return INTERRUPTED


def _error_code(error: Exception, interruption: Interruption) -> int:
    # Typer's own errors have a method `show`; their class differs between its versions.
    show = getattr(error, "show", None)
    if show is not None:
        vars(error)["message"] = visible(str(getattr(error, "message", "")))
        with suppress(OSError):
            show()
        return int(getattr(error, "exit_code", REFUSED))
    if interruption.seen:  # an import or a library may have raised another error
        return _interrupted(interruption)
    if isinstance(error, OSError) and (reason := unwritten("stdout")) is not None:
        if not isinstance(reason, BrokenPipeError):
            say(f"viscontact: the output cannot be written: {reason.strerror}")
        return STOPPED
    if os.environ.get("VISCONTACT_TRACEBACK"):
        raise error
    if is_lack_of_memory(error):
        return _lacks_memory()
    from viscontact.backend.errors import CoreError
    from viscontact.results.damage import DamagedFileError

    if isinstance(error, DamagedFileError | CoreError):
        say(str(error))
        return REFUSED
    say(f"viscontact: unexpected {type(error).__name__}: {error}")
    say("This is a fault of viscontact; set VISCONTACT_TRACEBACK=1 to see where, and report it.")
    return STOPPED


def _lacks_memory() -> int:
    say("viscontact: there is too little memory; give it more (`ulimit -v` shows a limit)")
    return STOPPED


def has_memory() -> bool:
    """True if the libraries fit into the memory that the process may use."""
    return _address_space() >= LEAST_MEMORY


def _address_space() -> float:
    """Limit on the memory of the process [bytes]; infinite without one, and on Windows."""
    try:
        import resource
    except ImportError:
        return math.inf
    limit, _ = resource.getrlimit(resource.RLIMIT_AS)
    return math.inf if limit == resource.RLIM_INFINITY else float(limit)
