"""Our results beside exact ones: the cases that users, tests and the documentation run.

Each case presses a body for which theory has an answer, at several refinements, and states how far
off we are and how fast that falls. The exact solutions are `viscontact.reference`; they share no
numerics with what is checked.
"""

from viscontact.verify.case import Case, Comparison, Quantity, Result
from viscontact.verify.suite import CASES, run_cases
from viscontact.verify.table import write_table

__all__ = ["CASES", "Case", "Comparison", "Quantity", "Result", "run_cases", "write_table"]
