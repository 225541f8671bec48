"""Servos for the programmes made by hand, and their C: written, compiled, run."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from emit.stands import write
from export.programmes import motion, spin, stand, stand_files, started, swaying
from mahovik.core.motion.servo import Servo, read_servo
from mahovik.out.export.servo import ExportedServo, export_servo

HEAD = 'schema = 1\nname = "follow"\nsample_period = "0.5 ms"\nbandwidth = "60 Hz"\nlatency = "700 us"\n'
TRIM = 'integral = "4 Hz"\n[trim]\ncoordinates = ["z"]\nharmonics = 1\nsettling = 40\ngain = 0.3\n'


def servo(text: str = "") -> Servo:
    """Servo at 2 kHz, with a delay of more than a sample."""
    return read_servo(HEAD + text, stand())


@cache
def exported(name: str, real: str = "double") -> ExportedServo:
    """`spin` with its motion, `trimmed` with a trim as well; `swaying`, `started` of no motion, without feedforward."""
    if name in ("spin", "trimmed"):
        return export_servo(stand(), spin(), motion(), servo(TRIM if name == "trimmed" else ""), real)
    programme = {"swaying": swaying, "started": started}[name]()
    return export_servo(stand(), programme, None, servo("feedforward = false\n"), real)


def written(made: ExportedServo, folder: Path, real: str = "double") -> Path:
    """Servo, programme and stand in a folder; returns the servo's source."""
    write({**stand_files(real), **made.programme.files, **made.servo}, folder)
    return folder / "shaker2_servo.c"
