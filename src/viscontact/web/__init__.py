"""The calculator page: a server for one person, on their own machine.

Nothing of it is imported by any other part of the package but the command that starts it.
"""
