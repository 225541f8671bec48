"""Servos that make the flywheels follow a programme: the servo file and its data."""

from mahovik.core.motion.servo.model import COORDINATES, Servo, Trim
from mahovik.core.motion.servo.read import load_servo, read_servo

__all__ = ["COORDINATES", "Servo", "Trim", "load_servo", "read_servo"]
