"""mahovik excite of held carriers: a programme that is a regime, and what makes no sense."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from cli.run import refused, run
from identify.test_excite import STICK
from mahovik.core.motion.programme import load_programme
from mahovik.out.api.stands import Stand
from mahovik.out.identify.excite import face


@pytest.fixture(autouse=True)
def few(monkeypatch: pytest.MonkeyPatch) -> None:
    """A search of some programmes."""
    monkeypatch.setattr(face, "EVALUATIONS", 4)


def test_the_programme_of_a_pendulum_is_a_regime(own_folder: Path) -> None:
    Stand.from_dict(STICK).save("stick.toml")
    made = run("excite", "stick.toml", "--free", "wheel.inertia.J11", "--channels", "gyro.rate.y, hold.reaction.*",
               "--speed", "300 rpm", "--duration", "0.5", "--rate", "500", "--noise", "hold.moment=1 N mm",
               "-o", "p.json", "--json")  # fmt: skip
    assert made.exit_code == 0, made.output
    assert json.loads(made.stdout)["parameters"][0]["standard_error"] > 0.0
    programme = load_programme(own_folder / "p.json")
    assert programme.coordinates == ("pitch",) and programme.bias.shape == (1,)
    done = run("simulate", "stick.toml", "--regime", "p.json", "--until", "0.5", "-o", "run.csv")
    assert done.exit_code == 0, done.output


@pytest.mark.parametrize(
    ("hold", "options", "words"),
    [
        ({"freedoms": []}, ("--channels", "gyro.*"), "the carrier is clamped, so that its sensors read the same all"),
        ({"freedoms": []}, ("--channels", "hold.reation.x"), 'did you mean "hold.reaction.x"'),
        ({"freedoms": []}, ("--channels", ","), "expected names of channels between commas"),
        ({"freedoms": ["pitch"]}, ("--noise", "gyro.force=1"), "unknown channel"),
        ({"freedoms": ["pitch"]}, ("--noise", "force=1 N m"), "expected a force"),
        ({"freedoms": ["pitch"]}, ("--free", "hold.freedoms"), "hold.freedoms"),
    ],
)
def test_what_makes_no_sense_is_refused(own_folder: Path, hold: Any, options: tuple[str, ...], words: str) -> None:
    Stand.from_dict({**STICK, "hold": hold}).save("stick.toml")
    said = refused("excite", "stick.toml", "--speed", "300 rpm", "--duration", "0.5", "-o", "p.json", *options)
    assert words in said and said.startswith("error: ") and said.count("\n") == 1
    assert not (own_folder / "p.json").exists()
