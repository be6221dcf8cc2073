"""Sensitivity: derivatives of scalars of the result with respect to the inputs of a case."""
