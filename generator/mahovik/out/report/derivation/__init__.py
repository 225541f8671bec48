"""The derivation for a person to read: one generic flywheel in symbols, then the numbers of the stand."""
