"""The host's compiler: found, missing, refusing; warnings are errors; errors are one line."""

import os
import stat
from dataclasses import replace
from pathlib import Path

import pytest

from emit.stands import generated, stand, write
from mahovik.core.program.function import Function
from mahovik.core.program.types import Field, Kind, Struct
from mahovik.core.toolchain import compiler
from mahovik.core.toolchain.compiler import CANDIDATES, build_shared, find_compiler, preprocess
from mahovik.core.toolchain.library import Library
from mahovik.errors import ToolchainError
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.program_backend import public_names
from toolchain import build_cache
from toolchain.tools import require

GOOD = "int answer(void);\nint answer(void) { return 42; }\n"
WARNINGS = {
    "unused": "static int unused(void) { return 1; }\n",
    "conversion": "float half(double x);\nfloat half(double x) { return x / 2; }\n",
    "fallthrough": "int f(int x);\nint f(int x) { if (x); return x; }\n",
    "declared": "int f(void);\nint f(void) { int x = 1; return g(x); }\n",
    "c11": 'int f(void);\nint f(void) { _Static_assert(1, ""); return 1; }\n',
}


@pytest.fixture(autouse=True)
def uncached(monkeypatch: pytest.MonkeyPatch) -> None:
    """The compiler itself runs in these tests."""
    monkeypatch.setattr(compiler, "_build", build_cache.PLAIN)


@pytest.fixture
def no_tools(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """A PATH without any compiler."""
    monkeypatch.delenv("CC", raising=False)
    monkeypatch.setenv("PATH", str(tmp_path / "nothing"))


def one_line(error: pytest.ExceptionInfo[ToolchainError]) -> str:
    """The message of an error, which is a single line."""
    text = str(error.value)
    assert "\n" not in text
    return text


def test_no_compiler(no_tools: None, tmp_path: Path) -> None:
    with pytest.raises(ToolchainError) as error:
        find_compiler()
    text = one_line(error)
    assert "no C compiler found" in text
    assert "apt-get install gcc" in text
    source = tmp_path / "x.c"
    source.write_text(GOOD)
    with pytest.raises(ToolchainError, match="apt-get install gcc"):
        build_shared(source, tmp_path / "x.so")
    assert not (tmp_path / "x.so").exists()


def test_verification_without_a_compiler(no_tools: None) -> None:
    with pytest.raises(ToolchainError, match="apt-get install gcc"):
        CBackend(stand("demo3"))


@pytest.mark.parametrize("chosen", ["no-such-cc", "no-such-cc -m32", "/no/such/cc"])
def test_cc_that_is_none(chosen: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CC", chosen)
    with pytest.raises(ToolchainError) as error:
        find_compiler()
    assert one_line(error).startswith(f"CC={chosen}: no such command")


def test_cc_that_cannot_be_read(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CC", "gcc '-O2")
    with pytest.raises(ToolchainError) as error:
        find_compiler()
    assert one_line(error) == "CC=gcc '-O2: No closing quotation"


def test_cc_that_cannot_be_run(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    broken = tmp_path / "broken-cc"
    broken.write_bytes(b"\x7fELF no program")
    broken.chmod(0o755)
    monkeypatch.setenv("CC", str(broken))
    source = tmp_path / "x.c"
    source.write_text(GOOD)
    with pytest.raises(ToolchainError) as error:
        build_shared(source, tmp_path / "x.so")
    assert one_line(error) == f"{broken} cannot be run: Exec format error"


def test_a_compiler_whose_words_are_no_utf_8(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    odd = tmp_path / "odd-cc"
    odd.write_bytes(b"#!/bin/sh\nprintf 'x.c:1: error: \\351t\\351\\n' >&2\nexit 1\n")
    odd.chmod(0o755)
    monkeypatch.setenv("CC", str(odd))
    with pytest.raises(ToolchainError) as error:
        preprocess(tmp_path / "x.h")
    assert "x.c:1: error: " in one_line(error)


def test_cc_with_options_is_split(monkeypatch: pytest.MonkeyPatch) -> None:
    require("gcc", "gcc")
    monkeypatch.setenv("CC", "  gcc -g0 ")
    assert find_compiler() == ["gcc", "-g0"]


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
        build_shared(source, tmp_path / "warned.so")
    assert "refused warned.c: " in one_line(error)
    assert "error" in one_line(error)
    assert not (tmp_path / "warned.so").exists()


def test_a_compiler_that_says_nothing(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("CC", "false")
    source = tmp_path / "x.c"
    source.write_text(GOOD)
    with pytest.raises(ToolchainError) as error:
        build_shared(source, tmp_path / "x.so")
    assert one_line(error) == "false refused x.c: no message"


def test_good_c_in_a_folder_with_a_blank(tmp_path: Path) -> None:
    folder = tmp_path / "a folder; with 'signs'"
    folder.mkdir()
    source = folder / "x.c"
    source.write_text(GOOD)
    build_shared(source, folder / "x.so")
    assert (folder / "x.so").stat().st_size > 0


def test_headers_lose_their_directives(tmp_path: Path) -> None:
    source = write(generated("bench8").files, tmp_path)
    text = preprocess(source.with_suffix(".h"), "-DBENCH8_PLAIN_NAMES")
    assert "#" not in text
    assert "/*" not in text
    assert "bench8_forward(" in text
    assert "BENCH8_W1" in text


def test_a_header_that_is_missing(tmp_path: Path) -> None:
    with pytest.raises(ToolchainError) as error:
        preprocess(tmp_path / "none.h")
    assert "refused none.h" in one_line(error)


def test_a_library_whose_header_is_no_declaration(tmp_path: Path) -> None:
    (tmp_path / "x.h").write_text("int answer(void);\n__extension__ typedef __typeof__(1) odd;\n")
    source = tmp_path / "x.c"
    source.write_text(f'#include "x.h"\n{GOOD}')
    with pytest.raises(ToolchainError, match=r"x\.h cannot be read as declarations"):
        Library(tmp_path / "x.h", source, tmp_path, "x")


def test_a_library_without_the_constant(tmp_path: Path) -> None:
    (tmp_path / "x.h").write_text("int answer(void);\n")
    source = tmp_path / "x.c"
    source.write_text(f'#include "x.h"\n{GOOD}')
    library = Library(tmp_path / "x.h", source, tmp_path, "x")
    assert not library.has("forward")
    with pytest.raises(ToolchainError, match="the C has no constant x_default"):
        library.default("default")


def test_nothing_is_left_in_the_working_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "source"
    folder.mkdir()
    source = write(generated("demo3").files, folder)
    here = tmp_path / "here"
    here.mkdir()
    monkeypatch.chdir(here)
    library = Library(source.with_suffix(".h"), source, tmp_path, "demo3")
    assert library.has("forward")
    assert os.listdir(here) == []
    assert sorted(os.listdir(folder)) == ["demo3.c", "demo3.h"]


def test_arguments_and_members_that_differ_are_named(tmp_path: Path) -> None:
    made = generated("demo3")
    source = write(made.files, tmp_path)
    library = Library(source.with_suffix(".h"), source, tmp_path, "demo3")
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
