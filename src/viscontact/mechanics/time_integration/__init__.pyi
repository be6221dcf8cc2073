from . import default_times, prony_approximation
from .adaptive_steps import AdaptiveSteps, estimated_steps
from .boltzmann_sum import BLOCK_STEPS, BoltzmannSum
from .internal_variables import InternalVariables

__all__ = [
    "BLOCK_STEPS",
    "AdaptiveSteps",
    "BoltzmannSum",
    "InternalVariables",
    "default_times",
    "estimated_steps",
    "prony_approximation",
]
