"""C for speed: its self-test accepts rounding and nothing else; what it delivers says that bits differ."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from emit.selftests import generate_with_selftest, in_function, run_selftest
from emit.stands import stand
from mahovik.core.emit.delivery import delivery
from mahovik.core.emit.manifest import manifest
from mahovik.core.lower.golden import ACCEPTED
from mahovik.core.toolchain.compiler import FAST
from mahovik.errors import UsageError
from mahovik.proof.verify.selftest_log import read_log
from toolchain.tools import require

_WORST = re.compile(
    r"^(\w+) (PASS|FAIL) cases 3(?: wrong \d \(numbers\))? worst (more than )?(\d+) units$", re.MULTILINE
)


def built(files: dict[str, str], name: str, folder: Path, compiler: str = "gcc") -> tuple[int, str]:
    """Compiled as the header says, and run."""
    require(compiler, compiler)
    return run_selftest(files, name, folder, compiler, *FAST)


@pytest.mark.parametrize(
    ("name", "real", "lanes"),
    [
        pytest.param("demo3", "double", 2, marks=pytest.mark.slow),
        pytest.param("demo3", "float", 2, marks=pytest.mark.slow),
        pytest.param("everything6", "double", 4, marks=pytest.mark.slow),
    ],
)
def test_rounding_is_accepted_with_room(name: str, real: str, lanes: int, tmp_path: Path) -> None:
    """A self-test that just passes would fail on the next processor."""
    status, printed = built(generate_with_selftest(name, real, lanes, True)[1], name, tmp_path)
    found = _WORST.findall(printed)
    assert status == 0, printed
    assert len(found) >= 15
    assert all(verdict == "PASS" and not far and int(worst) < ACCEPTED / 4 for _, verdict, far, worst in found), printed


@pytest.mark.slow
@pytest.mark.parametrize("change", [r"\1 * 1.0000001", "0.0 / 0.0"])
def test_a_wrong_number_is_found(change: str, tmp_path: Path) -> None:
    files = dict(generate_with_selftest("demo3", "double", 2, True)[1])
    files["demo3.c"] = in_function(files["demo3.c"], "demo3", "momentum", r"(?<=energy = )([^;]+)(?=;)", change)
    status, printed = built(files, "demo3", tmp_path)
    assert status == 1
    assert [name for name, verdict, _, _ in _WORST.findall(printed) if verdict == "FAIL"] == ["momentum"]


def test_its_log_is_not_judged_by_bits(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match=r"^board.log: of C for speed \(--fast\): its bits are not reproducible"):
        read_log("mahovik selftest demo3 structure 00000000 physics 00000000 real double lanes 2 fast\n", "board.log")


def test_the_delivery_says_so() -> None:
    files = delivery(stand("demo3"), "double", 2, True)
    assert set(files) == {
        "demo3.h",
        "demo3.c",
        "verification/demo3_selftest.c",
        "README.md",
    }  # no recorder: replay wants bits
    flags = " ".join(FAST)
    assert "bits are NOT reproducible" in files["demo3.h"]
    assert flags in files["demo3.h"]
    assert "the bits are not reproducible" in files["README.md"]
    assert files["README.md"].count(f"cc -std=c99 {flags} ") == 2
    for text in files.values():
        assert "-ffp-contract=off" not in text
    told = json.loads(manifest(stand("demo3"), "double", files, lanes=2, fast=True))
    assert (told["lanes"], told["fast"]) == (2, True)
    assert "fast" not in json.loads(manifest(stand("demo3"), "double", files))


@pytest.mark.slow
def test_what_differs_from_c_with_the_same_bits() -> None:
    """The functions are the same: so what is proved of the one is, but for rounding, true of the other.

    C for speed asks for fused multiply-add, has copies of the sines in the callers, and the flywheels first in a state.
    Its drive torques are added up by harmonics.
    """
    slow, fast = generate_with_selftest("demo3", "double", 2)[1], generate_with_selftest("demo3", "double", 2, True)[1]
    assert fast["demo3.c"].count("fp-contract=fast") == 1
    bodies = [
        dict(re.findall(r"^(?:static )?(?:inline )?\w+ (demo3_\w+)\((.*?)^}$", f["demo3.c"], re.DOTALL | re.MULTILINE))
        for f in (slow, fast)
    ]
    assert [*bodies[0]] == [*bodies[1]]
    assert len(bodies[0]) > 50
    differ = {
        name.removeprefix("demo3_") for name, body in bodies[0].items() if body.split() != bodies[1][name].split()
    }
    by_member = {"advance", "advance_carried", "finish_carried", "stages", "stages_driven"}
    assert differ == by_member | {"balance", "balance_block", "torque"}
    words = "#define DEMO3_FAST      1            /* bits not reproducible: see above */\n"
    lines = [[line for line in f["demo3.h"].splitlines(True) if line[:3] != " * "] for f in (slow, fast)]
    assert sorted(lines[0]) == sorted(line for line in lines[1] if line != words)
    members = [
        re.findall(r"(\w+)\[", f["demo3.h"].split("struct demo3_state {")[1].split("}")[0]) for f in (slow, fast)
    ]
    assert members == [["position", "attitude", "V", "phi", "phi_dot"], ["phi", "phi_dot", "position", "attitude", "V"]]
