"""Regimes: what drives the flywheels, and which wrenches act, in time. Files, interpolation, checks."""

from mahovik.core.motion.read import load, loads_regime, steady_regime
from mahovik.core.motion.regime import FlywheelRegime, Regime

__all__ = ["FlywheelRegime", "Regime", "load", "loads_regime", "steady_regime"]
