"""The self-test: good C passes under any compiler, and each planted fault is found and named."""

import re
import subprocess
from pathlib import Path

import pytest

from emit.selftests import failed, generate_with_selftest, in_function, replaced, run_selftest
from emit.stands import write
from mahovik.core.emit.literal import hex_literal
from mahovik.core.lower.golden import Player, golden
from mahovik.core.program.types import DOUBLE, FLOAT, Precision
from mahovik.proof.verify.selftest import RIGHT, problems, read_log
from toolchain.quick import quick
from toolchain.tools import SSE, compile_c, require, require_32_bit, run

TRIED = ("demo3", "bare0", "everything6", "bench8", "everything0", "drawn12")


@pytest.mark.parametrize("real", ["double", "float"])
@pytest.mark.parametrize("name", quick(2, TRIED))
def test_good_c_has_the_interpreters_bits(name: str, real: str, tmp_path: Path) -> None:
    generated, files = generate_with_selftest(name, real)
    status, printed = run_selftest(files, name, tmp_path)
    (log,) = read_log(printed, name)
    assert (status, problems(log)) == (0, [])
    assert list(log.functions) == [f.name for f in generated.program.functions if f.public]
    assert set(log.functions.values()) == {RIGHT}


@pytest.mark.slow
@pytest.mark.parametrize("real", ["float", "double"])
@pytest.mark.parametrize("name", ["demo3", "everything6", "held3"])
def test_compilers_optimisations_and_32_bits_print_the_same(name: str, real: str, tmp_path: Path) -> None:
    """Golden vectors and hashes of all numbers of a sweep are equal."""
    require("clang", "clang")
    require_32_bit()
    _, files = generate_with_selftest(name, real)
    outputs = set()
    for compiler, levels in (("gcc", ("-O0", "-O2", "-O3", "-Os")), ("clang", ("-O0", "-O2", "-O3"))):
        for level in levels:
            (tmp_path / f"{compiler}{level}").mkdir()
            outputs.add(run_selftest(files, name, tmp_path / f"{compiler}{level}", compiler, level))
    (tmp_path / "m32").mkdir()
    outputs.add(run_selftest(files, name, tmp_path / "m32", "gcc", "-O1", *SSE))
    assert len(outputs) == 1
    assert outputs.pop()[0] == 0


@pytest.mark.parametrize(("name", "real"), quick(1, [("demo3", "double"), ("bare5", "float")]))
def test_the_sweep_is_that_of_the_interpreter(name: str, real: str, tmp_path: Path) -> None:
    # the C draws its own states: integers, scaling and quaternions must be those of Python, refused states included
    generated, files = generate_with_selftest(name, real)
    states = 20
    _, printed = run_selftest(files, name, tmp_path, "gcc", "-O1", f"-D{name.upper()}_SELFTEST_SWEEP={states}ul")
    (log,) = read_log(printed, name)
    expected = Player(generated.program, generated.values).sweep(states)
    assert log.sweep == states
    assert log.hashes == {f: f"{value:08x}" for f, value in expected.items()}


def test_an_own_main_takes_what_is_printed(tmp_path: Path) -> None:
    _, files = generate_with_selftest("demo3")
    main = """#include "verification/demo3_selftest.c"
#include <stdio.h>
static int lines;
static void count(const char *text)
{
    while (*text != '\\0') { lines += *text == '\\n' ? 1 : 0; ++text; }
}
int main(void)
{
    const int failures = demo3_selftest(count, 3ul);
    printf("%d %d\\n", failures, lines);
    return 0;
}
"""
    write({**files, "demo3_own.c": main}, tmp_path)
    compile_c("gcc", tmp_path / "demo3_own.c", tmp_path / "demo3.c", "-o", tmp_path / "own")
    functions = sum(f.public for f in generate_with_selftest("demo3")[0].program.functions)
    assert run(tmp_path / "own") == f"0 {4 + 2 * functions}\n"


# ---- planted faults ----


def test_a_digit_of_the_table_is_found(tmp_path: Path) -> None:
    """The last digit of 1/sqrt(Theta_ff) is changed."""
    readers, unchanged = {"inverse", "inverse_fast"}, {"coupled", "forward", "quaternion", "torque", "momentum"}
    _, files = generate_with_selftest("bench8")
    row = files["bench8.c"].split("bench8_default =")[1].split("/* w2 */")[0]
    number = re.findall(r"\d+\.\d{6,}", row)[-1]
    worse = row.replace(f" {number},", f" {number[:-1]}{'7' if number[-1] != '7' else '3'},")  # its last digit
    names, log = failed({**files, "bench8.c": replaced(files["bench8.c"], row, worse)}, "bench8", tmp_path)
    assert readers <= names
    assert not names & unchanged
    assert all(re.search(r"worst .*[1-9]", log.functions[name]) for name in readers)


