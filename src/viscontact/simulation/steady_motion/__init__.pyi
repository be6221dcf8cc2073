from .preparation import prepare
from .problem import refuse_several_pressures, steady_problem

__all__ = [
    "prepare",
    "refuse_several_pressures",
    "steady_problem",
]
