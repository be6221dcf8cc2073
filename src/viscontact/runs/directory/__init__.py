"""What a run leaves on disk while it goes on: written so that a crash at any moment costs little.

Its modules are imported by name; each takes care of one file of the run's directory.
"""
