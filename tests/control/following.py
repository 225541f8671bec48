"""shaker2 with its programme of constant speeds, servos at 2 kHz, and closed loops of it."""

from __future__ import annotations

from functools import cache

from mahovik.core.motion.servo import Servo, read_servo
from mahovik.use.control.loop import Case, Record, close_loop
from mahovik.use.control.mismatch import with_mismatch
from mahovik.use.control.trim import ReferenceMotion, TrimDesign, design_trim
from verify.programme.programmes import shaker

SERVO = """
schema = 1
sample_period = "0.5 ms"
latency = "100 us"
bandwidth = "40 Hz"
"""
TRIM = """
[trim]
harmonics = 2
gain = 0.8
coordinates = ["z"]
settling = 10
averaging = 10
"""

ROUNDS = 6


def wanted(rows: int | None = 64) -> ReferenceMotion:
    """The programme as a table with this many rows."""
    return ReferenceMotion.of(*shaker(), rows)


def servo(trim: bool = False, text: str = SERVO) -> Servo:
    """Servo of the shaker, with a trim by the heave alone if asked."""
    return read_servo(text + TRIM * trim, shaker()[0])


@cache
def design() -> TrimDesign:
    """Design of the trim by the heave alone."""
    follower = servo(trim=True)
    assert follower.trim is not None
    stand, motion, programme = shaker()
    return design_trim(stand, motion, programme, follower.trim)


@cache
def run(share: float, trim: bool) -> Record:
    """Seed 2, from the settled motion; with a trim after ROUNDS corrections."""
    follower = servo(trim)
    periods = ROUNDS * 21 + 10 if trim else 12
    real = with_mismatch(shaker()[0], share, 2)
    return close_loop(Case(wanted(), real, follower, periods, design() if trim else None))
