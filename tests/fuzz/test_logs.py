"""Logs: of a flight, binary or as text of a console, and of a self-test. A byte of them may be anything."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from emit.stands import stand as known_stand
from fuzz.mangle import spoiled_bytes
from fuzz.reading import READERS, fuzzed, read_or_refuse
from mahovik.proof.verify.selftest import judge_log
from mahovik.use.simulate.replay import Damage, Machine, Start, c_machine, check_stand, load, records, replay
from simulate.flights import Recorder

NAME, REAL = "demo3", "double"
STAND = known_stand(NAME)

pytestmark = READERS


@pytest.fixture(scope="module")
def log(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    recorder = Recorder(NAME, REAL, tmp_path_factory.mktemp("flight"))
    recorder.fly(16)
    return recorder.log


@pytest.fixture(scope="module")
def machine() -> Machine:
    return c_machine(STAND, REAL)


def read(data: bytes, file: Path, machine: Machine) -> None:
    """Read a log as the command does: all records, then the replay of those of this stand."""
    file.write_bytes(data)
    log, _ = load(file)
    for start in [r for r in records(log) if isinstance(r, Start)]:
        check_stand(STAND, start, "demo3.toml")
        if start.real != REAL:
            return
    for step in replay(machine, records(log)):
        if isinstance(step, Damage):
            assert step.message


@fuzzed(120)
@given(data=st.data())
def test_a_spoiled_flight_log(
    data: st.DataObject, log: bytes, machine: Machine, tmp_path_factory: pytest.TempPathFactory
) -> None:
    text = b"\n".join(b"@" + log[i : i + 32].hex().encode() for i in range(0, len(log), 32))
    spoiled = data.draw(spoiled_bytes([log, text]))
    read_or_refuse(lambda: read(spoiled, tmp_path_factory.getbasetemp() / "flight.log", machine))


@pytest.fixture(scope="module")
def console() -> bytes:
    return _selftest_log().encode()


def _selftest_log() -> str:
    """Output of a self-test without a sweep: judging it needs no compiler."""
    from mahovik.core.stand.structure import identities

    hashes = identities(STAND)
    head = f"mahovik selftest {STAND.name} structure {hashes.structure} physics {hashes.physics} real double"
    lines = [
        head,
        "generator mahovik 0.1.0",
        "forward PASS cases 9 worst 0 ulp",
        "step FAIL cases 9 wrong 1 worst more than 9 ulp",
    ]
    return "\n".join([*lines, "sweep 0", "forward 0123abcd", "step 00000000", "failures 1", ""])


@fuzzed(150)
@given(data=st.data())
def test_the_log_of_a_selftest(data: st.DataObject, console: bytes) -> None:
    spoiled = data.draw(spoiled_bytes([console, console + console]))
    read_or_refuse(lambda: judge_log(spoiled.decode("utf-8", "replace"), "log"))
