"""The self-test: good C passes under any compiler, and each planted fault is found and named."""

import math
import os
import re
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from emit.selftests import failed, generate_with_selftest, in_function, replaced, run_selftest
from emit.stands import NAMES, stand, write
from mahovik.core.emit.delivery import selftest_files
from mahovik.core.emit.generate import generate_all
from mahovik.core.emit.literal import hex_literal
from mahovik.core.lower.golden import CASES, FAR, LISTED, golden, sweep_hashes
from mahovik.core.program.types import DOUBLE, FLOAT, Precision
from mahovik.core.toolchain.branches import measure_branches
from mahovik.proof.verify.selftest_log import problems, read_log
from toolchain.quick import quick
from toolchain.tools import compile_c, require, require_32_bit, run

TRIED = ("auv6", "demo3", "everything6", "bare0", "bench8", "everything0", "drawn12")


@pytest.mark.parametrize("real", ["double", "float"])
@pytest.mark.parametrize("name", quick(3, TRIED))
def test_good_c_has_the_interpreters_bits(name: str, real: str, tmp_path: Path) -> None:
    generated, files = generate_with_selftest(name, real)
    status, printed = run_selftest(files, name, tmp_path)
    (log,) = read_log(printed, name)
    assert (status, problems(log)) == (0, [])
    assert list(log.functions) == [f.name for f in generated.program.functions if f.public]
    assert {line.worst for line in log.functions.values()} == {0}


@pytest.mark.slow
@pytest.mark.parametrize("real", ["float", "double"])
def test_compilers_print_the_same(real: str, tmp_path: Path) -> None:
    require("clang", "clang")
    _, files = generate_with_selftest("demo3", real)
    found = []
    for compiler, optimisation in (("gcc", "-O2"), ("clang", "-O1")):
        folder = tmp_path / f"{compiler}{optimisation}"
        folder.mkdir()
        found.append(run_selftest(files, "demo3", folder, compiler, optimisation))
    assert found[0] == found[1]
    assert found[0][0] == 0


@pytest.mark.slow
@pytest.mark.parametrize("real", ["float", "double"])
def test_32_bits_print_the_same(real: str, tmp_path: Path) -> None:
    require_32_bit()
    _, files = generate_with_selftest("demo3", real)
    found = []
    for number, flags in enumerate(((), ("-m32", "-msse2", "-mfpmath=sse"))):
        (tmp_path / str(number)).mkdir()
        found.append(run_selftest(files, "demo3", tmp_path / str(number), "gcc", "-O1", *flags))
    assert found[0] == found[1]
    assert found[0][0] == 0


@pytest.mark.parametrize(("name", "real"), quick(1, [("demo3", "double"), ("bare5", "float")]))
def test_the_sweep_is_that_of_the_interpreter(name: str, real: str, tmp_path: Path) -> None:
    # the C draws its own states: integers, scaling and quaternions must be those of Python, refused states included
    generated, files = generate_with_selftest(name, real)
    states = 20
    _, printed = run_selftest(files, name, tmp_path, "gcc", "-O1", f"-D{name.upper()}_SELFTEST_SWEEP={states}ul")
    (log,) = read_log(printed, name)
    expected = sweep_hashes(generated.program, generated.values, states)
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


@pytest.mark.parametrize(
    ("place", "readers", "others"),
    [
        (-1, {"inverse", "inverse_fast"}, {"coupled", "forward", "quaternion", "torque", "momentum"}),
        (-2, {"coupled"}, {"inverse", "forward", "quaternion", "torque", "momentum"}),
    ],
    ids=["1/sqrt(Theta_ff)", "1/Theta_ff"],
)
def test_a_digit_of_the_table_is_found(place: int, readers: set[str], others: set[str], tmp_path: Path) -> None:
    _, files = generate_with_selftest("bench8")
    row = files["bench8.c"].split("bench8_default =")[1].split("/* w2 */")[0]
    number = re.findall(r"\d+\.\d{6,}", row)[place]
    worse = row.replace(f" {number},", f" {number[:-1]}{'7' if number[-1] != '7' else '3'},")  # its last digit
    names, log = failed({**files, "bench8.c": replaced(files["bench8.c"], row, worse)}, "bench8", tmp_path)
    assert readers <= names
    assert not names & others
    assert all(log.functions[name].worst > 0 for name in readers)


