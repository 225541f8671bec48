"""The C of a programme: the interpreter's bits, strict compilers, its clock, refused headers."""

from __future__ import annotations

import re
from fractions import Fraction
from math import pi
from pathlib import Path

import numpy as np
import pytest

from export.programmes import check_delivered, check_other_headers, exported, self_tested, spin, written
from mahovik.core.program.interpret import Interpreter
from toolchain.quick import quick
from toolchain.tools import run

CASES = [
    ("swaying", "fourier", "double"),
    ("started", "quintic", "float"),
    ("spin", "fourier", "float"),
    ("finite", "quintic", "double"),
]


@pytest.fixture(scope="module", params=quick(2, [pytest.param(case, id="-".join(case)) for case in CASES]))
def source(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The C file of a programme, all that it includes beside it."""
    name, kind, real = request.param
    return written(exported(name, kind, real), tmp_path_factory.mktemp("-".join(request.param)), real)


def test_every_bit_is_the_interpreters(source: Path) -> None:
    lines = self_tested(source, "programme")
    assert lines[0].startswith("mahovik programme shaker2 structure ")
    assert "programme_at PASS cases 8 wrong 0" in lines
    assert "refusals PASS wrong 0" in lines
    assert "clock PASS wrong 0" in lines
    parts = re.findall(r"shaker2_programme_(runup|rundown)_at\(", source.with_suffix(".h").read_text())
    assert [f"programme_{part}_at PASS cases 8 wrong 0" in lines for part in parts] == [True] * len(parts)


def test_clang_32_bits_and_bare_objects(source: Path, tmp_path: Path) -> None:
    check_delivered(source, tmp_path, set(), "T")


def test_headers_of_another_stand_or_element_type_are_refused(tmp_path: Path) -> None:
    check_other_headers(written(exported("spin"), tmp_path))


def test_the_self_test_finds_one_wrong_digit(tmp_path: Path) -> None:
    """The wrong digit is in a node next to golden phases, since the loop goes over all nodes."""
    source = written(exported("swaying", real="float"), tmp_path, "float")
    text = source.read_text()
    at = list(re.finditer(r"^        \{\n +\.phi = \{ +(-?\d+\.\d+)", text, re.MULTILINE))[20]
    number = at[1]
    source.write_text(text[: at.start(1)] + number[:-1] + ("1" if number[-1] != "1" else "2") + text[at.end(1) :])
    lines = self_tested(source, "programme")
    assert "clock FAIL wrong 1" in lines
    assert lines[-1] == "failures 1"


def test_the_page_hands_over_from_the_run_up(tmp_path: Path) -> None:
    """The page's code, ticked: full speed at the first tick after the lap, a step of the run-up before it."""
    source = written(exported("started"), tmp_path)
    code = "".join(re.findall(r"```c\n(.*?)```", (tmp_path / "shaker2_programme.md").read_text(), re.DOTALL))
    ticking = """
#include <stdio.h>
int main(void)
{
    shaker2_real phi[SHAKER2_N], phi_dot[SHAKER2_N], phi_ddot[SHAKER2_N];
    int i;
    if (begin() < 0 || begin_from_rest() < 0) { return 1; }
    for (i = 0; i <= 4001; ++i) {
        if (tick_from_rest(phi, phi_dot, phi_ddot) < 0) { return 2; }
        if (i == 0 || i >= 3999) { printf("%.17g %.17g\\n", phi[0], phi_dot[0]); }
    }
    return 0;
}
"""
    (tmp_path / "main.c").write_text(code + ticking)
    flags = ("-std=c99", "-O1", "-Wall", "-Wextra", "-Werror", "-ffp-contract=off")
    run("gcc", *flags, tmp_path / "main.c", source, "-o", tmp_path / "ticking")
    phi, phi_dot = zip(*(map(float, line.split()) for line in run(tmp_path / "ticking").splitlines()), strict=True)
    full = 2 * pi / spin().span
    assert phi_dot[0] == pytest.approx(0.0, abs=1e-9)
    assert 0.999 * full < phi_dot[1] < full
    assert phi_dot[2:] == pytest.approx((full, full), rel=1e-12)
    assert phi[2] == pytest.approx(spin().at(np.zeros(1)).phi[0, 0], abs=1e-9)
    assert (phi[2] - phi[1]) % (2 * pi) == pytest.approx(full * 0.2 / 4000, rel=1e-3)


def started(real: str, ticks: int, periods: int) -> tuple[Interpreter, dict[str, int]]:
    """Interpreter and a clock at phase 0."""
    interpreter = Interpreter(exported("swaying", "fourier", real).program.program)
    status, outputs = interpreter.run("programme_start", {"ticks": ticks, "periods": periods})
    assert status == 0
    return interpreter, outputs["clock"]


@pytest.mark.parametrize("real", ["double", "float"])
@pytest.mark.parametrize(("ticks", "periods"), [(97, 3), (2147483647, 1073741823)])
def test_every_phase_is_exact(real: str, ticks: int, periods: int) -> None:
    """n periods / ticks, rounded down: there is nothing that could add up."""
    interpreter, clock = started(real, ticks, periods)
    whole = 1 << {"double": 64, "float": 32}[real]
    for n in range(1, 400):
        status, outputs = interpreter.run("programme_advance", {"clock": clock})
        clock = outputs["clock"]
        assert status == 0
        assert clock["phase"] == whole * n * periods // ticks % whole
        assert clock["laps"] == n * periods // ticks
        phase = interpreter.run("programme_phase", {"clock": clock})[1]["phase"]
        assert 0 <= float(phase) < 1
        below = Fraction(clock["phase"], whole) - Fraction(float(phase))
        assert 0 <= below < Fraction(1, {"double": 1 << 53, "float": 1 << 24}[real])


@pytest.mark.parametrize(
    ("ticks", "periods"), [(1, 1), (3, 2), (0, 1), (-5, 1), (10, 0), (10, -1), (2147483647, 2147483647)]
)
def test_what_is_no_clock_is_refused(ticks: int, periods: int) -> None:
    interpreter = Interpreter(exported("swaying", "fourier").program.program)
    assert interpreter.run("programme_start", {"ticks": ticks, "periods": periods})[0] == -5


def test_a_clock_that_start_did_not_make_is_refused() -> None:
    """Laps stop at the largest int."""
    interpreter, good = started("double", 97, 3)
    for wrong in ({"ticks": 0}, {"rest": 97}, {"rest": -1}, {"surplus": 200}, {"surplus": -2}, {"laps": -1}):
        status, result = interpreter.run("programme_advance", {"clock": good | wrong})
        assert status == -5
        assert result["clock"] == good | wrong
    clock = started("float", 2, 1)[1] | {"laps": 2147483646}
    for _ in range(6):
        clock = started("float", 2, 1)[0].run("programme_advance", {"clock": clock})[1]["clock"]
    assert clock["laps"] == 2147483647
