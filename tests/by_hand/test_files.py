"""Units of an FMU, the seal of a folder of evidence, frequencies that a search of speeds avoids.

In FMI a display unit says how many of it are one SI unit: 1 rad is 180 / pi degrees, 1 rad/s is 30 / pi turns a
minute. A mass of 20 kg on springs of the stiffness k swings at `sqrt(k / 20) / 2 pi` Hz.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from math import pi, sqrt
from pathlib import Path

import pytest

from by_hand.stands import stand, wheel
from mahovik.core.stand import rest_state
from mahovik.out.export.fmu import export_fmu
from mahovik.proof.evidence import check, seal
from mahovik.use.vibration.improve import avoided_bands
from mahovik.use.vibration.speeds import read_speeds
from mahovik.use.vibration.study import vibration
from mahovik.use.vibration.view import find_view


def test_display_units_of_an_fmu() -> None:
    driven = stand(wheel("w"))
    made = export_fmu(driven, "me", "torque", start=rest_state(driven), binary=False)
    root = ET.fromstring(made.files["modelDescription.xml"])
    factors = {
        (str(unit.get("name")), str(shown.get("name"))): float(str(shown.get("factor")))
        for unit in root.iter("Unit")
        for shown in unit.iter("DisplayUnit")
    }
    assert factors == {
        ("rad", "deg"): pytest.approx(180 / pi),
        ("rad/s", "rpm"): pytest.approx(30 / pi),
        ("rad/s", "deg/s"): pytest.approx(180 / pi),
        ("rad/s2", "deg/s2"): pytest.approx(180 / pi),
        ("m", "mm"): 1e3,
        ("kg", "g"): 1e3,
    }
    shown = {tag.get("quantity"): tag.get("displayUnit") for tag in root.iter() if tag.get("quantity")}
    assert shown["AngularVelocity"] == "rpm" and shown["Angle"] == "deg" and shown["Length"] is None


def test_links_in_sealed_evidence_are_no_files(tmp_path: Path) -> None:
    folder, outside = tmp_path / "evidence", tmp_path / "outside"
    (folder / "c").mkdir(parents=True)
    outside.mkdir()
    for name in ("a.txt", "c/b.txt"):
        (folder / name).write_text(name)
    seal(folder, {})
    assert check(folder) == []
    (folder / "a.txt").rename(outside / "a.txt")
    (folder / "a.txt").symlink_to(outside / "a.txt")
    assert check(folder) == [f"{folder / 'a.txt'}: was changed"]
    (folder / "d").symlink_to(outside)
    assert check(folder) == [f"{folder / 'a.txt'}: was changed", f"{folder / 'd'}: is not listed"]
    (folder / "c" / "b.txt").unlink()
    assert f"{folder / 'c/b.txt'}: is missing" in check(folder)


def test_natural_frequencies_are_avoided_on_both_sides() -> None:
    k = 20 * (2 * pi * 15.0) ** 2  # N/m: 15 Hz
    springs = {"stiffness": [k, k, 4 * k, 1e7, 1e7, 1e7], "damping": [1, 1, 1, 1, 1, 1]}
    sprung = stand(
        *(wheel(name, unbalance={"static": "1 g mm"}) for name in "ab"), suspension=springs, point=[{"name": "eye"}]
    )

    result = vibration(sprung, read_speeds(sprung, 0.0), find_view(sprung, "eye"))
    f = 15.0
    kept = [(round(low, 3), round(high, 3)) for low, high in avoided_bands(result, "modes") if high < 20.0]
    assert kept == [(0.9 * f, 1.1 * f)] * 2  # along x and y
    assert avoided_bands(result, ["40Hz", "50..60Hz"]) == [pytest.approx((36.0, 44.0)), (50.0, 60.0)]
    assert sqrt(k / 20) / (2 * pi) == pytest.approx(f)
