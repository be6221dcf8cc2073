from . import error_bars
from .event_runs import own_events

__all__ = [
    "error_bars",
    "own_events",
]
