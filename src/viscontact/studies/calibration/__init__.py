"""Calibration of a case: values of its keys for which its runs reproduce measured records."""
