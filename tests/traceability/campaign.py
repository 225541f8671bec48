"""Mutants of each program function, and the tests that notice them.

A mutant is planted into every program that a forked process makes: the interpreter, the tables, the C that tests
compile, all have it. The comparison with the literal reference goes first; what it lets through, tests are run on.
"""

from __future__ import annotations

import json
import multiprocessing
import os
import signal
import tempfile
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import asdict, dataclass, field, replace
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from emit import stands as examples
from mahovik.core.emit.expression import Expressions
from mahovik.core.emit.generate import Generated
from mahovik.core.emit.names import Names
from mahovik.core.emit.statement import Statements
from mahovik.core.lower.values import Values
from mahovik.core.program.function import Function, Program
from mahovik.core.program.types import DOUBLE
from mahovik.proof.verify.c_backend import InterpreterBackend
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.harness import judge
from mahovik.proof.verify.program_backend import with_all_inputs
from traceability.equations import ROOT, subjects
from traceability.lines import functions, names
from traceability.mutants import MUTANTS, chosen, mutant, planted, sites
from verify.build import everything, generated

TESTED = 1
"""Number of mutants, of those that the comparison lets through, on which the tests are run."""

LIMIT = 400
"""Seconds of the tests on a mutant: one on which they take longer is not counted."""

LATE = ["(does not end)"]

HARNESS = (
    "tests/verify/test_harness.py::test_a_stand_with_everything_passes_as_c",
    "tests/lower/test_undefined.py::test_nothing_is_read_before_it_is_written[everything6]",
)
STEPS = ("tests/lower/test_steps.py",)
MOTION = ("tests/lower/test_motion.py",)
PHASES = ("tests/lower/test_phases.py",)
INVERSE = (
    *(f"tests/lower/test_inverse.py::test_residual_and_equations_agree[{count}]" for count in (1, 5, 7)),
    "tests/lower/test_inverse.py::test_limits_are_kept_and_told",
    "tests/lower/test_inverse.py::test_damping_lowers_what_is_near_singular",
    "tests/lower/test_inverse.py::test_weights_choose_among_flywheels",
    "tests/lower/test_inverse.py::test_bad_options_are_refused",
    *(f"tests/lower/test_inverse.py::test_others_give_what_a_limited_flywheel_cannot[{seed}-7]" for seed in range(4)),
    *(
        f"tests/lower/test_coordinates.py::test_the_cheap_inverse_agrees_with_the_careful_one[{count}]"
        for count in (5, 7)
    ),
    "tests/lower/test_coordinates.py::test_damping_of_the_cheap_inverse_lowers_the_answer",
)
TARGET = (
    "tests/lower/test_coordinates.py::test_state_from_coordinates_inverts_the_generalized_form",
    "tests/lower/test_coordinates.py::test_a_singular_attitude_is_refused",
)
JACOBIAN = (
    *(f"tests/lower/test_jacobian.py::test_derivatives_of_forward[everything 4-{seed}]" for seed in (1, 2)),
    *(f"tests/lower/test_jacobian.py::test_derivatives_of_coupled[everything 4-{seed}]" for seed in (1, 2)),
    "tests/lower/test_jacobian.py::test_some_flywheels_locked",
)
PARAMETERS = (
    "tests/lower/test_unphysical.py",
    "tests/lower/test_prepare.py::test_default_parameters_give_the_default_table[everything6]",
    "tests/lower/test_prepare.py::test_parameters_of_another_stand_give_its_table[everything6]",
    "tests/lower/test_prepare.py::test_a_mount_that_is_none",
    "tests/lower/test_prepare.py::test_axes_without_a_direction",
    "tests/lower/test_prepare.py::test_a_flywheel_without_spin_inertia",
    "tests/lower/test_prepare.py::test_axes_are_directions_down_to_a_small_length",
    "tests/lower/test_prepare.py::test_each_moment_of_inertia_counts_towards_the_largest_sum",
)
ROUTINES = ("tests/routines/test_sincos.py", "tests/routines/test_square_root.py", "tests/routines/test_arc_tangent.py")
EACH = "tests/routines/test_sincos.py::test_angles_in_a_loop_have_the_bits_of_one_angle"
REFUSALS = tuple(
    f"tests/lower/test_refusals.py::{test}[everything6]"
    for test in (
        "test_not_finite_in_any_element",
        "test_beyond_the_range_in_any_element",
        "test_at_the_limit_every_element_is_accepted",
    )
)

CHECKS = ("tests/lower/test_checks.py",)
TASKS = (
    "tests/verify/test_task_faults.py::test_the_judges_are_satisfied",
    "tests/verify/test_task_torques.py::test_the_judges_are_satisfied",
    "tests/verify/test_task_torques.py::test_one_wrong_input_at_a_time_is_refused",
    "tests/verify/test_task_faults.py::test_tasks_of_random_stands[1-double]",
)

