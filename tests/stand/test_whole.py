"""Refusals that need the whole stand, or come before any key is read."""

from __future__ import annotations

from pathlib import Path

import pytest

from mahovik.core.stand import load, loads
from mahovik.errors import StandError

HEAD = 'schema = 1\nname = "s"\n'
WHEEL = '[[flywheel]]\nname = "w1"\nmass = 1\ninertia = [0.02, 0.01, 0.01]\n'
MASSLESS = HEAD + "[carrier]\nmass = 0\ninertia = [0, 0, 0]\n"
ROD = "mass = 1\naxis = [0, 0, 1]\nzero = [0, 1, 0]\nspin_inertia = 1\ntransverse_inertia = [0, 1]\n"


def rods(*positions: str) -> str:
    return MASSLESS + "".join(
        f'[[flywheel]]\nname = "w{i}"\nposition = {at}\n{ROD}' for i, at in enumerate(positions, 1)
    )


@pytest.mark.parametrize(
    "text",
    [
        pytest.param(MASSLESS + WHEEL, id="one flywheel on a massless carrier, at every phase"),
        pytest.param(rods("[0, 0, 0]", "[1, 0, 0]"), id="two rods in one line, at one phase only"),
        pytest.param(rods("[0, 0, 0]", "[1, 0, 0.1]"), id="two parallel rods, turned by their own spin"),
        pytest.param(rods("[0, 0, 0]", "[1, 0.3, 0]", "[2, 0.6, 0]"), id="three rods in one line"),
    ],
)
def test_a_stand_singular_at_some_phase_is_refused(text: str) -> None:
    with pytest.raises(StandError) as caught:
        loads(text, "s.toml")
    (problem,) = caught.value.problems
    assert "mass matrix of the whole stand, scaled to unit diagonal, has the eigenvalue" in problem
    assert "at phases w1 = " in problem


def test_rods_that_never_line_up_are_accepted() -> None:
    assert len(loads(rods("[0, 0, 0]", "[1, 0.3, 0]", "[1, 1, 0]")).flywheels) == 3


def test_files_that_cannot_be_read_are_one_line(tmp_path: Path) -> None:
    missing, folder, binary, broken = (tmp_path / name for name in ("no.toml", "d", "b.toml", "t.toml"))
    folder.mkdir()
    binary.write_bytes(b'schema = 1\nname = "\xff"\n')
    broken.write_text("schema = = 1\n")
    expected = {
        missing: f"{missing}: no such file",
        tmp_path / "bn.toml": f'{tmp_path / "bn.toml"}: no such file, did you mean "{binary}"?',
        folder: f"{folder}: is a directory, expected a stand file (TOML)",
        binary: "b.toml: not UTF-8, byte 0xff in line 2",
        broken: "t.toml: not TOML: Invalid value (at line 1, column 10)",
    }
    for path, message in expected.items():
        with pytest.raises(StandError) as caught:
            load(path)
        assert message == str(caught.value)


def test_the_exit_status_of_a_refusal_is_two() -> None:
    with pytest.raises(StandError) as caught:
        loads("", "empty.toml")
    assert caught.value.exit_status == 2
    expected = [
        "empty.toml: schema: required, but missing",
        "empty.toml: name: required, but missing",
        "empty.toml: carrier: required, but missing",
    ]
    assert expected == list(caught.value.problems)


def test_a_name_of_several_lines_stays_in_one() -> None:
    with pytest.raises(StandError) as caught:
        loads(HEAD + '"a\\nb" = 1\n[carrier]\nmass = 1\ninertia = [1, 1, 1]\n' + WHEEL.replace("w1", "w\\n1"), "s.toml")
    assert list(caught.value.problems) == [
        's.toml: unknown key "a\\nb", expected one of schema, name, angles, gravity, stream, phase_input, carrier, '
        "suspension, leg, torquer, magnetic_field, instrument, flywheel, point",
        's.toml: flywheel "w\\n1", name: "w\\n1" is not a C identifier (letters, digits, _; no digit first)',
    ]


@pytest.mark.parametrize("exponent", range(-300, 301, 50))
@pytest.mark.parametrize("size", range(-200, 201, 50))
def test_numbers_near_the_ends_of_double_precision_are_accepted_or_refused(exponent: int, size: int) -> None:
    wheel = WHEEL.replace("[0.02, 0.01, 0.01]", f"[2e{exponent}, 1e{exponent}, 1e{exponent}]")
    text = (
        HEAD + f"[carrier]\nmass = 1e{exponent}\ninertia = [1, 1, 1]\n{wheel}position = [0, 1e{size}, 0]\n"
        f'center_of_mass = [0, 1e{size - 1}, 0]\ninertia_about = "center_of_mass"\n'
    )
    try:
        loads(text)
    except StandError as error:
        assert all("inertia" in problem or "beyond the range" in problem for problem in error.problems)


def test_what_the_c_cannot_take_is_refused_with_its_key_and_a_ship_is_not() -> None:
    ship = 'schema = 1\nname = "ship"\n[carrier]\nmass = "5000 t"\ninertia = [1e8, 3e9, 3e9]\n'
    assert loads(ship).carrier.mass == 5e6
    with pytest.raises(StandError) as caught:
        loads(ship.replace("5000 t", "5e16 kg"))
    assert "carrier, mass: 5e+16 is beyond the range of the emitted C, expected at most 1e+15" in str(caught.value)


def test_a_stand_does_not_hide_a_header_of_c() -> None:
    with pytest.raises(StandError) as caught:
        loads('schema = 1\nname = "stdint"\n[carrier]\nmass = 1\ninertia = [1, 1, 1]\n')
    assert "stdint.h would hide it" in str(caught.value)
