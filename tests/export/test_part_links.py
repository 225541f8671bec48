"""Callers of servos and programmes do not link with a source of another header; two servos lie in one image."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Mapping
from pathlib import Path

import pytest

from cli.run import refused, run
from emit.stands import write
from export.programmes import exported as programme
from export.programmes import motion, spin, stand, stand_files
from export.servos import HEAD, TRIM, servo
from export.servos import exported as servos
from mahovik import stands
from mahovik.core.motion.programme import save_programme
from mahovik.out.export.servo import export_servo
from toolchain.quick import quick
from toolchain.tools import compile_c, require
from toolchain.tools import run as run_program

CALLERS = {
    "servo": "shaker2_servo_state state;\n    return (int)shaker2_servo_reset(&state);",
    "programme": "shaker2_programme_clock clock;\n    return (int)shaker2_programme_start(400, 1, &clock);",
}


def objects(folder: Path, part: str, files: Mapping[str, str], real: str, compiler: str) -> tuple[Path, Path]:
    """Objects of a part's source and of a caller that includes its header."""
    folder.mkdir()
    write({**stand_files(real), **files}, folder)
    source, made, caller = folder / f"shaker2_{part}.c", folder / "part.o", folder / "caller.o"
    (folder / "caller.c").write_text(f'#include "shaker2_{part}.h"\nint main(void)\n{{\n    {CALLERS[part]}\n}}\n')
    for each, to in ((source, made), (folder / "caller.c", caller)):
        compile_c(compiler, each, "-c", "-O2", "-o", to)
    return made, caller


def linked(compiler: str, *given: Path) -> str:
    """Messages of the linker."""
    command = [compiler, *map(str, given), "-Wl,--gc-sections", "-o", str(given[0].parent / "program")]
    return subprocess.run(command, capture_output=True, text=True, check=False, timeout=60).stderr


@pytest.mark.parametrize("compiler", quick(0, ["gcc", "clang"]))
def test_a_caller_of_another_servo_does_not_link(compiler: str, tmp_path: Path) -> None:
    """Another element type, and a servo with a trim, whose header declares other structs."""
    found = require(compiler, compiler)
    source, caller = objects(tmp_path / "spin", "servo", servos("spin").servo, "double", found)
    assert linked(found, source, caller) == ""
    for name, real, width in (("spin", "float", 32), ("trimmed", "double", 64)):
        _, other = objects(tmp_path / f"{name}_{real}", "servo", servos(name, real).servo, real, found)
        said = linked(found, source, other)
        assert re.search(rf"undefined (reference|symbol).*shaker2_servo_reset_f{width}_[0-9a-f]{{8}}", said), said


@pytest.mark.parametrize("compiler", quick(1, ["gcc", "clang"]))
def test_a_caller_of_another_programme_does_not_link(compiler: str, tmp_path: Path) -> None:
    """Another element type, and a programme with a run-up, whose header declares more."""
    found = require(compiler, compiler)
    source, caller = objects(tmp_path / "spin", "programme", programme("spin").files, "double", found)
    assert linked(found, source, caller) == ""
    for name, real, width in (("spin", "float", 32), ("started", "double", 64)):
        files = programme(name, real=real).files
        _, other = objects(tmp_path / f"{name}_{real}", "programme", files, real, found)
        said = linked(found, source, other)
        assert re.search(rf"undefined (reference|symbol).*shaker2_programme_start_f{width}_[0-9a-f]{{8}}", said), said


@pytest.mark.slow
def test_two_servos_lie_in_one_image(tmp_path: Path) -> None:
    """Names of one have its own name; each follows its own programme, and passes its self-test."""
    save_programme(spin(), tmp_path / "P.json")
    (tmp_path / "S.toml").write_text(HEAD + TRIM)
    motion_file = str(stands.path("shaker2").parent / "shaker2_spin.motion.json")
    command = ["export", "servo", str(stands.path("shaker2")), "--motion", motion_file]
    command += ["--programme", str(tmp_path / "P.json"), "--servo", str(tmp_path / "S.toml"), "-o", str(tmp_path / "D")]
    for name in ("lap", "rest", "lap"):  # again over its own files
        result = run(*command, "--name", name)
        assert result.exit_code == 0, result.output
    folder = tmp_path / "D"
    wanted = [f"{end}" for end in (".c", ".h", ".json", ".md", "_test.c")]
    assert sorted(path.name for path in folder.rglob("*.*")) == sorted(
        f"shaker2_{name}{part}"
        for name in ("lap", "rest")
        for part in (*wanted, *(f"_servo{end}" for end in (*wanted, "_main.c")))
    )
    for name, text in stand_files("double").items():
        (folder / name).write_text(text, encoding="ascii")
    (folder / "main.c").write_text("""#include "shaker2_lap.h"
#include "shaker2_lap_servo.h"
#include "shaker2_rest.h"
#include "shaker2_rest_servo.h"
int main(void)
{
    shaker2_lap_clock clock;
    shaker2_lap_servo_state one;
    shaker2_rest_servo_state other;
    shaker2_rest_trim_state trim;
    return (int)shaker2_lap_start(SHAKER2_LAP_SERVO_TICKS, SHAKER2_LAP_SERVO_PERIODS, &clock)
         + (int)shaker2_lap_servo_reset(&one) + (int)shaker2_rest_servo_reset(&other)
         + (int)shaker2_rest_trim_reset(&trim);
}
""")
    parts = [folder / f"shaker2_{name}{part}.c" for name in ("lap", "rest") for part in ("", "_servo")]
    compile_c(require("gcc", "gcc"), folder / "main.c", *parts, "-o", tmp_path / "image")
    run_program(tmp_path / "image")
    compile_c(
        "gcc",
        parts[1],
        "-DSHAKER2_LAP_SERVO_TEST_MAIN",
        folder / "verification/shaker2_lap_servo_test.c",
        "-o",
        tmp_path / "test",
    )
    assert run_program(tmp_path / "test").splitlines()[-1] == "failures 0"
    example = folder / "verification/shaker2_rest_servo_main.c"
    sources = (example, *parts[2:], folder / "shaker2.c")
    compile_c("gcc", *sources, "-DSHAKER2_REST_SERVO_MAIN", "-o", tmp_path / "example")
    assert "largest error of an angle" in run_program(tmp_path / "example")
    assert "--name forward: " in refused(*command, "--name", "forward")


def test_a_named_servo_has_the_text_of_the_unnamed_one() -> None:
    """Names apart, its source is the same."""
    named = export_servo(stand(), spin(), motion(), servo(TRIM), called="lap").servo["shaker2_lap_servo.c"]
    plain = servos("trimmed").servo["shaker2_servo.c"]
    assert re.sub(r"(?i)shaker2_lap_(servo|trim)", lambda m: m[0][:8] + m[1], named) == plain
