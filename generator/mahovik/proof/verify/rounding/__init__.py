"""Rounding, bounded: the true error of the C, by balls that hold the exact answer. Needs python-flint."""
