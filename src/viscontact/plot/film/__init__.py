"""Animations: frames, layout of a frame, files."""
