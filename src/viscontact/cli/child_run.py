"""A run that ends with the process that began it: `python -m viscontact.cli.child_run run CASE`.

Whoever begins it holds the other end of its standard input, and lets go of it to ask it to end, or
by coming to an end, in whichever way. The step at work is finished then, and saved.
"""

from __future__ import annotations

import os
import signal
import sys
import threading

from viscontact.cli.entry import main


def end_with_parent() -> None:
    """Ask this process to end as soon as its standard input does."""
    threading.Thread(target=_outlive_nobody, daemon=True).start()


def _outlive_nobody() -> None:
    while os.read(0, 1):
        pass
    signal.raise_signal(signal.SIGTERM)


if __name__ == "__main__":
    end_with_parent()
    sys.exit(main())
