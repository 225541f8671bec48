"""The attitude loop of the how-to page on the exact plant of sat4: a slew of 30 degrees, then standing still."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest

from mahovik.core.emit.generate import generate
from mahovik.core.stand import load
from mahovik.stands import path

PAGE = Path(__file__).parents[2] / "docs" / "howto" / "control-loop-1khz.md"
SECONDS = 100
LINE = re.compile(r"\s*(\d+) s: off by\s+(\S+)\s+(\S+)\s+(\S+) arcsec, rw1\s+\S+ rad/s, largest torque (\S+) N m")


@pytest.mark.slow
@pytest.mark.parametrize("real", ["double", "float"])
def test_a_slew_ends_at_its_reference_within_the_motors(real: str, tmp_path: Path) -> None:
    """In 10^5 steps the error is within 1 arcsec from the end of the slew on, and every torque within the motors."""
    stand = load(path("sat4"))
    for name, text in generate(stand, real).items():
        (tmp_path / name).write_text(text, encoding="ascii")
    source = re.search(r"```c main\.c\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
    assert source is not None
    (tmp_path / "main.c").write_text(source[1], encoding="utf-8")
    command = ["gcc", "-std=c99", "-O2", "-ffp-contract=off", "-Wall", "-Wextra", "-Werror", f"-DSECONDS={SECONDS}"]
    subprocess.run([*command, "main.c", "sat4.c", "-o", "main"], cwd=tmp_path, check=True)
    printed = subprocess.run([tmp_path / "main"], check=True, capture_output=True, text=True, timeout=60).stdout
    rows = [[float(x) for x in match.groups()] for match in map(LINE.fullmatch, printed.splitlines()) if match]
    assert [row[0] for row in rows] == [0, 20, 40, 60, 80, 100]
    torque = min(s.motor.torque for s in stand.flywheels if s.motor is not None and s.motor.torque is not None)
    assert all(row[4] < torque for row in rows)
    assert all(abs(x) < 1.0 for row in rows[1:] for x in row[1:4])
    assert max(abs(x) for x in rows[0][1:4]) > 100.0
