"""Folder of the calculator page: files, names, pictures."""
