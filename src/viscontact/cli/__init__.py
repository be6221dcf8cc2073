"""The command line: each command is one call of the package.

Nothing heavy is imported until a command needs it, so that ``--help`` answers at once.
"""

from viscontact.cli.shell import main

__all__ = ["main"]
