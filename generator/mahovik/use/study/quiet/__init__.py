"""Quiet: speeds and phases of redundant flywheels by which their unbalance cancels at a point, momentum kept."""

from mahovik.use.study.quiet.quieted import Quieted, quiet
from mahovik.use.study.quiet.wish import MEASURES, Measure, Wish

__all__ = ["MEASURES", "Measure", "Quieted", "Wish", "quiet"]
