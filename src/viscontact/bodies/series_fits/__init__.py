"""Fits of exponential series to creep, relaxation and oscillation tests."""
