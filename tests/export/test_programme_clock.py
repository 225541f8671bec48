"""The clock of a programme: exact after any number of ticks, and its phases are good phases."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import pytest

from export.programmes import exported, written
from mahovik.core.program.interpret import Interpreter
from toolchain.tools import compile_c, run


def started(real: str, ticks: int, periods: int) -> tuple[Interpreter, dict[str, int]]:
    """Interpreter and a clock at phase 0."""
    interpreter = Interpreter(exported("swaying", "fourier", real).program.program)
    status, found = interpreter.run("programme_start", {"ticks": ticks, "periods": periods})
    assert status == 0
    return interpreter, found["clock"]


@pytest.mark.parametrize("real", ["double", "float"])
@pytest.mark.parametrize(("ticks", "periods"), [(400, 1), (97, 3), (2, 1), (2147483647, 1073741823), (1000003, 7)])
def test_every_phase_is_exact(real: str, ticks: int, periods: int) -> None:
    """n periods / ticks, rounded down: there is nothing that could add up."""
    interpreter, clock = started(real, ticks, periods)
    whole = 1 << {"double": 64, "float": 32}[real]
    for n in range(1, 1200):
        status, found = interpreter.run("programme_advance", {"clock": clock})
        clock = found["clock"]
        assert status == 0
        assert clock["phase"] == whole * n * periods // ticks % whole
        assert clock["laps"] == n * periods // ticks
        phase = interpreter.run("programme_phase", {"clock": clock})[1]["phase"]
        assert 0 <= float(phase) < 1
        below = Fraction(clock["phase"], whole) - Fraction(float(phase))
        assert 0 <= below < Fraction(1, {"double": 1 << 53, "float": 1 << 24}[real])


@pytest.mark.parametrize("real", ["double", "float"])
def test_ten_million_ticks_in_c_do_not_drift(real: str, tmp_path: Path) -> None:
    source = written(exported("swaying", "fourier", real), tmp_path, real)
    (tmp_path / "main.c").write_text("""#include <stdio.h>
#include "shaker2_programme.h"
int main(void)
{
    shaker2_programme_clock clock;
    if (shaker2_programme_start(1000003, 7, &clock) != SHAKER2_OK) { return 1; }
    for (long i = 0; i < 10000000L; ++i) { (void)shaker2_programme_advance(&clock); }
    printf("%llu %d\\n", (unsigned long long)clock.phase, clock.laps);
    return 0;
}
""")
    compile_c("gcc", source, "-O2", tmp_path / "main.c", "-o", tmp_path / "main")
    phase, laps = map(int, run(tmp_path / "main").split())
    whole = 1 << {"double": 64, "float": 32}[real]
    assert phase == whole * 10**7 * 7 // 1000003 % whole
    assert laps == 10**7 * 7 // 1000003


@pytest.mark.parametrize(
    ("ticks", "periods"), [(1, 1), (3, 2), (0, 1), (-5, 1), (10, 0), (10, -1), (2147483647, 2147483647)]
)
def test_what_is_no_clock_is_refused(ticks: int, periods: int) -> None:
    interpreter = Interpreter(exported("swaying", "fourier").program.program)
    assert interpreter.run("programme_start", {"ticks": ticks, "periods": periods})[0] == -5


def test_a_clock_that_start_did_not_make_is_refused() -> None:
    interpreter, good = started("double", 97, 3)
    for wrong in ({"ticks": 0}, {"rest": 97}, {"rest": -1}, {"surplus": 200}, {"surplus": -2}, {"laps": -1}):
        status, found = interpreter.run("programme_advance", {"clock": good | wrong})
        assert status == -5
        assert found["clock"] == good | wrong


def test_laps_stop_at_the_largest_int() -> None:
    interpreter, clock = started("float", 2, 1)
    clock["laps"] = 2147483646
    for _ in range(6):
        clock = interpreter.run("programme_advance", {"clock": clock})[1]["clock"]
    assert clock["laps"] == 2147483647
