"""Regimes: what drives the flywheels, and which wrenches act, in time. Files, interpolation, checks."""

from mahovik.core.motion.read import load, loads, steady
from mahovik.core.motion.regime import Driven, Regime

__all__ = ["Driven", "Regime", "load", "loads", "steady"]
