"""Run that ends with its parent process: `python -m viscontact.cli.child_run run CASE`.

The parent holds the other end of the standard input. When it closes it, or ends for any reason, the
current step is finished and saved, and the run ends.
"""

from __future__ import annotations

import os
import signal
import sys
import threading

from viscontact.cli.entry import main


def end_with_parent() -> None:
    """Stop this process when its standard input is closed."""
    threading.Thread(target=_stop_at_end_of_input, daemon=True).start()


def _stop_at_end_of_input() -> None:
    while os.read(0, 1):
        pass
    signal.raise_signal(signal.SIGTERM)


if __name__ == "__main__":
    end_with_parent()
    sys.exit(main())
