"""Commands of studies: `design`, `sensitivity` and `fit --case`."""
