"""`generate --only`: some of the public functions and what they need, with the bits of the whole."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from cli.run import refused
from emit.stands import generated, stand, write
from mahovik.core.emit.delivery import delivery
from mahovik.stands import path
from toolchain.tools import compile_c, require, run


@pytest.mark.parametrize("only", ["forward,torque", "step", "mounts", "quaternion", "accumulate", "inverse,prepare"])
def test_a_part_compiles_and_passes_its_self_test(only: str, tmp_path: Path) -> None:
    """Every warning is an error; golden vectors and sweeps are those of the interpreter."""
    names = only.split(",")
    write(delivery(stand("sat4"), only=tuple(names)), tmp_path)
    header = (tmp_path / "sat4.h").read_text()
    public = re.findall(r"^sat4_status sat4_(\w+)\(|^sat4_real sat4_(\w+)\(", header, re.MULTILINE)
    assert {a or b for a, b in public} == {*names, *(["prepare_mounts"] if "mounts" in names else [])}
    program = tmp_path / "program"
    compile_c(require("gcc", "gcc"), *sorted(tmp_path.glob("*.c")), "-O1", "-ffp-contract=off", "-o", program)
    log = run(program)
    assert log.splitlines()[-1] == "failures 0"
    assert all(name in log for name in names)
    assert (tmp_path / "sat4_recorder.h").exists() == ("step" in names)


def test_a_part_is_text_of_the_whole_and_smaller() -> None:
    whole = generated("sat4").files["sat4.c"]
    part = delivery(stand("sat4"), only=("forward",))["sat4.c"]
    assert len(part) < len(whole) / 3
    body = re.search(r"\nsat4_status sat4_forward\(.*?\n}\n", part, re.DOTALL)
    assert body is not None and body[0] in whole


def test_an_unknown_function_is_refused() -> None:
    message = refused("generate", str(path("sat4")), "--only", "forward,torqe")
    assert '--only torqe: the C of sat4 has no such function, did you mean "torque"?' in message
    assert "--only: not with --batch" in refused("generate", str(path("sat4")), "--only", "forward", "--batch")
