"""Correction weights from vibration: by influence coefficients of any rotor, by the model of a stand."""
