"""Measured data of a stand: channels of files, checked, in SI, matched to points, instruments and flywheels."""
