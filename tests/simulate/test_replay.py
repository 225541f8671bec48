"""A flight log is replayed bit for bit, and whatever is wrong with it is named."""

from __future__ import annotations

import random
from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from emit.stands import stand as known_stand
from mahovik.core.emit.log_format import MAGIC
from mahovik.core.emit.recorder import recorder_files
from mahovik.errors import CheckError, UsageError
from mahovik.use.simulate.replay import (
    Damage,
    Machine,
    Outcome,
    Start,
    c_machine,
    check_stand,
    explain,
    load,
    records,
    replay,
)
from simulate.flights import Recorder

CASES = [
    ("demo3", "float"),
    ("held3", "double"),
    *(
        pytest.param(case, marks=pytest.mark.slow)
        for case in (("everything6", "double"), ("bench8", "double"), ("everything0", "float"))
    ),
]
STEPS = 20


@pytest.fixture(scope="module", params=CASES, ids="-".join)
def flown(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Recorder:
    name, real = request.param
    recorder = Recorder(name, real, tmp_path_factory.mktemp(name))
    recorder.fly(STEPS)
    return recorder


@pytest.fixture(scope="module")
def bench8(tmp_path_factory: pytest.TempPathFactory) -> Recorder:
    recorder = Recorder("bench8", "double", tmp_path_factory.mktemp("bench8"))
    recorder.fly(STEPS)
    return recorder


@cache
def machine_of(name: str, real: str) -> Machine:
    """Freshly generated C, compiled once."""
    return c_machine(known_stand(name), real)


def steps_of(recorder: Recorder, data: bytes | None = None) -> list[Outcome | Damage]:
    """Findings of a replay by that C."""
    machine = machine_of(recorder.name, recorder.real)
    return list(replay(machine, records(recorder.log if data is None else data)))


def outcomes(steps: list[Outcome | Damage]) -> list[Outcome]:
    """Findings of a replay, none of them damage."""
    replayed = [o for o in steps if isinstance(o, Outcome)]
    assert len(replayed) == len(steps)
    return replayed


# ---- a log as it was written ----


def test_every_step_has_the_bits_of_the_flight(flown: Recorder) -> None:
    """Through locks, wrenches, a stream, written states, changing steps, restarts and refusals; to the very end."""
    flown.new("recorder")
    statuses = flown.fly(STEPS)
    steps = outcomes(steps_of(flown))
    assert all(o.equal for o in steps)
    assert [o.step.count for o in steps] == list(range(STEPS))
    assert [o.status for o in steps] == statuses
    assert -5 in statuses  # an order that is none
    assert steps[-1].after["position"].tolist() == list(flown.x.position)
    assert steps[-1].after["V"].tolist() == list(flown.x.V)
    assert np.any(steps[-1].after["V"])


def test_a_step_is_one_call_of_the_stated_size(flown: Recorder) -> None:
    flown.new("recorder")
    flown.call("start")
    starts = len(flown.calls)
    text = "\n".join(recorder_files(flown.stand, flown.generated).values())
    longest = int(text.split("_RECORD_BYTES ")[1].split()[0])
    shortest = int(text.split("most have ")[1].split()[0])
    flown.fly(STEPS, every=10**9)
    sizes = [len(c) for c in flown.calls[2 * starts :]]
    assert len(sizes) == STEPS
    assert min(sizes) >= shortest
    assert max(sizes) <= longest


def test_a_log_can_be_replayed_from_any_start(bench8: Recorder) -> None:
    """Content of a ring buffer: the first records are overwritten, up to the middle of one."""
    bench8.new("recorder")
    bench8.fly(STEPS, every=7)
    second = bench8.log.index(MAGIC, 1)
    steps = steps_of(bench8, bench8.log[second - 30 :])
    assert isinstance(steps[0], Damage) and "30 bytes before the first start" in steps[0].message
    assert [o.step.count for o in outcomes(steps[1:])] == list(range(7, STEPS))
    assert all(o.equal for o in outcomes(steps[1:]))


def test_other_c_is_found_at_its_first_step(tmp_path: Path) -> None:
    """The C that flew had one constant in another bit."""
    flew = Recorder("bench8", "double", tmp_path, edit=("half = 0.5 * h", "half = 0.5000000000000001 * h"))
    flew.fly(6)
    (outcome,) = outcomes(steps_of(flew))
    assert not outcome.equal and "hash" in outcome.difference


def test_any_flipped_bit_is_found(bench8: Recorder) -> None:
    bench8.new("recorder")
    bench8.fly(6)
    whole, rng = bench8.log, random.Random(5)
    for _ in range(100):
        place = rng.randrange(len(whole))
        data = bytearray(whole)
        data[place] ^= 1 << rng.randrange(8)
        steps = steps_of(bench8, bytes(data))
        good = [o for o in steps if isinstance(o, Outcome)]
        assert len(good) < len(steps) or place < len(MAGIC)
        assert all(o.equal for o in good) and len(good) < 6


Spoil = Callable[[list[bytes]], bytes]
DAMAGES: list[tuple[Spoil, str, int]] = [
    (lambda calls: b"".join(calls[:-4] + calls[-3:]), "step 2 missing", 2),
    (lambda calls: b"".join(calls[:-4] + calls[-1:]), "steps 2 to 4 missing", 2),
    (lambda calls: b"".join(calls)[:-9], "ends inside the record of step 5", 5),
    (lambda calls: b"".join(calls + calls[-6:]), "comes where step 6 was expected", 6),
    (lambda calls: MAGIC + b"\t" + b"".join(calls)[len(MAGIC) + 1 :], "format 9, this mahovik reads 3", 0),
]
"""What happens to the pieces of a log of six steps, the words about it, and the steps that are replayed."""


@pytest.mark.parametrize(("spoil", "words", "steps"), DAMAGES)
def test_damage_is_named_and_what_is_before_it_is_replayed(
    bench8: Recorder, spoil: Spoil, words: str, steps: int
) -> None:
    bench8.new("recorder")
    bench8.fly(6, every=10**9)
    replayed = steps_of(bench8, spoil(bench8.calls))
    assert any(isinstance(o, Damage) and words in o.message for o in replayed)
    good = [o for o in replayed if isinstance(o, Outcome)]
    assert [o.step.count for o in good] == list(range(steps)) and all(o.equal for o in good)


def load_bytes(folder: Path, data: bytes) -> tuple[bytes, list[str]]:
    path = folder / "flight.log"
    path.write_bytes(data)
    return load(path)


def test_lines_of_a_console_are_the_log_and_a_spoiled_one_is_named(bench8: Recorder, tmp_path: Path) -> None:
    text = b"boot 12\r\n" + b"".join(b"@" + c.hex().encode() + b"\r\nnoise 7f\r\n" for c in bench8.calls)
    assert load_bytes(tmp_path, text) == (bench8.log, [])
    lines = [b"@" + c.hex().encode() for c in bench8.calls]
    lines[-2] = lines[-2][:-1]
    (note,) = load_bytes(tmp_path, b"\n".join(lines))[1]
    assert f"line {len(lines) - 1}" in note


def swapped(data: bytes, width: int) -> bytes:
    data += bytes(-len(data) % 8)
    return b"".join(data[i : i + width][::-1] for i in range(0, len(data), width))


@pytest.mark.parametrize(
    ("spoil", "words"),
    [
        (lambda data: swapped(data, 2), "swapped in words of 2"),
        (lambda data: swapped(data, 8), "swapped in words of 8"),
        (lambda data: data.replace(b"\r\n", b"\n"), "moved as text"),
        (lambda data: bytes(b & 127 for b in data), "eighth bit"),
        (lambda data: b"", "is empty"),
        (lambda data: data[1:8], "no flight log"),
        (lambda data: b"@894d4\n@535\n", "no log in its @ lines, 2 damaged: line 1: expected an even number of hex"),
    ],
)
def test_what_is_no_log_is_refused(
    bench8: Recorder, tmp_path: Path, spoil: Callable[[bytes], bytes], words: str
) -> None:
    with pytest.raises(UsageError, match=words):
        load_bytes(tmp_path, spoil(bench8.log))
    with pytest.raises(UsageError, match="cannot be read"):
        load(tmp_path / "none.log")


def test_a_log_of_another_stand_table_or_text_is_refused(bench8: Recorder) -> None:
    start = next(r for r in records(bench8.log) if isinstance(r, Start))
    check_stand(bench8.stand, start, "bench8.toml")
    with pytest.raises(CheckError, match='stand "demo3", but the log is from "bench8"'):
        check_stand(known_stand("demo3"), start, "demo3.toml")
    with pytest.raises(CheckError, match=r"physics .* but the log is from 00000000"):
        check_stand(bench8.stand, Start(**{**vars(start), "physics": "00000000"}), "bench8.toml")
    machine = machine_of("bench8", "double")
    with pytest.raises(CheckError, match="against=DIR"):  # C of another mahovik: other constants
        list(replay(machine, [Start(**{**vars(start), "table_hash": start.table_hash ^ 1})]))
    assert "-ffp-contract=off" in explain(machine, bench8.stand, start)
    assert "against=DIR" in explain(machine, bench8.stand, Start(**{**vars(start), "source": start.source ^ 1}))


def test_null_pointers_are_refused_without_a_record(bench8: Recorder) -> None:
    bench8.new("recorder")
    null = bench8.ffi.NULL
    assert bench8.call("step", null, [0] * 8, 1e-3, 4, null) == bench8.call("step_driven", null, 1e-3, 4, null) == -5
    assert bench8.library.bench8_recorder_start(bench8.recorder, null, bench8.x) == -5
    assert bench8.log == b""


def test_a_write_that_fails_is_counted_and_the_flight_goes_on(bench8: Recorder) -> None:
    """The gap is named, and the log can be replayed again from the next start."""
    bench8.new("recorder")
    bench8.fly(3, every=10**9)
    assert bench8.recorder.lost == 0
    bench8.full = True
    assert bench8.fly(2, every=10**9)[1] == 0
    bench8.full = False
    assert bench8.recorder.lost >= 2
    assert bench8.recorder.count == 5
    bench8.call("step", [0.0] * 8, [0] * 8, 1e-3, 4, bench8.ffi.NULL)
    assert bench8.call("start") == 0
    bench8.call("step", [0.0] * 8, [0] * 8, 1e-3, 4, bench8.ffi.NULL)
    replayed = steps_of(bench8)
    gap = [step for step in replayed if isinstance(step, Damage)]
    assert len(gap) == 1
    assert "missing" in gap[0].message
    steps = [step for step in replayed if isinstance(step, Outcome)]
    assert [step.step.count for step in steps] == [0, 1, 2, 6]
    assert all(step.equal for step in steps)


def test_a_table_that_is_not_the_default_is_in_the_log(flown: Recorder) -> None:
    flown.new("recorder")
    flown.table.mass *= 1.25
    flown.table.mass_inverse /= 1.25
    flown.fly(STEPS)
    start = next(r for r in records(flown.log) if isinstance(r, Start))
    assert start.table
    steps = steps_of(flown)
    assert len(steps) == STEPS
    assert all(isinstance(o, Outcome) and o.equal and o.table is not None for o in steps)
    flown.new("recorder")
    flown.fly(STEPS)
