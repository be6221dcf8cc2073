"""Printing, drawing, fitting and writing of materials."""
