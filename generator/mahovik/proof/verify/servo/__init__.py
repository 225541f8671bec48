"""Verification of the C of servos: functions and tables of an exported folder against their law in plain NumPy."""

from mahovik.proof.verify.servo.judge import verify_servo

__all__ = ["verify_servo"]
