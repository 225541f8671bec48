"""Derivatives by products of up to four factors: velocities, deflections of fins, speeds and races of propellers."""
