"""Runs as processes of their own: asked for, started, followed, and asked to stop."""
