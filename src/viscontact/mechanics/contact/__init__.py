"""Contact problem of one time step: domain, constraints, solver, rim of the contact."""
