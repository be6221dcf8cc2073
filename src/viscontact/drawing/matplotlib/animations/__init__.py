"""Animations: frames, panels and files."""
