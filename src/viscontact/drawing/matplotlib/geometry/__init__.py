"""Figures of indenters and load histories."""
