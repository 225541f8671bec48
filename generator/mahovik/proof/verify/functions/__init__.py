"""Judges of the public functions that answer no want of `eval`: every one of them gets rows of its own."""
