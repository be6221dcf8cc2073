"""Command `design`: its options, its progress and its result."""
