"""The control loop on emulated boards: it follows, nothing is refused, and the bits are those of this machine."""

from __future__ import annotations

from pathlib import Path

import pytest
from control_loop import BENCH8, Counts, control_loop, read_counts

from mahovik.core.stand import load
from mahovik.core.toolchain.board import build, run
from mahovik.stands import path
from targets.boards import target

TICKS = 1000


def counted(name: str, real: str, folder: Path) -> Counts:
    """A run on a target."""
    texts = control_loop(load(path("bench8")), BENCH8, real, TICKS)
    folder.mkdir()
    chosen = target(name)
    return read_counts(run(chosen, build(chosen, texts, folder)))


def test_the_loop_reads_counters_that_wrap() -> None:
    """Counters have 16 bits, like timers; read as absolute, one would lose its place at the first wrap."""
    text = control_loop(load(path("bench8")), BENCH8, "double", TICKS)["loop.c"]
    inside = text[text.index("static int tick(") : text.index("static int count_at(")]
    for name in ("accumulate", "phase_of_counts", "speed_of_counts"):
        assert f"bench8_{name}(" in inside
    assert "65530u" in text


@pytest.mark.slow
@pytest.mark.parametrize(("board", "real"), [("m7", "double"), ("m4", "float")])
def test_the_loop_on_a_board(board: str, real: str, tmp_path: Path) -> None:
    here, there = counted("host", real, tmp_path / "host"), counted(board, real, tmp_path / board)
    assert here.hash == there.hash
    assert (here.followed, here.strayed, here.observed) == (there.followed, there.strayed, there.observed)
    assert there.followed < 0.5 * BENCH8.linear[0]
    assert there.strayed < 3 * BENCH8.linear[0]
    assert there.observed < 1e-3  # m/s
    whole = there.ticks["inverse_fast, step of order 2"]
    parts = [n for name, n in there.stages.items() if name not in ("inverse", "step, order 4")]
    assert max(parts) < whole <= sum(parts)
