"""Names of the files in a run directory, and in the directory of a sweep."""

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
#: Command whose task computes the run, until the task ends.
ATTEMPT_NAME = ".attempt"
#: Outcome and messages of a run that has failed, until it begins again.
FAILURE_NAME = "failure.json"
#: In the directory of a sweep: a line per run.
MANIFEST_NAME = "runs.jsonl"
#: In the directory of a sweep: asks its active runs to save and end.
STOP_NAME = ".stop"
