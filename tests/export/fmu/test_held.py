"""FMUs of held carriers in fmpy's hands move as `mahovik simulate` does, with the reaction of the hold."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import fmpy
import numpy as np
import pytest

from cli.run import run
from cli.test_eval_held import TEXT
from export.fmu.test_simulation import DT, EVERY, UNTIL, pairs
from mahovik.core.lower.fmu.variables import Inputs, Kind
from mahovik.core.motion import loads_regime
from mahovik.core.stand.hold import twist_of
from mahovik.core.stand.model import Stand
from mahovik.core.stand.read import loads
from mahovik.core.stand.state import State, rest_state
from mahovik.out.export.fmu import export_fmu
from mahovik.use.simulate import Case, simulate
from mahovik.use.simulate.held import complete_start

HOLDS = {
    "pendulum": ('["pitch"]', (2.0,)),
    "plane": ('["yaw", "x", "y"]', (2.0, 0.3, -0.2)),
    "ball joint": ('["roll", "pitch", "yaw"]', (1.0, 2.0, -0.5)),
    "clamped": ("[]", ()),
}
FORMS: tuple[tuple[str, str, Kind, Inputs], ...] = (
    ("pendulum", "2.0", "cs", "torque"),
    ("plane", "3.0", "cs", "acceleration"),
    ("ball joint", "2.0", "me", "torque"),
    ("clamped", "3.0", "cs", "torque"),
)


def moving(name: str) -> tuple[Stand, State]:
    ways, u = HOLDS[name]
    text = TEXT.replace('["pitch"]', ways)
    stand = loads(text if ways != "[]" else text.replace("pivot = [0, 0, -0.2]\n", ""))
    assert stand.hold is not None
    state = replace(rest_state(stand), u=u, V=twist_of(stand.hold, u), phi_dot=(40.0,))
    return stand, complete_start(stand, state, {"u", "phi_dot"})


@pytest.mark.parametrize(("name", "version", "kind", "inputs"), FORMS)
def test_it_moves_as_simulate_does(name: str, version: str, kind: Kind, inputs: Inputs, tmp_path: Path) -> None:
    stand, state = moving(name)
    torque = inputs == "torque"
    law = "torque = 0.02" if torque else "ramp = { from = 40.0, to = 340.0, duration = 10.0 }"
    regime = loads_regime(f"schema = 1\n[flywheel.w1]\n{law}", stand, UNTIL)
    expected = simulate(Case(stand, regime, state, UNTIL, EVERY, DT), mounts=True)
    file = tmp_path / "held.fmu"
    file.write_bytes(export_fmu(stand, version, kind, inputs, dt=DT, start=state).content)
    columns = pairs(stand, inputs)
    columns |= {
        f"hold.reaction[{i + 1}]": f"hold.reaction.{a} [{'N' if i < 3 else 'N m'}]" for i, a in enumerate("xyzkmn")
    }
    found = fmpy.simulate_fmu(
        str(file),
        validate=True,
        stop_time=UNTIL,
        output_interval=EVERY,
        start_values={"w1.tau": 0.02} if torque else {"w1.phi_ddot": 30.0},
        relative_tolerance=1e-9,
        output=list(columns),
    )
    assert np.allclose(found["time"], expected["t [s]"])
    for variable, column in columns.items():
        scale = max(1.0, float(np.abs(expected[column]).max()))
        most = 1e-9 if kind == "cs" else 1e-5  # of one method; of CVODE beside Runge-Kutta
        assert found[variable] == pytest.approx(expected[column], abs=most * scale), variable


def test_the_command_writes_it_and_its_numbers_are_not_those_of_the_hold(tmp_path: Path) -> None:
    (tmp_path / "pendulum.toml").write_text(TEXT)
    target = tmp_path / "pendulum.fmu"
    done = run("export", "fmu", str(tmp_path / "pendulum.toml"), "--no-binary", "-o", str(target))
    assert done.exit_code == 0, done.output
    names = [v.name for v in fmpy.read_model_description(str(target)).modelVariables]
    assert "hold.reaction[6]" in names and "gravity[3]" in names
    assert not any(name.startswith(("S[", "pivot", "sliding", "home_")) for name in names)
