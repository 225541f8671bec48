"""Referees of the C, and the harness that compares them with it.

Enters: a stand and its C. Leaves: differences, verdicts, evidence.
"""
