"""Contact problem that a run solves: bodies, load, grid, times and tolerances."""
