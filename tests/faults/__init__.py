"""Planted faults: each is caught by the check that it names, and that check passes without the fault."""
