"""mahovik excite of held carriers: a programme that is a regime, and what makes no sense."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from cli.run import run
from identify.test_held import STICK
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