@pytest.mark.parametrize(
    ("function", "unchanged"),
    [
        ("torque", {"forward", "coupled", "mounts", "momentum"}),
        ("inverse_fast", {"inverse", "forward"}),
    ],
)
def test_a_sign_in_a_function_is_found_and_named(function: str, unchanged: set[str], tmp_path: Path) -> None:
    _, files = generate_with_selftest("bench8")
    source = in_function(files["bench8.c"], "bench8", function, r"\n( +[^/\n]*?[\w\])]) \+ (\w)", r"\n\1 - \2")
    names, _ = failed({**files, "bench8.c": source}, "bench8", tmp_path)
    assert function in names
    assert not names & unchanged


def test_a_lost_check_is_found(tmp_path: Path) -> None:
    # the quaternion of angles that are out of range: another status, and outputs that should not be written
    _, files = generate_with_selftest("bench8")
    source = in_function(
        files["bench8.c"], "bench8", "quaternion", r"if \(status != BENCH8_OK\) \{", "if (status == BENCH8_OK + 77) {"
    )
    names, log = failed({**files, "bench8.c": source}, "bench8", tmp_path)
    assert names == {"quaternion", "state_from_coordinates"}  # which calls it
    assert log.functions["quaternion"].startswith("FAIL cases 5 wrong 2 (status, trials)")


def test_an_output_written_before_a_refusal_is_found(tmp_path: Path) -> None:
    _, files = generate_with_selftest("bench8")
    source = in_function(files["bench8.c"], "bench8", "torque", r"(BAD_ARGUMENT; \}\n)", r"\1    tau[0] = 0.0;\n")
    names, log = failed({**files, "bench8.c": source}, "bench8", tmp_path)
    assert names == {"torque"}
    assert problems(log) == [f"expected {RIGHT}: torque FAIL cases 5 wrong 2 (trials, written though refused)"]


@pytest.mark.parametrize(("real", "precision", "ulp"), [("double", DOUBLE, 3), ("float", FLOAT, 1)])
def test_the_distance_is_in_units_in_the_last_place(real: str, precision: Precision, ulp: int, tmp_path: Path) -> None:
    generated, files = generate_with_selftest("demo3", real)
    text = files["verification/demo3_selftest.c"]
    answer = golden(generated.program, generated.values).answers["forward"][0].listed[0]
    other = answer
    for _ in range(ulp):
        other = precision.scalar(other) + precision.scalar(0)
        bits = int(other.view(precision.word)) + 1
        other = precision.word(bits).view(precision.scalar)
    tampered = replaced(
        text, f"    {hex_literal(float(answer), precision)},", f"    {hex_literal(float(other), precision)},"
    )
    names, log = failed({**files, "verification/demo3_selftest.c": tampered}, "demo3", tmp_path)
    assert names == {"forward"}
    assert log.functions["forward"] == f"FAIL cases 5 wrong 1 (numbers) worst {ulp} ulp"


@pytest.mark.parametrize(
    ("function", "old", "new"),
    [
        ("inverse", r"options->damping > 0\.0", "options->damping > 1.0"),
        ("allocate", r"weight\[s\]", "weight[0]"),
        ("step", r"tau == NULL \|\| ", ""),
        ("check_inertia", r"if \(!\(d2 >= BENCH8_SMALLEST\)\)", "if (d2 == 77.0)"),
        ("step_driven", r"if \(!\(dt > 0\.0\)\)", "if (dt < -77.0)"),
    ],
)
def test_a_fault_in_a_rare_branch_is_found(function: str, old: str, new: str, tmp_path: Path) -> None:
    """The faults are in branches that no golden case enters: damping, weights, a null pointer, an impossible body."""
    _, files = generate_with_selftest("bench8")
    text = re.sub(r"(?<=^BENCH8_CODE )static (?=\w+ bench8_\w+\()", "", files["bench8.c"], flags=re.MULTILINE)
    source = in_function(text, "bench8", function, old, new)
    status, printed = run_selftest({**files, "bench8.c": source}, "bench8", tmp_path, "gcc", "-O0", "-w")
    assert status != 0
    assert status < 0 or "trials" in printed or "sweep)" in printed


# ---- what is in it ----


@pytest.mark.parametrize("name", quick(1, ["bench8", "sat4"]))
def test_every_status_occurs_and_nine_tenths_of_the_branches_are_taken(name: str, tmp_path: Path) -> None:
    generated, files = generate_with_selftest(name)
    known = {value.status for value in golden(generated.program, generated.values).trials}
    assert all(any(value & bit for value in known if value > 0) for bit in (1, 2, 4, 8, 16, 32, 64))
    assert known >= {-1, -2, -3, -4, -5}
    status, _ = run_selftest(files, name, tmp_path, "gcc", "-O0", "--coverage")
    assert status == 0
    counted = subprocess.run(
        ["gcov", "-b", "-c", *tmp_path.glob(f"*-{name}.gcda")], cwd=tmp_path, capture_output=True, text=True, check=True
    )
    taken = re.findall(rf"^File '.*\b{name}\.c'\n(?:.*\n)*?Taken at least once:([\d.]+)%", counted.stdout, re.MULTILINE)
    assert float(taken[0]) >= 90
