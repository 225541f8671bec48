"""Slews: the fastest or the quietest turn from rest to rest by demanded rows alone, within the limits of the motors."""

from mahovik.use.plan.slew.plan import plan_slew

__all__ = ["plan_slew"]
