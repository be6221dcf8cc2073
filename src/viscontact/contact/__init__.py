"""The contact problem of one time step: domain, constraints, solver, contact edge."""
