"""Thrust and torque of propellers by advance ratio."""
