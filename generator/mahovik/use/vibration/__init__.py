"""Vibration under turning flywheels: steady motions, sweeps, spectra, requirements, quiet speeds; Campbell diagrams."""
