"""Bad input: generated case files, tables, cards, surfaces and calls, and what must hold."""
