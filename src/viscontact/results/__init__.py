"""Labelled results: variables, datasets, netCDF files, the recorded case."""
