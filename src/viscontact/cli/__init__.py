"""Command line: each command is one call of the package.

Heavy modules are imported only by the commands that need them, so that ``--help`` is fast, and
nothing is imported before signals are handled.
"""

from viscontact.cli.entry import main

__all__ = ["main"]
