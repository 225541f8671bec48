"""Outputs that are no regular files have any name: devices, FIFOs and links to them."""

from __future__ import annotations

from pathlib import Path

import pytest

from cli.run import DEMO3, run
from mahovik import stands

SHAKER2 = str(stands.path("shaker2"))
VIBRATION = ("vibration", SHAKER2, "--at", "carrier", "--speed", "left=0..100rpm", "--steps", "3")
SIMULATE = ("simulate", DEMO3, "--until", "0.002")


@pytest.mark.parametrize(
    "arguments",
    [VIBRATION, SIMULATE, ("modes", DEMO3), ("report", DEMO3), ("new", "demo3")],
    ids=lambda case: case[0],
)
def test_a_device_and_a_link_to_one_need_no_ending(arguments: tuple[str, ...], tmp_path: Path) -> None:
    link = tmp_path / "link"
    link.symlink_to("/dev/null")
    for target in ("/dev/null", str(link)):
        assert run(*arguments, "-o", target).exit_code == 0
    assert link.is_symlink() and list(tmp_path.iterdir()) == [link]
