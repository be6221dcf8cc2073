"""The command line: each command is one call of the package.

Nothing heavy is imported until a command needs it, so that ``--help`` answers at once, and
nothing at all before signals are met.
"""

from viscontact.cli.entry import main

__all__ = ["main"]
