"""Quiet: speeds and phases of redundant flywheels whose unbalance cancels at a point, with the momentum kept."""

from mahovik.use.vibration.quiet.options import MEASURES, Measure, QuietOptions
from mahovik.use.vibration.quiet.result import QuietResult, quiet

__all__ = ["MEASURES", "Measure", "QuietOptions", "QuietResult", "quiet"]
