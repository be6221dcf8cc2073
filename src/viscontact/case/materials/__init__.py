"""Material sections of a case file: laws, tables, shifts, names of the library."""
