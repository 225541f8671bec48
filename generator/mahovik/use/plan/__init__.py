"""Programmes: flywheel motions that make the carrier move as required, (12)-(13)."""
