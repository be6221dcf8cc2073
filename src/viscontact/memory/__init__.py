"""What a viscoelastic body remembers: time without space.

Because the half-space kernel separates, the displacement is the Boltzmann integral
u(t) = ∫ J(t - t') dq(t') over the *elastic* displacement q = K p per unit compliance, which the
contact solver computes anyway: history costs no convolution.
"""

from viscontact.memory.choice import MemoryPlan, plan_memory
from viscontact.memory.exponentials import as_exponentials
from viscontact.memory.recursion import RampWeights, RecursiveMemory, ramp_weights
from viscontact.memory.response import Enlarging, Memory, Response
from viscontact.memory.superposition import SuperposedMemory

__all__ = [
    "Enlarging",
    "Memory",
    "MemoryPlan",
    "RampWeights",
    "RecursiveMemory",
    "Response",
    "SuperposedMemory",
    "as_exponentials",
    "plan_memory",
    "ramp_weights",
]
