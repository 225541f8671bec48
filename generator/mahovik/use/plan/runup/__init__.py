"""Run-up from rest into a periodic programme, and run-down: by shooting, the carrier free to deviate on the way."""

from mahovik.use.plan.runup.solve import shortcomings, with_runup

__all__ = ["shortcomings", "with_runup"]
