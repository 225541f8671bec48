"""The C of a servo: the interpreter's bits, strict compilers, no header of another stand; the example follows."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest

from emit.stands import write
from export.programmes import stand
from export.servos import exported, self_tested, written
from mahovik.core.emit.delivery import delivery
from toolchain.tools import compile_c, compile_elsewhere, require, run, symbols_of

MAIN = "verification/shaker2_servo_main.c"
slow = pytest.mark.slow
CASES = [
    pytest.param(("trimmed", "float"), id="trimmed-float"),
    pytest.param(("spin", "double"), id="spin-double", marks=slow),
    pytest.param(("trimmed", "double"), id="trimmed-double", marks=slow),
    pytest.param(("started", "float"), id="started-float", marks=slow),
]


@pytest.fixture(scope="module", params=CASES)
def source(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The C file of a servo, all that it includes beside it."""
    name, real = request.param
    return written(exported(name, real), tmp_path_factory.mktemp("-".join(request.param)), real)


def test_every_bit_is_the_interpreters(source: Path) -> None:
    lines = self_tested(source)
    assert lines[0].startswith("mahovik servo shaker2 structure ")
    trim = ["trim_run PASS wrong 0"] if "trim_step" in source.with_suffix(".h").read_text() else []
    assert lines[1:] == [
        "servo_step PASS cases 3 wrong 0",
        "servo_run PASS wrong 0",
        *trim,
        "refusals PASS wrong 0",
        "failures 0",
    ]


def test_clang_32_bits_and_bare_objects(source: Path, tmp_path: Path) -> None:
    compile_elsewhere(source)
    listed = symbols_of(source, tmp_path)
    assert {symbol for kind, symbol in listed if kind == "U"} <= {"memcpy", "memset"}
    assert {kind for kind, _ in listed} <= set("UTtRr")  # no data that could change
    header = source.with_suffix(".h").read_text()
    assert all(re.search(rf"\b{symbol}\b", header) for kind, symbol in listed if kind in "TR")


def test_the_example_follows(source: Path) -> None:
    folder = source.parent
    sources = [folder / f"shaker2{end}.c" for end in ("", "_programme")]
    compile_c("gcc", source, "-O0", "-DSHAKER2_SERVO_MAIN", *sources, folder / MAIN, "-o", folder / "main")
    done = subprocess.run([folder / "main"], capture_output=True, text=True, check=True, timeout=60)
    found = re.fullmatch(r"largest error of an angle (\d+) urad, torques cut in 0 samples\n", done.stdout)
    assert found is not None
    feedforward = "ahead" in (folder / MAIN).read_text()
    assert int(found[1]) < (300 if feedforward else 30_000)  # a turn in 50 ms


@pytest.mark.parametrize("pattern", ["*.c", "**/*.c"])
def test_all_c_of_a_delivered_folder_is_one_program(pattern: str, tmp_path: Path) -> None:
    """Arduino, PlatformIO and CubeIDE compile all that they find, at the top alone or below it as well."""
    write(
        {**delivery(stand(), batch=True), **exported("trimmed").programme.files, **exported("trimmed").servo}, tmp_path
    )
    sources = sorted(tmp_path.glob(pattern))
    assert len(sources) == (5 if pattern == "*.c" else 10)
    (tmp_path / "main.c").write_text("int main(void) { return 0; }\n")
    for compiler in ("gcc", "clang"):
        compile_c(require(compiler, compiler), tmp_path / "main.c", *sources, "-o", tmp_path / "program")
    run(tmp_path / "program")


@pytest.mark.parametrize("macro", ["STRUCTURE", "PHYSICS"])
def test_a_header_of_another_stand_is_refused(macro: str, tmp_path: Path) -> None:
    source = written(exported("spin"), tmp_path)
    header = tmp_path / "shaker2.h"
    header.write_text(re.sub(rf"({macro} +0x)[0-9a-f]{{8}}", r"\g<1>00000001", header.read_text()))
    with pytest.raises(AssertionError, match=r"shaker2_servo.h are of different stands"):
        compile_c(require("gcc", "gcc"), source, "-fsyntax-only")


def test_a_header_of_another_element_type_is_refused(tmp_path: Path) -> None:
    source = written(exported("spin"), tmp_path, "float")
    with pytest.raises(AssertionError, match="negative"):
        run(require("gcc", "gcc"), "-std=c99", "-fsyntax-only", source)


def test_the_self_test_finds_one_wrong_digit(tmp_path: Path) -> None:
    source = written(exported("trimmed", "float"), tmp_path, "float")
    text = source.read_text()
    for member, named in ((r"\.speed = \{ ", "servo_run"), (r"\.matrix = \{\s+\{\s+", "trim_run")):
        at = re.search(rf"{member}(-?[\d.]+)", text)
        assert at is not None
        number = at[1]
        changed = number[:-1] + ("1" if number[-1] != "1" else "2")
        source.write_text(text[: at.start(1)] + changed + text[at.end(1) :])
        assert f"{named} FAIL wrong 1" in self_tested(source)


def test_float_has_no_double_and_nothing_of_this_machine_is_in_it(tmp_path: Path) -> None:
    source = written(exported("trimmed", "float"), tmp_path, "float")
    text = re.sub(r"/\*.*?\*/", "", source.read_text(), flags=re.DOTALL)
    assert "double" not in text
    assert re.findall(r"(?<![\w.])\d+\.\d+(?:e[-+]?\d+)?(?![\dFe])", text) == []
    for text in exported("trimmed", "float").servo.values():
        assert not re.search(r"/(home|work|tmp|usr|root)/|20\d\d-\d\d", text)


def test_header_in_cpp(tmp_path: Path) -> None:
    written(exported("trimmed"), tmp_path)
    user = tmp_path / "user.cpp"
    user.write_text('#include "shaker2_servo.h"\n' * 2)
    flags = ("-std=c++17", "-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Werror", f"-I{tmp_path}")
    run(require("g++", "g++"), *flags, "-fsyntax-only", user)


def test_the_page_names_every_file_and_what_was_computed() -> None:
    made = exported("trimmed")
    page = made.servo["shaker2_servo.md"]
    assert all(name in page for name in made.servo if not name.endswith(".md"))
    assert all(line in page for line in made.lines)
    assert [line.partition(":")[0] for line in made.lines] == ["servo", "servo", "servo", "trim"]
