"""A slew followed by sampled servos: it ends where demanded, and on another stand where its momentum takes it."""

from __future__ import annotations

import json
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any, cast

import numpy as np
import pytest

from cli.run import refused, run
from mahovik.core.motion.motion_file import motion_of_slew
from mahovik.core.motion.programme import save_programme
from mahovik.core.motion.servo import read_servo
from mahovik.core.stand import Stand
from mahovik.core.stand.fields import Mat3
from mahovik.core.stand.stand_file import dumps
from mahovik.proof.verify.programme.verification import ARCSEC
from mahovik.use.control.loop import Case, close_loop, errors_of
from mahovik.use.control.trim import ReferenceMotion
from mahovik.use.plan.slew import plan_slew
from plan.slew_stands import ATTITUDE, PYRAMID, about, inertia, satellite, slew

SERVO = 'schema = 1\nsample_period = "20 ms"\nlatency = "1 ms"\nbandwidth = "2 Hz"\n'
ANGLE = 0.3
SPINS = 0.02 * 4.0 / 3.0
"""Sum of the spin inertias about any axis: the four axes of the pyramid are spread evenly."""


@cache
def stand() -> Stand:
    return satellite(PYRAMID)


def principal() -> tuple[np.ndarray, float]:
    """A principal axis of the satellite, and its inertia with wheels locked."""
    values, axes = np.linalg.eigh(inertia(stand()))
    return axes[:, 0], float(values[0]) + SPINS


def keys_of(kind: str) -> dict[str, Any]:
    """Keys of a motion file, without those that all slews have."""
    keys: dict[str, Any] = {"name": "turn", "duration": 6}
    if kind == "sight":
        return keys | {"rows": [{"point": "sensor", "rows": ["wx", "wy"]}], "end": {"direction": [0.1, -0.2, 1.0]}}
    return keys | {"end": about(principal()[0], ANGLE), "start": {"phi_dot": [4, -4, 4, -4]}}


@cache
def planned(kind: str) -> ReferenceMotion:
    wanted = slew(stand(), **keys_of(kind))
    programme = plan_slew(stand(), wanted, verify=False).programmes[0]
    return ReferenceMotion.of(stand(), motion_of_slew(wanted, programme), programme, None)


def case(kind: str, real: Stand | None = None) -> Case:
    return Case(planned(kind), real or stand(), read_servo(SERVO, stand()), 1, start="programme")


def heavier(share: float) -> Stand:
    """The satellite with 1 + share times the inertia that it has with wheels locked."""
    J = np.array(stand().carrier.inertia)
    more = J + share * (inertia(stand()) + SPINS * np.eye(3))
    inertia_now = cast(Mat3, tuple(map(tuple, more.tolist())))
    return replace(stand(), carrier=replace(stand().carrier, inertia=inertia_now))


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["attitude", "sight"])
def test_a_slew_from_rest_ends_where_demanded(kind: str) -> None:
    record = close_loop(case(kind))
    errors = errors_of(record)
    assert record.stopped is None
    assert errors.amplitude[3:].max() > 0.1
    assert np.abs(record.V[0]).max() == 0.0
    assert errors.slew is not None
    assert errors.slew["angle"] < 0.1 * ARCSEC
    assert errors.slew["rate"] < ARCSEC
    assert errors.share_end is not None
    assert 0.0 < errors.share_end <= errors.share < 1e-5


@pytest.mark.slow
def test_a_stand_with_more_inertia_turns_less_by_the_law_of_momentum() -> None:
    errors = errors_of(close_loop(case("attitude", heavier(0.02))))
    assert errors.slew is not None
    assert errors.slew["angle"] == pytest.approx(ANGLE * (1.0 - 1.0 / 1.02), rel=1e-4)
    assert errors.share_end == pytest.approx(errors.share, rel=1e-3)


@pytest.fixture
def files(tmp_path: Path) -> dict[str, str]:
    """The satellite, a slew of its attitude, its programme and servos, as files."""
    paths = {name: str(tmp_path / name) for name in ("sat.toml", "P.json", "M.json", "S.toml")}
    Path(paths["sat.toml"]).write_text(dumps(stand()))
    Path(paths["M.json"]).write_text(json.dumps({"schema": 1, "type": "slew", "rows": ATTITUDE} | keys_of("attitude")))
    Path(paths["S.toml"]).write_text(SERVO)
    save_programme(planned("attitude").programme, paths["P.json"])
    return paths


def arguments(files: dict[str, str]) -> list[str]:
    pairs = (("--programme", "P.json"), ("--motion", "M.json"), ("--servo", "S.toml"))
    return [files["sat.toml"], *(x for option, name in pairs for x in (option, files[name]))]


@pytest.mark.parametrize(
    ("more", "words"),
    [
        (["--periods", "12"], "--periods 12: P.json is finite, and followed once"),
        (["--begin", "settled"], "--begin settled: P.json is finite, and followed once"),
        (["--table", "64"], "--table 64: P.json is finite, and followed once"),
    ],
)
def test_options_of_periodic_programmes_are_refused(files: dict[str, str], more: list[str], words: str) -> None:
    said = refused("simulate", *arguments(files), *more)
    assert words in said
    assert len(said.splitlines()) == 1


@pytest.mark.slow
def test_the_servos_of_a_slew_are_exported_and_judged(files: dict[str, str], tmp_path: Path) -> None:
    board = str(tmp_path / "board")
    assert run("generate", files["sat.toml"], "-o", board).exit_code == 0
    assert run("generate", *arguments(files), "-o", board).exit_code == 0
    judge = ["verify", files["sat.toml"], board, "--servo", files["S.toml"], "--motion", files["M.json"]]
    said = run(*judge, "--programme", files["P.json"], "--states", "20", "--json")
    assert said.exit_code == 0, said.output
    ticks = [row for row in json.loads(said.stdout)["rows"] if row["judged"] == "SERVO_TICKS"]
    assert [row["verdict"] for row in ticks] == ["ok"]
    assert "is a slew, whose course `mahovik plan` finds: give its programme as well" in refused(*judge)
    text = json.loads(Path(files["P.json"]).read_text())
    Path(files["P.json"]).write_text(json.dumps(text | {"motion": "other"}))
    assert "programme of another motion" in refused(*judge, "--programme", files["P.json"])
    only = [*judge[:5], "--programme", files["P.json"]]
    assert "--programme: needs --motion FILE" in refused(*only)


def test_before_and_after_it_the_wheels_turn_evenly_and_the_carrier_rests() -> None:
    wanted = planned("attitude")
    span = wanted.motion.span
    angles = wanted.angles(np.array([-2.0, 0.0, span, span + 2.0]))
    assert angles.phi[1] - angles.phi[0] == pytest.approx(2.0 * angles.phi_dot[1])
    assert angles.phi[3] - angles.phi[2] == pytest.approx(2.0 * angles.phi_dot[2])
    assert not angles.phi_ddot[[0, 3]].any()
    q = wanted.required_course(np.array([-2.0, 0.0, span, span + 2.0]))
    assert (q[0] == q[1]).all()
    assert (q[2] == q[3]).all()
