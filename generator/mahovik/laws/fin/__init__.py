"""Lift and drag of fins and of bodies, by the angle of the flow and a deflection."""
