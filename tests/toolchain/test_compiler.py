"""The host's compiler and pools of programs; what tests share is taken only where making it again gives the same."""

from __future__ import annotations

import stat
import sys
import time
from collections.abc import Sequence
from concurrent.futures import Future
from dataclasses import replace
from pathlib import Path
from subprocess import CompletedProcess
from types import SimpleNamespace

import pytest

from emit.stands import generated, write
from mahovik.core.emit.generate import generate_all
from mahovik.core.program.function import Function
from mahovik.core.program.types import Field, Kind, Struct
from mahovik.core.stand import load
from mahovik.core.toolchain import library, process
from mahovik.core.toolchain.compiler import CANDIDATES, find_compiler, preprocess
from mahovik.core.toolchain.library import Library, load_compiled
from mahovik.errors import ToolchainError
from mahovik.proof.verify.backends import public_names
from mahovik.stands import path
from toolchain.generated_once import once

GOOD = "int answer(void);\nint answer(void) { return 42; }\n"
WARNINGS = {
    "conversion": "float half(double x);\nfloat half(double x) { return x / 2; }\n",
    "declared": "int f(void);\nint f(void) { int x = 1; return g(x); }\n",
    "c11": 'int f(void);\nint f(void) { _Static_assert(1, ""); return 1; }\n',
}


@pytest.fixture(autouse=True)
def uncached(monkeypatch: pytest.MonkeyPatch) -> None:
    """The compiler itself runs in these tests."""
    monkeypatch.setenv("MAHOVIK_CACHE", "")


def one_line(error: pytest.ExceptionInfo[ToolchainError]) -> str:
    """The message of an error, which is a single line."""
    text = str(error.value)
    assert "\n" not in text
    return text


