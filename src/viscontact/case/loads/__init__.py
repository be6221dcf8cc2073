"""The `load` section of a case file: histories, tables and sentences."""
