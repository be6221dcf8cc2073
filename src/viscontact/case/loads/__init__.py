"""Load sections of a case file: histories, tables and sentences."""
