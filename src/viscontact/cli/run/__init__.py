"""One run: preparation, check, execution, resuming, summary."""
