"""Parts of the CPU time of one run at the command line, as JSON on stderr.

Its arguments are those of `viscontact`, with `run`. The parts are imports, set-up, march, error
bars, storing and summary; `./go bench start-up` prints them.
"""

from __future__ import annotations

import builtins
import importlib
import json
import sys
import time
from collections.abc import Callable
from typing import Any

PARTS = ("imports", "march", "error bars", "storing", "summary")


class Account:
    """CPU time of nested calls, each counted for its own part without what it calls [s]."""

    def __init__(self) -> None:
        self.spent = dict.fromkeys(PARTS, 0.0)
        self._open: list[tuple[str, float]] = []  # parts, and time of what they call

    def of(self, part: str, call: Callable[..., Any]) -> Callable[..., Any]:
        """Count a call for a part."""

        def counted(*arguments: Any, **named: Any) -> Any:
            if self._open and self._open[-1][0] == part:
                return call(*arguments, **named)
            began = time.process_time()
            self._open.append((part, 0.0))
            try:
                return call(*arguments, **named)
            finally:
                took = time.process_time() - began
                _, within = self._open.pop()
                self.spent[part] += took - within
                if self._open:
                    around, inside = self._open.pop()
                    self._open.append((around, inside + took))

        return counted


def main() -> int:
    account = Account()
    # Import statements call the first, packages that load their names at first use the second.
    builtins.__import__ = account.of("imports", builtins.__import__)
    importlib.import_module = account.of("imports", importlib.import_module)
    from viscontact.cli.entry import limit_libraries
    from viscontact.cli.entry import main as command
    from viscontact.cli.quick_imports import quick_imports

    limit_libraries()
    with quick_imports():
        from viscontact.cli.run import summary
        from viscontact.runs.directory.recorder import Recorder
        from viscontact.simulation.transient.march import March
    March._solved_step = account.of("march", March._solved_step)  # type: ignore[method-assign]
    for name in ("_record", "finish", "checkpoint", "close"):
        setattr(Recorder, name, account.of("storing", getattr(Recorder, name)))
    bars = account.of("error bars", Recorder.estimate_errors)
    Recorder.estimate_errors = bars  # type: ignore[method-assign]
    summary.print_summary = account.of("summary", summary.print_summary)
    code = command(sys.argv[1:])
    rest = time.process_time() - sum(account.spent.values())
    sys.stderr.write("\n" + json.dumps({**account.spent, "set-up and the rest": rest}))
    return code


if __name__ == "__main__":
    sys.exit(main())
