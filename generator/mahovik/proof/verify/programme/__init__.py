"""Verification of a programme by the literal reference and an adaptive integration, without code of the planner."""
