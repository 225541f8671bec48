"""Routines against mpmath: `run` interprets them and measures errors."""
