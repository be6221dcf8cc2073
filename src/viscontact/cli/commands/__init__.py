"""The commands: their arguments and options."""

import lazy_loader

# Functions of the commands, named in __init__.pyi: a command imports its own only.
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
