"""Buoyancy: Archimedes force on a body that displaces fluid."""
