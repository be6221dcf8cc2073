"""Commands of studies: their options as arguments, their execution, and what they print."""
