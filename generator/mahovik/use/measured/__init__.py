"""Measured data of a stand: channels of files, checked, in SI, matched to points, instruments and flywheels."""

from mahovik.use.measured.clocks import Recording
from mahovik.use.measured.read import read_recordings

__all__ = ["Recording", "read_recordings"]
