"""The `indenter` section of a case file: shapes, profiles and height maps."""
