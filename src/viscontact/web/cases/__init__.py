"""Cases of the calculator page: reading, coarse variants, drawings."""
