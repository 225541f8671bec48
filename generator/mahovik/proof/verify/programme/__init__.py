"""Verification of a programme by the literal reference and an adaptive integration, without code of the planner."""

from mahovik.proof.verify.programme.verification import verify_programme

__all__ = ["verify_programme"]
