"""`run` with several cases or variations: jobs, schedule, progress, table."""
