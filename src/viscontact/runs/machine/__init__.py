"""Cores, memory and threads that a process may use on its machine or in its cluster job."""