@pytest.mark.parametrize(
    ("function", "others"),
    [
        ("torque", {"forward", "coupled", "mounts", "momentum"}),
        ("mounts", {"forward", "torque", "prepare_mounts"}),
        ("momentum", {"forward", "matrices"}),
        ("quaternion", {"forward", "prepare"}),
        ("inverse_fast", {"inverse", "forward"}),
    ],
)
def test_a_sign_in_a_function_is_found_and_named(function: str, others: set[str], tmp_path: Path) -> None:
    _, files = generate_with_selftest("bench8")
    source = in_function(files["bench8.c"], "bench8", function, r"\n( +[^/\n]*?[\w\])]) \+ (\w)", r"\n\1 - \2")
    names, _ = failed({**files, "bench8.c": source}, "bench8", tmp_path)
    assert function in names
    assert not names & others


def test_a_lost_check_is_found(tmp_path: Path) -> None:
    # the quaternion of angles that are out of range: another status, and outputs that should not be written
    _, files = generate_with_selftest("bench8")
    source = in_function(
        files["bench8.c"], "bench8", "quaternion", r"if \(status != BENCH8_OK\) \{", "if (status == BENCH8_OK + 77) {"
    )
    names, log = failed({**files, "bench8.c": source}, "bench8", tmp_path)
    assert names == {"quaternion", "state_from_coordinates"}  # which calls it
    assert log.functions["quaternion"].wrong == 2
    assert log.functions["quaternion"].faults == "status, trials"


def test_an_output_written_before_a_refusal_is_found(tmp_path: Path) -> None:
    _, files = generate_with_selftest("bench8")
    source = in_function(files["bench8.c"], "bench8", "torque", r"(BAD_ARGUMENT; \}\n)", r"\1    tau[0] = 0.0;\n")
    names, log = failed({**files, "bench8.c": source}, "bench8", tmp_path)
    assert names == {"torque"}
    assert log.functions["torque"].wrong == 2
    assert (log.functions["torque"].worst, log.functions["torque"].faults) == (0, "trials, written though refused")
    assert problems(log)[0] == "FAIL: torque (trials, written though refused)"


def test_a_hash_of_numbers_that_are_not_listed_is_named(tmp_path: Path) -> None:
    """Statuses and listed numbers are right, so no distance is printed."""
    _, files = generate_with_selftest("demo3")
    row = re.search(
        r"\{ \"generalized\",.*?\{ \{ 0, (0x[0-9a-f]{8})u", files["verification/demo3_selftest.c"], re.DOTALL
    )
    assert row is not None
    tampered = replaced(
        files["verification/demo3_selftest.c"], row[0], row[0].replace(row[1], f"0x{int(row[1], 16) ^ 1:08x}")
    )
    status, printed = run_selftest({**files, "verification/demo3_selftest.c": tampered}, "demo3", tmp_path)
    assert status == 1
    assert "\ngeneralized FAIL cases 5 wrong 1 (other members)\n" in printed
    (log,) = read_log(printed, "demo3")
    assert problems(log)[0] == "FAIL: generalized (other members)"


@pytest.mark.parametrize(("real", "precision"), [("double", DOUBLE), ("float", FLOAT)])
@pytest.mark.parametrize("ulp", [1, 3])
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
    assert (log.functions["forward"].worst, log.functions["forward"].faults) == (ulp, "numbers")


@pytest.mark.parametrize("real", ["double", "float"])
def test_a_distance_beyond_counting_is_said_in_words(real: str, tmp_path: Path) -> None:
    # another sign: a number of 10 or 19 digits that nobody can read
    _, files = generate_with_selftest("demo3", real)
    source = re.sub(r"(y\[0\] = )(v1_dot)", r"\1-\2", files["demo3.c"])
    assert source != files["demo3.c"]
    _, printed = run_selftest({**files, "demo3.c": source}, "demo3", tmp_path)
    (log,) = read_log(printed, "demo3")
    fail = r"^forward FAIL cases 5 wrong \d \(numbers, sweep\) worst more than 1000000 ulp$"
    assert re.search(fail, printed, re.MULTILINE)
    assert log.functions["forward"].worst == FAR + 1
    assert "forward (numbers, sweep, worst more than 1000000 ulp)" in problems(log)[0]
    assert max(len(n) for n in re.findall(r"worst (?:more than )?(\d+) ulp", printed)) <= 7


