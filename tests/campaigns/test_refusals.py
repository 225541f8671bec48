"""What a campaign file may not say: each refusal in one line, with the message that a user sees."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from campaigns.files import RUN, VARY, read
from mahovik.errors import CampaignError, MahovikError

ENTRIES = {
    '"rw5.mass" = { tolerance = "1 g" }': 'vary "rw5.mass": sat4 has no "rw5", did you mean "rw1"?',
    '"wheel*.mass" = { tolerance = "1 g" }': 'no name matches "wheel*"',
    '"rw1.mass" = { tolerance = "1 mm" }': 'tolerance: unit "mm" does not fit, expected a mass (kg)',
    '"rw1.mass" = { normal = ["1 kg", "1 mm"] }': 'vary "rw1.mass": normal[1]: unit "mm" does not fit',
    '"rw1.mass" = { norml = ["1 kg", "1 g"] }': 'unknown key "norml", did you mean "normal"?',
    '"rw1.mass" = { normal = [1, 0.1], uniform = [1, 2] }': "expected one of normal, relative",
    '"rw1.mass" = "1 kg"': "expected a table such as",
    '"rw1.mass" = { uniform = ["3 kg", "2 kg"] }': "uniform: expected rising numbers, found 3 2 kg",
    '"rw1.mass" = { normal = [-1, 0.1] }': "normal[0]: -1 kg is negative",
    '"rw1.mass" = { normal = [2, -0.1] }': "normal: -0.1 kg is negative",
    '"rw1.mass" = { normal = [2, 0.1], least = 9 }': "the distribution has no values between them",
    '"gravity[2]" = { relative = 0.1 }': "gravity[2] is zero in the stand file",
    '"rw1" = { tolerance = "1 g" }': "is a table; expected the path of a number, such as rw1.mass",
    '"rw1.motor.resistance" = { relative = 0.1 }': "decides nothing that is computed here",
    '"rw1.unbalance.dynamic" = { grade = "G 1", speed = 1 }': "grade: limits the static unbalance",
    '"rw1.unbalance" = { grade = "G 2.5" }': "speed: required with grade, but missing",
    '"rw1.unbalance" = { grade = 2.5, speed = "3000 rpm" }': 'expected a balance quality grade, such as "G 2.5"',
    '"rw1.unbalance" = { grade = "G 2.5", speed = 1, share = { grade = "G 1" } }': "share: grade: not allowed here",
    '"rw1.mass" = { lognormal = ["0 kg", 0.1] }': "lognormal[0]: 0 kg is not above 0",
    '"rw*.mass" = { relative = 0.1 }\n"*1.mass" = { relative = 0.2 }': "rw1.mass varies twice, also by",
    '"rw*.mass" = { relative = 0.1 }\n[[correlation]]\nof = ["rw1.mass"]\ncoefficient = 0.5': "expected two numbers",
    '"rw*.mass" = { relative = 0.1 }\n[[correlation]]\nof = ["carrier.mass"]\ncoefficient = 0.5': "does not vary",
    '"rw*.mass" = { relative = 0.1 }\n[[correlation]]\nof = ["rw*.mass"]\ncoefficient = -0.5': "not positive definite",
}


@pytest.mark.parametrize("entry", ENTRIES)
def test_what_cannot_vary_is_refused_by_name(tmp_path: Path, entry: str) -> None:
    with pytest.raises(CampaignError) as refused:
        read(tmp_path, f"[vary]\n{entry}\n{RUN}", stand="sat4")
    assert ENTRIES[entry] in str(refused.value) and "\n" not in str(refused.value)


def test_an_unbalance_varies_once(tmp_path: Path) -> None:
    body = '[vary]\n"w1.unbalance.static" = { relative = 0.1 }\n"w1.center_of_mass[1]" = { tolerance = "1 mm" }\n'
    with pytest.raises(CampaignError, match=r"w1.center_of_mass\[1\] and w1.unbalance.static are the same unbalance"):
        read(tmp_path, body + RUN, stand="bench8")


QUANTITIES = {
    'name = "a"\nwhat = "velocity"': 'what: expected a statistic and a signal such as "rms acceleration"',
    'name = "a"\nwhat = "rms velocty"': 'what: unknown "velocty", did you mean "velocity"?',
    'name = "a"\nwhat = "rms error"': "what: no error over regime",
    'name = "a"\nwhat = "rms velocity"\nbnd = 3': 'unknown key "bnd", did you mean "band"?',
    'what = "rms velocity"': "quantity[0], name: required, but missing",
    'name = "shake"\nwhat = "rms velocity"\n[[quantity]]\nname = "shake"\nwhat = "rms rate"\nat = "carrier"': "another",
    'name = "sample"\nwhat = "rms velocity"': "is the name of another column",
    'name = "a"\nwhat = "rms velocity"\naxis = "w"': "axis: w: expected one of x, y, z",
    'name = "a"\nwhat = "peak velocity"\nband = ["1 Hz", "2 Hz"]': "band: only allowed with rms",
    'name = "a"\nwhat = "rms velocity"\nband = ["3 Hz", "2 Hz"]': "expected a lower and a higher frequency",
    'name = "a"\nwhat = "peak torque"': 'at: unknown "carrier"',
}


@pytest.mark.parametrize("keys", QUANTITIES)
def test_quantities_that_mean_nothing_are_refused(tmp_path: Path, keys: str) -> None:
    with pytest.raises(CampaignError) as refused:
        read(tmp_path, VARY + RUN.partition("[[quantity]]")[0] + '[[quantity]]\nat = "carrier"\n' + keys)
    assert QUANTITIES[keys] in str(refused.value)


KEYS: list[tuple[dict[str, Any], str]] = [
    ({"design": "sobel"}, 'design: unknown "sobel", did you mean "sobol"?'),
    ({"stand": "sat5"}, 'stand: no stand file "sat5" beside it, and no such example, did you mean "sat4"?'),
    ({"samples": 0}, "samples: 0: expected 1 to"),
    ({"sample": 3}, 'unknown key "sample", did you mean "samples"?'),
    ({"design": "latin", "samples": 60000000}, 'with design "latin"'),
    ({"seed": -1}, "seed: -1: expected 0 to"),
]


@pytest.mark.parametrize(("head", "words"), KEYS)
def test_keys_that_mean_nothing_are_refused(tmp_path: Path, head: dict[str, Any], words: str) -> None:
    with pytest.raises(CampaignError) as refused:
        read(tmp_path, VARY + RUN, **head)
    assert words in str(refused.value)


RUNS = {
    "": "over: expected exactly one of regime, speeds, programme, states, found none",
    'regime = "r.toml"\nspeeds = { w1 = 1 }': "over: expected exactly one of regime, speeds, programme, states",
    'regime = { default = { speed = 1 } }\nuntil = "10 mm"': 'over, until: unit "mm" does not fit, expected a time (s)',
    "regime = { default = { speed = 1 } }": "over, until: required, but missing",
    "speeds = { w1 = 100 }\nuntil = 1": 'over: unknown key "until"',
    'speeds = { w1 = "1..2 rpm" }': "over: speeds: a range of speeds",
    'speeds = "1500 rpm"': 'over, speeds: expected a table, found "1500 rpm"',
    'programme = "p.json"': "over, motion: required, but missing",
    'states = "none.jsonl"': "none.jsonl",
}


@pytest.mark.parametrize("over", RUNS)
def test_runs_that_cannot_be_are_refused(tmp_path: Path, over: str) -> None:
    with pytest.raises(MahovikError) as refused:
        read(tmp_path, VARY + f"[over]\n{over}\n[[quantity]]" + RUN.partition("[[quantity]]")[2]).rows(0, 0)
    assert RUNS[over] in str(refused.value)
