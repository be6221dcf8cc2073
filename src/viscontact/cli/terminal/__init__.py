"""Messages, progress, streams and interruption at a terminal."""