BY_NAME = {
    "sincos": ROUTINES[:1], "sqrt": ROUTINES[1:2], "atan2": ROUTINES[2:], "unwound": MOTION,
    "wrapped": MOTION, "orthogonalise": INVERSE, "factor": INVERSE, "solve_gram": INVERSE, "prepare": PARAMETERS,
    "quaternion": (*TARGET, *REFUSALS), "state_from_coordinates": (*TARGET, *CHECKS),
    "within": REFUSALS, "check_state": REFUSALS,
    "check_motion": (*REFUSALS, *CHECKS), "frame_of_axes": (*PARAMETERS, *CHECKS), "excessive": TASKS,
    "balance": TASKS, "motor_lacks": TASKS,
    "wrap": PHASES,
    "accumulate": PHASES, "phase_of_counts": PHASES, "speed_of_counts": PHASES, "generalized": (*REFUSALS, *TARGET),
    "coupled": MOTION, "stages": (*MOTION, *STEPS), "stages_driven": (*MOTION, *STEPS),
    "translation_block": PARAMETERS, "carry": PARAMETERS, "sincos_each": (*MOTION, EACH),
}  # fmt: skip
BY_SUBJECT = {
    "(12)": INVERSE, "motion in time": MOTION, "whole system": MOTION, "checks of inputs": PARAMETERS,
    "tasks": TASKS,
}  # fmt: skip


OF_ROWS = tuple(f"_{rows}" for rows in range(1, 7))
"""Ends of names of functions for a number of rows, which tasks have."""


def tests_of(function: Function) -> tuple[str, ...]:
    """The tests that are run on mutants of a function."""
    if function.name in BY_NAME:
        return BY_NAME[function.name]
    if function.name[-2:] in OF_ROWS:
        return TASKS
    if function.name.endswith("_carried"):
        return STEPS
    if function.name.endswith(("_slope", "_jacobian")):
        return JACOBIAN
    for subject in subjects(function):
        if subject in BY_SUBJECT:
            return BY_SUBJECT[subject]
    if function.name.startswith("place_") or function.name == "frame_of_axes":
        return (*PARAMETERS, *CHECKS)
    return HARNESS


@dataclass
class Found:
    """What became of the mutants of one function."""

    function: str
    sites: int
    mutants: int = 0
    comparison: int = 0
    tests: int = 0
    quantities: list[str] = field(default_factory=list)
    noticed: list[str] = field(default_factory=list)
    survivors: list[str] = field(default_factory=list)


@cache
def judged_by() -> dict[str, tuple[Any, Any]]:
    """Stands whose programs hold the functions, by function: one with everything, else an example stand."""
    stand = with_all_inputs(everything())
    made = generated(stand)
    found: dict[str, tuple[Any, Any]] = {f.name: (stand, made) for f in made.program.functions}
    for name, function in functions().items():
        if name not in found:
            example = next(n for n in names() if function in examples.generated(n).program.functions)
            found[name] = (examples.stand(example), examples.generated(example))
    return found


Change = Callable[[tuple[Function, ...]], tuple[Function, ...]]


def without_mutant_all_agree(name: str, change: Change = lambda functions: functions) -> None:
    """Raises AssertionError where the comparison finds the unchanged program wrong: it would notice every mutant.

    `change` is for a test of this check alone.
    """
    stand, made = judged_by()[name]
    wrong = _differing(stand, made, replace(made.program, functions=change(made.program.functions)))
    if wrong:
        raise AssertionError(f"{name}: the program without a mutant differs in {', '.join(wrong)}")


def compared(name: str, numbers: Sequence[int]) -> list[list[str]]:
    """Quantities that the comparison with the reference finds wrong, for each mutant."""
    stand, made = judged_by()[name]
    return [_quantities(stand, made, name, number) for number in numbers]


def _quantities(stand: Any, made: Any, name: str, number: int) -> list[str]:
    try:
        with TimeLimit(30):
            return _differing(stand, made, _with(made.program, name, number))
    except Exception as error:  # a mutant may do anything: that it cannot run is a way to be noticed
        return [f"{type(error).__name__}"]


def _differing(stand: Any, made: Any, program: Program) -> list[str]:
    """Quantities of a program that differ from the reference: at four states, of which each want has one compared."""
    states = draw(stand, 5, 4, wrenches=stand == with_all_inputs(stand))
    backend = InterpreterBackend(Generated(made.layout, program, Values(stand, made.layout, program), {}))
    return sorted({r.quantity for r in judge(stand, backend, states, backend.wants) if r.failed})


class TimeLimit:
    """Raises TimeoutError after this many seconds."""

    def __init__(self, seconds: int) -> None:
        self._seconds = seconds

    def __enter__(self) -> None:
        def stop(*_: Any) -> None:
            raise TimeoutError

        signal.signal(signal.SIGALRM, stop)
        signal.alarm(self._seconds)

    def __exit__(self, *_: Any) -> None:
        signal.alarm(0)


