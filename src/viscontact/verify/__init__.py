"""Verification cases: comparisons of the solver with exact solutions.

Each case presses a body for which an exact solution is known, at several refinements, and states
the error and its observed order. The exact solutions are those of `viscontact.reference`, which
share no numerics with the solver.

"""

from viscontact.verify.case import Case, Comparison, Quantity, Result
from viscontact.verify.suite import CASES, run_cases
from viscontact.verify.table import write_table

__all__ = ["CASES", "Case", "Comparison", "Quantity", "Result", "run_cases", "write_table"]
