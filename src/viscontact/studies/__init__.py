"""Studies: many runs of one case with other values, in search of something or for an overview."""
