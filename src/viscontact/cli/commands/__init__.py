"""The commands: their arguments and options."""

from viscontact.backend.lazy_names import attach_stub

# Functions of the commands, named in __init__.pyi: a command imports its own only.
__getattr__, __dir__, __all__ = attach_stub(__name__, __file__)
