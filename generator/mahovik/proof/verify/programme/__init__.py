"""Verification of a programme by the literal reference and an adaptive integration: nothing of what planned it."""

from mahovik.proof.verify.programme.finding import Finding
from mahovik.proof.verify.programme.verification import verify_programme

__all__ = ["Finding", "verify_programme"]
