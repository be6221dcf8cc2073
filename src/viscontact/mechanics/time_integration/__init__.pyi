from . import default_times, prony_approximation
from .adaptive_steps import AdaptiveSteps
from .boltzmann_sum import BLOCK_STEPS, BoltzmannSum
from .internal_variables import InternalVariables
from .step_estimate import estimated_steps

__all__ = [
    "BLOCK_STEPS",
    "AdaptiveSteps",
    "BoltzmannSum",
    "InternalVariables",
    "default_times",
    "estimated_steps",
    "prony_approximation",
]
