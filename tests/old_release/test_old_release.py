"""The C of today gives the bits of the release before: its self-tests, unedited, over a header of renamed things."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from dataclasses import replace
from pathlib import Path

import pytest

import mahovik
from mahovik.core.emit.generate import generate_all
from mahovik.core.toolchain.workload import LONG_CALL
from mahovik.proof.verify.selftest_log import read_log
from old_release.renames import FUNCTIONS, shim
from toolchain.quick import quick
from toolchain.tools import compile_c

FOLDER = Path(__file__).parent
GENERATED = FOLDER.parents[1] / "generated"
NAMES = sorted(path.name.removesuffix("_selftest.c") for path in FOLDER.glob("*_selftest.c"))


def run_old_selftest(name: str, source: Path, folder: Path) -> set[str]:
    """Names of the functions whose golden vectors fail: the old self-test with this C and the header beside it."""
    header = source.parent / f"{name}.h"
    (folder / "shim.h").write_text(shim(name, header.read_text(encoding="utf-8")), encoding="utf-8")
    program, new, plain = folder / "selftest", folder / "new.o", f"-D{name.upper()}_PLAIN_NAMES"
    compile_c("gcc", source, f"-I{header.parent}", plain, "-O1", "-c", "-o", new)
    shimmed = (f"-I{header.parent}", plain, "-include", folder / "shim.h")
    compile_c("gcc", FOLDER / f"{name}_selftest.c", *shimmed, new, "-o", program)
    done = subprocess.run([program], capture_output=True, text=True, check=False, timeout=120)
    (run,) = read_log(done.stdout, "selftest")
    assert (done.returncode == 0) == (run.failures == 0)
    assert len(run.functions) > 15
    return {function for function, line in run.functions.items() if not line.passed}


NEWER = ["eye4"]
"""Example stands that the old release did not have."""


def test_every_example_stand_is_held() -> None:
    """Nothing is skipped because a file is missing."""
    assert sorted(path.name for path in GENERATED.iterdir() if path.is_dir()) == sorted([*NAMES, *NEWER])


ROUNDED_OTHERWISE = {"inverse_fast"}
"""Functions with the same equations and another order of operations than then, see the changelog."""


@pytest.mark.parametrize("name", quick(2, NAMES))
def test_golden_vectors_of_the_old_release_pass(name: str, tmp_path: Path) -> None:
    """Same bits, whatever things are called now."""
    source = GENERATED / name / f"{name}.c"
    stand = mahovik.example(name)
    if stand.tasks:  # which the stands of then did not have
        for file, text in generate_all(replace(stand, tasks=())).files.items():
            (tmp_path / file).write_text(text, encoding="ascii")
        source = tmp_path / source.name
    assert run_old_selftest(name, source, tmp_path) <= ROUNDED_OTHERWISE


def test_another_rounding_is_noticed(tmp_path: Path) -> None:
    """The old self-test runs the C of today, to the last bit."""
    text = (GENERATED / "bench8" / "bench8.c").read_text(encoding="utf-8")
    right = "F[0] * table->mass_inverse"
    wrong = "F[0] / table->mass"
    assert right in text
    source = tmp_path / "bench8.c"
    source.write_text(text.replace(right, wrong), encoding="utf-8")
    shutil.copy(GENERATED / "bench8" / "bench8.h", tmp_path)
    assert {"step_driven", "forward_jacobian"} <= run_old_selftest("bench8", source, tmp_path)


RAISED = {
    "step": 0.02, "step(order=2)": 0.02, "step_driven": 0.02, "step_driven(order=2)": 0.02,
    "coupled": 0.002, "inverse": 0.03, "inverse_fast": 0.04,
}  # fmt: skip
"""Functions that may cost more than then, and by how much: steps see how far a flywheel or the carrier turns in them,
and share their stages with the steps with a carry, which is a call; `locked` may be null; no answer of `inverse`
exceeds its limit; that of `inverse` and `inverse_fast` is looked at before it is written; that of
`inverse` is compared with what the motors have."""

STATUS = 5
"""Instructions by which any function may differ: a status is an int, where a compiler took a byte for the enum."""


@pytest.mark.parametrize("name", NAMES)
def test_instruction_counts_are_at_most_those_of_the_old_release(name: str) -> None:
    """Recorded costs by processor, element type and function: names have changed, functions were added."""
    old = json.loads((FOLDER / "instructions.json").read_text(encoding="utf-8"))[name]
    recorded = json.loads((GENERATED / name / "cost.json").read_text(encoding="utf-8"))
    new = {
        f"{target['target']} {target['real']}": {f["function"]: f["instructions"] for f in target["functions"]}
        for target in recorded["targets"]
    }
    assert set(new) == set(old)
    for target, counts in old.items():
        renamed = {re.sub(r"^\w+", lambda m: FUNCTIONS.get(m[0], m[0]), f): count for f, count in counts.items()}
        for function, count in renamed.items():
            more = new[target][function] - count
            same = max(counter_error(count), STATUS)
            assert more <= same + RAISED.get(function, 0.0) * count, (target, function)


def counter_error(count: int) -> int:
    """Instructions: the counter is good to 50; a long call is counted once, of others the mean of many is taken."""
    return 50 if count >= LONG_CALL else 1
