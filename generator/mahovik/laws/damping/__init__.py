"""Damping of a body by the fluid: linear, quadratic, and hydrodynamic derivatives of its own twist."""
