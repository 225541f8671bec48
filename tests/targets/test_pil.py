"""Processor in the loop: servos drive a stand that has other numbers, on emulated boards bit for bit as on the host."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from export.programmes import stand
from export.servos import exported
from mahovik.core.stand.model import Stand
from mahovik.core.toolchain.board import build, run
from targets.boards import target
from targets.pil import Run, processor_in_the_loop, read_run

BOARDS = [("m4", "float"), ("rv64gc", "double"), ("m55", "double")]


def heavier(given: Stand, share: float = 0.01) -> Stand:
    """The stand with flywheels of more mass."""
    wheels = tuple(replace(s, mass=s.mass * (1 + share * (-1) ** i)) for i, s in enumerate(given.flywheels))
    return replace(given, flywheels=wheels)


def ran(board: str, name: str, real: str, samples: int, folder: Path) -> Run:
    """Output of a board for a run."""
    chosen = target(board)
    texts = processor_in_the_loop(stand(), heavier(stand()), exported(name, real), samples)
    place = folder / board
    place.mkdir()
    return read_run(run(chosen, build(chosen, texts, place, "-O0" if board == "host" else None), timeout=300))


@pytest.mark.slow
def test_a_short_run_on_the_cortex_m7(tmp_path: Path) -> None:
    host, board = (ran(name, "trimmed", "double", 200, tmp_path) for name in ("host", "m7"))
    assert len(host.torques) == 200
    assert len(set(host.torques)) == 200  # the loop is alive
    assert board.torques == host.torques
    assert (board.followed, board.limited) == (host.followed, host.limited)
    assert 0 < host.followed < 0.02
    assert 100 < board.counts["instructions of servo_step"] < board.counts["instructions of a sample, at most"] < 10_000
    assert board.counts["bytes of stack of a sample, at most"] < 2048


@pytest.mark.slow
@pytest.mark.parametrize(("board", "real"), BOARDS)
def test_other_boards(board: str, real: str, tmp_path: Path) -> None:
    host, found = (ran(name, "trimmed", real, 400, tmp_path) for name in ("host", board))
    assert found.torques == host.torques
    assert found.limited == host.limited
