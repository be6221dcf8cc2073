"""Execution of many recorded runs: tasks, executors, and the driver that submits and stops them."""