@pytest.mark.parametrize(
    ("function", "old", "new"),
    [
        ("inverse", r"options->damping > 0\.0", "options->damping > 1.0"),
        ("allocate", r"weight\[s\]", "weight[0]"),
        ("accumulate", r"place < turn\) \? place", "place < turn + 9) ? place"),
        ("step", r"tau == NULL \|\| ", ""),
        ("check_inertia", r"if \(!\(d2 > 0\.0\)\)", "if (d2 == 77.0)"),
        ("step_driven", r"if \(!\(dt > 0\.0\)\)", "if (dt < -77.0)"),
    ],
)
def test_a_fault_in_a_rare_branch_is_found(function: str, old: str, new: str, tmp_path: Path) -> None:
    """No golden case enters it: damping, weights, a counter at its turn, a null pointer, a body that cannot be."""
    _, files = generate_with_selftest("bench8")
    text = re.sub(r"^static (?=\w+ bench8_\w+\()", "", files["bench8.c"], flags=re.MULTILINE)
    source = in_function(text, "bench8", function, old, new)
    status, printed = run_selftest({**files, "bench8.c": source}, "bench8", tmp_path, "gcc", "-O0", "-w")
    assert status != 0
    assert status < 0 or "trials" in printed or "sweep)" in printed


# ---- what is in it ----


@pytest.mark.parametrize("name", ["bench8", "sat4"])
def test_every_status_occurs_and_nine_tenths_of_the_branches_are_taken(name: str, tmp_path: Path) -> None:
    generated, files = generate_with_selftest(name)
    known = {each.status for each in golden(generated.program, generated.values).trials}
    assert all(any(each & bit for each in known if each > 0) for bit in (1, 2, 4, 8, 16, 32, 64))
    assert known >= {-1, -2, -3, -4, -5}
    source = write(files, tmp_path)
    lines = measure_branches(source, tmp_path / f"verification/{name}_selftest.c", tmp_path)
    assert sum(each.taken for each in lines) >= 0.9 * sum(each.ways for each in lines)


@pytest.mark.parametrize("real", quick(1, ["double", "float"]))
@pytest.mark.parametrize("name", quick(4, NAMES))
def test_every_function_has_a_good_and_a_refused_case(name: str, real: str) -> None:
    generated, _ = generate_with_selftest(name, real)
    for function, answers in golden(generated.program, generated.values).answers.items():
        statuses = [a.status for a in answers]
        assert statuses[-1] < 0, (function, statuses)
        if (function, real) != ("inverse_fast", "float"):  # squares the condition: a float has few digits for that
            assert max(statuses) >= 0, (function, statuses)


@pytest.mark.slow
def test_its_size_hardly_grows() -> None:
    def size(flywheels: int) -> int:
        wheels = stand("bench8").flywheels
        many = tuple(replace(wheels[i % 8], name=f"w{i + 1}") for i in range(flywheels))
        given = replace(stand("bench8"), flywheels=many)
        (text,) = selftest_files(given, generate_all(given)).values()
        return len(text)

    assert size(8) < 110_000
    assert size(64) < 133_000


def test_it_names_its_cases_and_stand() -> None:
    text = generate_with_selftest("bench8")[1]["verification/bench8_selftest.c"]
    for case in CASES:
        assert f"/* {case} */" in text
    assert f"at most {LISTED} " in text
    assert "malloc" not in text
    assert max(map(len, text.splitlines())) <= 120


@pytest.mark.parametrize(
    ("value", "precision", "text"),
    [
        (12.0, DOUBLE, "0x1.8p+3"),
        (0.1, DOUBLE, "0x1.999999999999ap-4"),
        (0.1, FLOAT, "0x1.99999ap-4F"),
        (-0.0, DOUBLE, "-0x0p+0"),
        (5e-324, DOUBLE, "0x0.0000000000001p-1022"),
        (1.0, FLOAT, "0x1p+0F"),
    ],
)
def test_hexadecimal_literals_are_exact(value: float, precision: Precision, text: str) -> None:
    assert hex_literal(value, precision) == text
    back = float.fromhex(text.rstrip("F"))
    assert back == float(precision.scalar(value))
    assert math.copysign(1, back) == math.copysign(1, value)


@pytest.mark.parametrize("value", [math.inf, -math.inf, math.nan])
def test_what_has_no_literal_is_refused(value: float) -> None:
    with pytest.raises(ValueError, match="no literal"):
        hex_literal(value, DOUBLE)


def test_its_text_does_not_depend_on_the_seed_of_hashes() -> None:
    code = "from emit.selftests import generate_with_selftest as made; print(made('shaker2')[1])"
    root = Path(__file__).resolve().parents[1]
    places = os.pathsep.join((str(root), str(root.parent / "generator")))
    texts = []
    for seed in ("1", "2"):
        environment = os.environ | {"PYTHONHASHSEED": seed, "PYTHONPATH": places}
        texts.append(subprocess.run([sys.executable, "-c", code], env=environment,
                     capture_output=True, text=True, check=True).stdout)  # fmt: skip
    assert texts[0] == texts[1]
