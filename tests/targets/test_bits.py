"""Emulated boards have the bits of this machine: programmes, servos, flight recorders and attitude loops."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from export.programmes import exported as programme
from export.programmes import stand, stand_files
from export.servos import exported as servos
from mahovik.core.stand import load as load_stand
from mahovik.core.toolchain.targets import build, run
from mahovik.out.export.project import attitude_sources
from mahovik.stands import path
from mahovik.use.control.attitude import LoopOptions
from mahovik.use.simulate.replay import Outcome, Start, c_machine, load, records, replay
from targets.flight import flight
from targets.pil import Run, processor_in_the_loop, read_run
from toolchain.tools import EMBEDDED, target

MAIN = """#include "board.h"
int shaker2_programme_test(void (*print)(const char *text));
int main(void) { return shaker2_programme_test(board_print) != 0; }
"""
PASSED = ["programme_at PASS cases 8 wrong 0", "refusals PASS wrong 0", "clock PASS wrong 0", "failures 0"]


@pytest.mark.slow
@pytest.mark.parametrize("real", ["double", "float"])
@pytest.mark.parametrize("kind", ["quintic", "fourier"])
@pytest.mark.parametrize("name", EMBEDDED)
def test_programmes(name: str, kind: str, real: str, tmp_path: Path) -> None:
    """Their self-test passes on the board; one of the two has a run-up."""
    chosen, motion = target(name), "started" if kind == "quintic" else "swaying"
    sources = {n: t for n, t in programme(motion, kind, real).files.items() if n.endswith((".c", ".h"))}
    sources |= {"shaker2.h": stand_files(real)["shaker2.h"], "main.c": MAIN}
    lines = run(chosen, build(chosen, sources, tmp_path)).splitlines()
    assert [line for line in lines if line in PASSED] == PASSED
    assert ("programme_runup_at PASS cases 8 wrong 0" in lines) == (motion == "started")


def driven(board: str, real: str, folder: Path) -> Run:
    """Output of a board on which servos drive a stand that has heavier flywheels."""
    wheels = tuple(replace(s, mass=s.mass * (1 + 0.01 * (-1) ** i)) for i, s in enumerate(stand().flywheels))
    chosen, place = target(board), folder / board
    texts = processor_in_the_loop(stand(), replace(stand(), flywheels=wheels), servos("trimmed", real), 200)
    place.mkdir()
    return read_run(run(chosen, build(chosen, texts, place, "-O0" if board == "host" else None), timeout=300))


@pytest.mark.slow
@pytest.mark.parametrize(("name", "real"), [("m7", "double"), ("m4", "float"), ("rv64gc", "double"), ("m55", "double")])
def test_servos_with_the_processor_in_the_loop(name: str, real: str, tmp_path: Path) -> None:
    host, board = (driven(place, real, tmp_path) for place in ("host", name))
    assert len(set(host.torques)) == 200  # the loop is alive
    assert board.torques == host.torques
    assert (board.followed, board.limited) == (host.followed, host.limited)
    assert 0 < host.followed < 0.02
    assert 100 < board.counts["instructions of servo_step"] < board.counts["instructions of a sample, at most"] < 10_000
    assert board.counts["bytes of stack of a sample, at most"] < 2048


@pytest.mark.slow
@pytest.mark.parametrize(
    ("board", "name", "real", "torque"), [("m4", "bench8", "float", 0.02), ("m7", "sat4", "double", 0.2)]
)
def test_a_flight_of_two_thousand_steps(board: str, name: str, real: str, torque: float, tmp_path: Path) -> None:
    """What the board logs is replayed here."""
    flown, chosen = load_stand(path(name)), target(board)
    log = tmp_path / "flight.log"
    log.write_text(run(chosen, build(chosen, flight(flown, real, 2000, torque=torque), tmp_path)))
    data, notes = load(log)
    assert notes == []
    assert sum(isinstance(r, Start) for r in records(data)) == 2
    replayed = list(replay(c_machine(flown, real), records(data)))
    outcomes = [o for o in replayed if isinstance(o, Outcome)]
    assert len(replayed) == len(outcomes) == 2002  # two of them refused
    assert all(o.equal for o in outcomes)
    assert sum(o.status < 0 for o in outcomes) == 2
    assert abs(outcomes[-1].after["phi_dot"]).max() > 0.1  # it moved


FLAGS = ("-DSETTLE=100", "-DDUMP=300", "-DLAST=10", "-DARCSEC_MOST=100")
"""A slew with a failed flywheel, and a little momentum to dump."""


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "real"), [("m7", "double"), ("m4", "float"), ("rv64gc", "double"), ("rv32imac", "double")]
)
def test_attitude_loops(name: str, real: str, tmp_path: Path) -> None:
    """They have the bits of the desk, but for rare sums of software double on a Cortex-M: test_board.py."""
    made = attitude_sources(load_stand(path("eye4")), LoopOptions(rate=10.0, momentum=0.01), real)
    printed = []
    for board in ("host", name):
        (tmp_path / board).mkdir()
        chosen = target(board)
        lines = run(chosen, build(chosen, made.files, tmp_path / board, extra=FLAGS), timeout=300).splitlines()
        printed.append([line for line in lines if not line.startswith("#")])  # those count instructions
    of_host, of_board = printed
    assert of_host == of_board
    assert any(line.startswith("hash ") for line in of_host)
    assert of_host[-1] == "failures 0"
