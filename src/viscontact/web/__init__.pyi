from .app import unguarded
from .calculator import Calculator
from .runs.queue import usual_at_once

__all__ = ["Calculator", "unguarded", "usual_at_once"]
