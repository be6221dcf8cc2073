"""Command `sensitivity`: its progress, its files and the lines that it prints."""
