"""Names of the files in a run directory."""

#: The case as it is run.
CASE_NAME = "case.yaml"
#: The result, CF netCDF-4.
RESULT_NAME = "result.nc"
#: A line of scalars per instant.
PROGRESS_NAME = "progress.jsonl"
#: Restart data, until the run is done.
STATE_NAME = "state.npz"
#: Held by the process that computes the run.
LOCK_NAME = ".lock"
