"""Exact equations of motion of a carrier with unbalanced, asymmetric flywheels, as verified C."""

__version__ = "0.1.0"
