"""The C of a programme: the interpreter's bits, strict compilers, and a header of another stand is refused."""

from __future__ import annotations

import re
from math import pi
from pathlib import Path

import numpy as np
import pytest

from export.programmes import exported, self_tested, spin, written
from mahovik.core.emit.names import Names
from mahovik.core.lower.programme.form import RESERVED
from mahovik.core.program.cost import cost
from toolchain.tools import compile_c, compile_elsewhere, require, require_32_bit, run, symbols_of

CASES = [
    ("spin", "quintic", "double"),
    ("spin", "fourier", "float"),
    ("swaying", "quintic", "float"),
    ("swaying", "fourier", "double"),
    ("started", "quintic", "float"),
    ("finite", "quintic", "double"),
]


@pytest.fixture(scope="module", params=CASES, ids="-".join)
def source(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The C file of a programme, all that it includes beside it."""
    name, kind, real = request.param
    return written(exported(name, kind, real), tmp_path_factory.mktemp("-".join(request.param)), real)


def test_every_bit_is_the_interpreters(source: Path) -> None:
    lines = self_tested(source)
    assert lines[0].startswith("mahovik programme shaker2 structure ")
    assert "programme_at PASS cases 8 wrong 0" in lines
    assert "refusals PASS wrong 0" in lines
    assert "clock PASS wrong 0" in lines
    parts = re.findall(r"shaker2_programme_(runup|rundown)_at\(", source.with_suffix(".h").read_text())
    assert [f"programme_{part}_at PASS cases 8 wrong 0" in lines for part in parts] == [True] * len(parts)


def test_clang_32_bits_and_bare_objects(source: Path, tmp_path: Path) -> None:
    compile_elsewhere(source)
    listed = symbols_of(source, tmp_path)
    assert {symbol for kind, symbol in listed if kind == "U"} <= {"memcpy", "memset"}
    assert {kind for kind, _ in listed} <= set("UTtRr")  # no data that could change
    header = source.with_suffix(".h").read_text()
    assert all(re.search(rf"\b{symbol}\(", header) for kind, symbol in listed if kind == "T")


def test_other_compilers_have_the_same_bits(tmp_path: Path) -> None:
    source = written(exported("swaying", "fourier"), tmp_path)
    assert self_tested(source, require("clang", "clang"), "-O2")[-1] == "failures 0"
    require_32_bit()
    assert self_tested(source, "gcc", "-m32", "-msse2", "-mfpmath=sse", "-O0")[-1] == "failures 0"


def test_header_in_cpp(tmp_path: Path) -> None:
    written(exported("started", real="float"), tmp_path, "float")
    user = tmp_path / "user.cpp"
    user.write_text('#include "shaker2_programme.h"\n' * 2)
    flags = ("-std=c++17", "-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Werror", f"-I{tmp_path}")
    run(require("g++", "g++"), *flags, "-fsyntax-only", user)


@pytest.mark.parametrize("macro", ["STRUCTURE", "PHYSICS"])
def test_a_header_of_another_stand_is_refused(macro: str, tmp_path: Path) -> None:
    source = written(exported("spin"), tmp_path)
    header = tmp_path / "shaker2.h"
    header.write_text(re.sub(rf"({macro} +0x)[0-9a-f]{{8}}", r"\g<1>00000001", header.read_text()))
    with pytest.raises(AssertionError, match="are of different stands"):
        compile_c(require("gcc", "gcc"), source, "-fsyntax-only")


def test_a_header_of_another_element_type_is_refused(tmp_path: Path) -> None:
    source = written(exported("spin"), tmp_path, "float")
    with pytest.raises(AssertionError, match="negative"):
        run(require("gcc", "gcc"), "-std=c99", "-fsyntax-only", source)


def test_the_self_test_finds_one_wrong_digit(tmp_path: Path) -> None:
    """The wrong digit is in a node next to golden phases, since the loop goes over all nodes."""
    source = written(exported("swaying", real="float"), tmp_path, "float")
    text = source.read_text()
    at = list(re.finditer(r"^        \{\n +\.phi = \{ +(-?\d+\.\d+)", text, re.MULTILINE))[20]
    number = at[1]
    source.write_text(text[: at.start(1)] + number[:-1] + ("1" if number[-1] != "1" else "2") + text[at.end(1) :])
    lines = self_tested(source)
    assert "clock FAIL wrong 1" in lines
    assert lines[-1] == "failures 1"


def test_float_has_no_double(tmp_path: Path) -> None:
    source = written(exported("started", real="float"), tmp_path, "float")
    text = re.sub(r"/\*.*?\*/", "", source.read_text(), flags=re.DOTALL)
    assert "double" not in text
    assert re.findall(r"(?<![\w.])\d+\.\d+(?:e[-+]?\d+)?(?![\dFe])", text) == []


def test_the_page_has_an_example_that_compiles(tmp_path: Path) -> None:
    for name in ("spin", "swaying"):
        written(exported(name), tmp_path)
        page = (tmp_path / "shaker2_programme.md").read_text()
        (code,) = re.findall(r"```c\n(.*?)```", page, re.DOTALL)
        (tmp_path / "main.c").write_text(code)
        run("gcc", "-std=c99", "-Wall", "-Wextra", "-Werror", "-c", tmp_path / "main.c", "-o", tmp_path / "main.o")
        for file in exported(name).files:
            assert file in page or file.endswith(".md")


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


def test_names_of_the_header_are_no_flywheels() -> None:
    """The names that the stand's header forbids for flywheels are all names in capitals of a programme's header."""
    for name, kind in (("started", "quintic"), ("spin", "fourier"), ("finite", "quintic")):
        header = exported(name, kind).files["shaker2_programme.h"]
        found = re.findall(r"^(?:#define|enum \{) SHAKER2_(\w+)", header, re.MULTILINE)
        assert found and set(found) <= RESERVED
    assert Names("shaker2").enumerators(["programme_nodes", "left"], RESERVED) == [
        "SHAKER2_PROGRAMME_NODES_0",
        "SHAKER2_LEFT",
    ]


def test_nothing_of_this_machine_is_in_it() -> None:
    for text in exported("started", real="float").files.values():
        assert not re.search(r"/(home|work|tmp|usr|root)/|20\d\d-\d\d", text)
        text.encode("ascii")


def test_errors_and_cost_are_told() -> None:
    made = exported("spin")
    source, header = made.files["shaker2_programme.c"], made.files["shaker2_programme.h"]
    words = " ".join(source.replace("\n *", " ").split())
    assert all(" ".join(line.split()) in words for line in made.lines if not line.startswith("limit"))
    assert (
        f"At most {cost(made.program.courses[0].inner, made.program.program.functions).total} operations on reals"
        in header
    )
    assert f"{spin().span}  " in header
