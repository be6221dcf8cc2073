"""Files of a run directory: result, progress log, restart state and lock."""
