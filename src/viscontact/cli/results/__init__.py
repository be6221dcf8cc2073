"""Tables, figures and pages of stored results."""
