from .preparation import prepare
from .problem import steady_problem

__all__ = [
    "prepare",
    "steady_problem",
]