@pytest.mark.parametrize(
    ("chosen", "message"),
    [
        (None, "no C compiler found"),
        ("no-such-cc -m32", "CC=no-such-cc -m32: no such command"),
        ("gcc '-O2", "CC=gcc '-O2: No closing quotation"),
        ("false", "false refused x.c: no message"),
    ],
)
def test_no_compiler(chosen: str | None, message: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """The error names what is missing and the package that has it; nothing is left behind."""
    if chosen is None:
        monkeypatch.delenv("CC", raising=False)
        monkeypatch.setenv("PATH", str(tmp_path / "nothing"))
    else:
        monkeypatch.setenv("CC", chosen)
    source = tmp_path / "x.c"
    source.write_text(GOOD)
    with pytest.raises(ToolchainError) as error:
        load_compiled(source, (), str)
    assert one_line(error).startswith(message)
    assert ("apt-get install gcc" in str(error.value)) == (chosen is None)


def test_cc_that_cannot_be_run(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    broken = tmp_path / "broken-cc"
    broken.write_bytes(b"\x7fELF no program")
    broken.chmod(0o755)
    monkeypatch.setenv("CC", str(broken))
    source = tmp_path / "x.c"
    source.write_text(GOOD)
    with pytest.raises(ToolchainError) as error:
        load_compiled(source, (), str)
    assert one_line(error) == f"{broken} cannot be run: Exec format error"


@pytest.mark.parametrize("name", CANDIDATES)
def test_the_first_compiler_there_is(name: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.delenv("CC", raising=False)
    monkeypatch.setenv("PATH", str(tmp_path))
    for candidate in CANDIDATES[CANDIDATES.index(name) :]:
        fake = tmp_path / candidate
        fake.write_text("#!/bin/sh\nexit 0\n")
        fake.chmod(fake.stat().st_mode | stat.S_IXUSR)
    assert find_compiler() == [name]
    monkeypatch.setenv("CC", "")  # empty is as good as none
    assert find_compiler() == [name]


@pytest.mark.parametrize("text", WARNINGS.values(), ids=WARNINGS)
def test_a_warning_is_refused(text: str, tmp_path: Path) -> None:
    source = tmp_path / "warned.c"
    source.write_text(text)
    with pytest.raises(ToolchainError) as error:
        load_compiled(source, (), str)
    assert "refused warned.c: " in one_line(error)
    assert "error" in one_line(error)


def test_headers_lose_their_directives(tmp_path: Path) -> None:
    source = write(generated("bench8").files, tmp_path)
    text = preprocess(source.with_suffix(".h"), "-DBENCH8_PLAIN_NAMES")
    assert "#" not in text
    assert "/*" not in text
    assert "bench8_forward(" in text
    assert "BENCH8_W1" in text


def test_arguments_and_members_that_differ_are_named(tmp_path: Path) -> None:
    made = generated("demo3")
    source = write(made.files, tmp_path)
    library = Library(source, "demo3")
    public = [made.program.function(name) for name in public_names(made.program)]
    assert library.difference(public) is None
    step: Function = made.program.function("step")
    assert library.difference([replace(step, arguments=step.arguments[:-1])]) == (
        f"demo3_step takes {len(step.arguments)} arguments, expected {len(step.arguments) - 1}"
    )
    state = next(a for a in step.arguments if a.name == "x")
    assert isinstance(state.type, Struct)
    longer = replace(state.type, fields=(*state.type.fields, Field("time", Kind.REAL)))
    other = replace(step, arguments=tuple(replace(a, type=longer) if a is state else a for a in step.arguments))
    assert library.difference([other]) == "demo3_state: member missing, expected time"


FLAGS = ("-ffp-contract=off", "-O2")


def test_whatever_the_compiler_sees_is_in_the_key(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("MAHOVIK_CACHE", str(tmp_path / "cache"))
    made: list[str] = []

    def compile_nothing(command: Sequence[str], what: str) -> None:
        made.append(what)
        Path(command[-1]).write_text(str(len(made)), encoding="ascii")

    monkeypatch.setattr(library, "run_compiler", compile_nothing)

    def built(source: str = "int x;\n", header: str = "", flags: Sequence[str] = FLAGS) -> str:
        (tmp_path / "x.h").write_text(header, encoding="ascii")
        (tmp_path / "x.c").write_text(source, encoding="ascii")
        return library.load_compiled(tmp_path / "x.c", flags, lambda file: Path(file).read_text(encoding="ascii"))

    libraries = [built(), built("int y;\n"), built(header="int z;\n"), built(flags=("-O0",))]
    monkeypatch.setenv("CC", "gcc -g0")
    libraries += [built()]
    assert len(set(libraries)) == len(made) == 5
    assert built() == libraries[4]


def test_equal_arguments_are_made_once() -> None:
    calls: list[tuple[int, str]] = []

    def make(number: int, *, name: str = "") -> SimpleNamespace:
        calls.append((number, name))
        return SimpleNamespace(number=number)

    made = once(make)
    assert made(1).number == made(1).number == 1
    assert (made(2).number, made(1, name="x").number) == (2, 1)
    assert calls == [(1, ""), (2, ""), (1, "x")]


def test_generated_files_are_the_caller_s_own() -> None:
    demo3 = load(path("demo3"))
    right = generate_all(demo3).files["demo3.c"]
    generate_all(demo3).files["demo3.c"] = "tampered with"
    assert generate_all(demo3).files["demo3.c"] == right


PATIENT = (sys.executable, "-c", "import time; time.sleep(60)")


def until_running(count: int) -> None:
    end = time.monotonic() + 30.0
    while len(process._running) < count:
        assert time.monotonic() < end
        time.sleep(0.01)


def inside() -> CompletedProcess[str]:
    """A pool of its own in a thread of a pool."""
    with process.side_by_side() as pool:
        return pool.submit(process.run, PATIENT).result()


def test_programs_of_pools_inside_are_ended() -> None:
    begin = time.monotonic()
    futures: list[Future[CompletedProcess[str]]] = []
    with pytest.raises(KeyboardInterrupt), process.side_by_side() as pool:
        futures.append(pool.submit(inside))
        until_running(1)
        raise KeyboardInterrupt
    assert time.monotonic() - begin < 30.0
    assert futures[0].result().returncode != 0
    assert process._running == {}
