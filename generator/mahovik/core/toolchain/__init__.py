"""Compilers, and loading what they made."""
