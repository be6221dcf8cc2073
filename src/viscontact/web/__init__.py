"""Calculator page: a web server for one user on their own machine.

Only the command `serve` imports it.
"""
