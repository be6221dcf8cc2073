"""Units: parsing of quantities to SI numbers, and formatting of SI numbers.

Case files and the command line accept ``"5 mm"``; all calculations are in SI units. Tables and
figures show readable units.
"""
