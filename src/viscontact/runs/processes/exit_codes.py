"""How a process ends: done, stopped during its work, refused before it, or interrupted."""

DONE, STOPPED, REFUSED, INTERRUPTED = 0, 1, 2, 130
