"""Messages about an unknown name, here and in every reader that takes names."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from cli.run import BENCH8, DEMO3, refused
from mahovik.core.stand.units import LENGTH, MASS, QuantityError, number
from mahovik.nearest import LISTED, suggestion
from mahovik.stands import path

SAT4 = str(path("sat4"))
NAMES = ("mass", "inertia", "position")


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("masss", ', did you mean "mass"?'),
        ("MASS", ', did you mean "mass"?'),
        ("qq", ", expected one of mass, inertia, position"),
        ("", ", expected one of mass, inertia, position"),
        (3, ", expected one of mass, inertia, position"),
    ],
)
def test_the_end_of_a_message(name: object, words: str) -> None:
    assert suggestion(name, NAMES) == words


def test_a_long_list_is_cut() -> None:
    assert suggestion("?", [f"w{k}" for k in range(1000)]).count(",") == 1 + LISTED
    assert suggestion("?", [f"w{k}" for k in range(1000)]).endswith(", w23, ...")


@pytest.mark.parametrize(
    ("unit", "words"),
    [("1 mmm", 'did you mean "mm"?'), ("1 mmq", 'did you mean "mm"?'), ("1 kgg", 'did you mean "kg"?'), ("1 q^2", "")],
)
def test_a_misspelt_unit(unit: str, words: str) -> None:
    with pytest.raises(QuantityError) as refusal:
        number(unit, MASS if "kg" in unit else LENGTH)
    assert words in str(refusal.value)
    assert "expected one of" not in str(refusal.value)  # units are without number


@pytest.mark.parametrize(
    ("arguments", "meant_name"),
    [
        (("new", "bench9"), "bench8"),
        (("check", BENCH8, "--spede", "1"), "--speed"),
        (("vibration", SAT4, "--speed", "rw1=10", "--at", "acc11"), "acc1"),
        (("vibration", SAT4, "--speed", "rw1=2*rw22", "--at", "acc1"), "rw2"),
        (("vibration", SAT4, "--speed", "rw1=10 rpmm", "--at", "acc1"), "rpm"),
        (("verify", BENCH8, "--targets", "m77"), "m7"),
        (("judge", BENCH8, "--with", "cat", "--want", "forwrad"), "forward"),
        (("evidence", BENCH8, "--only", "slftest"), "selftest"),
        (("generate", BENCH8, "--project", "m77"), "m7"),
        (("plan", DEMO3, "--motion", DEMO3.replace(".toml", ".motion.json"), "--free", "w1.postion"), "position"),
        (("simulate", BENCH8, "--until", "1", "-o", "r.csv", "--regime", "regime.toml"), "w1"),
        (("simulate", BENCH8, "--until", "1", "-o", "r.csv", "--start", "state.json"), "phi_dot"),
    ],
    ids=lambda value: " ".join(value[:1] + value[2:]) if isinstance(value, tuple) else value,
)  # fmt: skip
def test_every_door_says_what_was_meant(
    arguments: tuple[str, ...], meant_name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("state.json").write_text(json.dumps({"phi_dto": [0.0] * 8}))
    Path("regime.toml").write_text("schema = 1\n[default]\nspeed = 1\n[flywheel.w11]\nspeed = 1\n")
    Path("motion.json").write_text((Path(BENCH8).parent / "bench8.motion.json").read_text())
    said = refused(*arguments)
    assert re.search(f"""[Dd]id you mean ['"]{meant_name}['"]""", said), said
    assert said.count("\n") == 1
