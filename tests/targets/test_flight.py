"""The flight recorder on emulated boards: what they log is replayed here, bit for bit."""

from __future__ import annotations

from pathlib import Path

import pytest

from mahovik.core.stand import load as load_stand
from mahovik.core.toolchain.board import build, run
from mahovik.stands import path
from mahovik.use.simulate.flight_log import Start, load, records
from mahovik.use.simulate.replay import CMachine, Outcome, replay
from targets.boards import target
from targets.flight import flight


@pytest.mark.slow
@pytest.mark.parametrize(
    ("board", "name", "real", "torque"), [("m4", "bench8", "float", 0.02), ("m7", "sat4", "double", 0.2)]
)
def test_a_flight_of_two_thousand_steps(board: str, name: str, real: str, torque: float, tmp_path: Path) -> None:
    stand = load_stand(path(name))
    chosen = target(board)
    log = tmp_path / "flight.log"
    log.write_text(run(chosen, build(chosen, flight(stand, real, 2000, torque=torque), tmp_path)))
    data, notes = load(log)
    assert notes == []
    assert sum(isinstance(r, Start) for r in records(data)) == 2
    told = list(replay(CMachine(stand, real), records(data)))
    found = [o for o in told if isinstance(o, Outcome)]
    assert len(told) == len(found) == 2002  # two of them refused
    assert all(o.equal for o in found)
    assert sum(o.status < 0 for o in found) == 2
    assert abs(found[-1].after["phi_dot"]).max() > 0.1  # it moved
