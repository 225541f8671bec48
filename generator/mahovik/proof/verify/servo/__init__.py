"""Verification of the C of servos: functions and tables of an exported folder against their law in plain NumPy."""
