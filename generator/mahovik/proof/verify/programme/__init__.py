"""Verification of a programme by the literal reference and an adaptive integration, without code of the planner."""

from mahovik.proof.verify.programme.finding import Finding
from mahovik.proof.verify.programme.verification import verify_programme

__all__ = ["Finding", "verify_programme"]
