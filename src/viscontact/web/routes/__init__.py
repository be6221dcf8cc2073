"""HTTP routes of the calculator page."""