def _with(program: Program, name: str, number: int) -> Program:
    return replace(program, functions=planted(name, number)(program.functions))


class _Noticed:
    """Collects failed tests of a pytest run."""

    def __init__(self) -> None:
        self.failed: list[str] = []
        self.ran = 0

    def pytest_runtest_logreport(self, report: Any) -> None:
        self.ran += report.when == "call"
        if report.failed:
            self.failed.append(report.nodeid)


def tested(function: Function, number: int | None, first: bool) -> list[str]:
    """Tests that fail with a mutant (None: with none) in all programs, in a process of their own."""
    found: list[str] = in_a_fork(lambda: _tested(function, number, first), LIMIT, LATE)
    return found


def _tested(function: Function, number: int | None, first: bool) -> list[str]:
    if number is not None:
        change, original = planted(function.name, number), Program.__init__

        def init(
            self: Program, name: str, precision: Any, counts: Any, structs: Any, functions: Any, spare: Any = ()
        ) -> None:
            original(self, name, precision, counts, structs, change(functions), spare)

        Program.__init__ = init  # type: ignore[method-assign]
    seen = _Noticed()
    options = ["-q", "-p", "no:cacheprovider", "-p", "no:xdist", "-o", "addopts=", "-m", "not fuzz", "--tb=no"]
    with open(os.devnull, "w") as nowhere, redirect_stdout(nowhere), redirect_stderr(nowhere):
        status = pytest.main([*options, *(["-x"] if first else []), *tests_of(function)], plugins=[seen])
    if status not in (pytest.ExitCode.OK, pytest.ExitCode.TESTS_FAILED):
        return [f"(pytest: {status!r})"]
    assert seen.ran or seen.failed
    return seen.failed


def in_a_fork(work: Callable[[], Any], seconds: int, late: Any) -> Any:
    """What `work` returns in a forked process; `late` where it takes too long or dies."""
    with tempfile.TemporaryDirectory() as folder:
        answer = Path(folder) / "answer"

        def child() -> None:
            os.setpgrp()
            answer.with_suffix(".part").write_text(json.dumps(work()))
            answer.with_suffix(".part").rename(answer)

        process = multiprocessing.get_context("fork").Process(target=child)
        process.start()
        assert process.pid is not None
        process.join(seconds)
        if process.is_alive():
            os.killpg(process.pid, signal.SIGKILL)
            process.join()
        return json.loads(answer.read_text()) if answer.exists() else late


def examined(function: Function) -> Found:
    """All about the mutants of one function."""
    judged = judged_by()[function.name][1].program.function(function.name) if function.name in judged_by() else function
    count = sites(judged)
    found = Found(function.name, count)
    numbers = chosen(count, MUTANTS)
    if not numbers:
        return found
    without_mutant_all_agree(function.name)
    quantities = in_a_fork(lambda: compared(function.name, numbers), 400, [["(does not end)"]] * len(numbers))
    through = []
    for number, wrong in zip(numbers, quantities, strict=True):
        if wrong:
            found.comparison += 1
            found.quantities = sorted({*found.quantities, *wrong})
        else:
            through.append(number)
    found.mutants = found.comparison
    for number in through[:TESTED]:
        found.mutants += 1
        failing = tested(judged, number, first=False)
        if failing == LATE:  # says nothing: the machine may be busy
            found.mutants -= 1
        elif failing:
            found.tests += 1
            found.noticed = sorted({*found.noticed, *map(short, failing)})
        else:
            found.survivors.append(described(judged, number))
    return found


def short(node: str) -> str:
    """A test's name without its parameters."""
    return node.partition("[")[0].removeprefix("tests/")


def described(function: Function, number: int) -> str:
    """Change of a mutant: the kind, and the lines of C before and after."""
    changed, kind = mutant(function, number)
    names = Names("")
    print_ = Statements(names, Expressions(names, DOUBLE))
    before, after = (set(print_.block(f.body, "")) for f in (function, changed))
    gone = " ".join(line.strip() for line in print_.block(function.body, "") if line in before - after)
    return f"{kind}: {gone}"


def campaign(wanted: Sequence[str], jobs: int, say: Callable[[Found], None]) -> Iterator[dict[str, Any]]:
    """Found of each function named, as plain data, in their order."""
    judged_by()
    with ThreadPoolExecutor(jobs) as pool:
        for found in pool.map(examined, [functions()[name] for name in wanted]):
            say(found)
            yield asdict(found)


def collected() -> None:
    """Imports every test module that is run, so that forks need not."""
    nodes = sorted({node.partition("::")[0] for f in functions().values() for node in tests_of(f)})
    with open(os.devnull, "w") as nowhere, redirect_stdout(nowhere):
        status = pytest.main(["--collect-only", "-q", "-p", "no:cacheprovider", *(str(ROOT / n) for n in nodes)])
    assert status == pytest.ExitCode.OK
