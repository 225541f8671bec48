"""Emitted files on platforms that replace words by macros, or that compute with other numbers."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest

from cli.run import refused
from emit.stands import generated, stand, write
from export import programmes, servos
from mahovik import stands as examples
from mahovik.core.emit.batch import batch_files
from mahovik.core.emit.delivery import selftest_files
from mahovik.core.emit.generate import generate
from mahovik.core.emit.recorder import recorder_files
from mahovik.core.emit.templates import folders
from mahovik.core.stand.stand_file import loads
from mahovik.errors import StandError
from mahovik.out.export.fmu import export_fmu
from mahovik.proof.verify.selftest import problems, read_log
from toolchain.quick import quick
from toolchain.tools import require, require_32_bit, run

MACROS = frozenset((Path(__file__).parent / "macros.txt").read_text().split("\n", 1)[1].split())
"""Macros of the C library and of <windows.h> with a small letter, or of at most three: by the command on line 1."""


def words(text: str) -> set[str]:
    """Words of C outside comments and strings."""
    return set(re.findall(r"[A-Za-z_]\w*", re.sub(r'/\*.*?\*/|"[^"\n]*"|<\w+\.h>', " ", text, flags=re.DOTALL)))


def headers() -> Iterator[tuple[str, str]]:
    """Name and text of emitted headers of every kind; of those that other tests emit their templates alone."""
    made = [generated(name).files for name in ("sat4", "everything6", "held3")]
    made.append(batch_files(stand("everything6"), generated("everything6")))
    made += [servos.exported(name).servo for name in ("trimmed", "swaying")]
    made.append(programmes.exported("spin").files)
    for files in made:
        yield from ((name, text) for name, text in files.items() if name.endswith(".h"))
    for template in (path for folder in folders() for path in folder.rglob("*.h.j2")):
        yield template.name, re.sub(r"\[=.*?=\]|\[%.*?%\]", "x", template.read_text())


@pytest.mark.slow
def test_no_word_of_a_header_is_a_macro() -> None:
    """After <windows.h> an empty macro `near` took a member out of a struct, and callers wrote the one beside it."""
    assert {"near", "far", "I", "min", "errno", "linux", "interface"} <= MACROS
    keywords = {"static_assert"}  # of C++, in the block of Basilisk
    assert {(name, word) for name, text in headers() for word in words(text) & MACROS - keywords} == set()


@pytest.mark.slow
@pytest.mark.parametrize(("compiler", "flags"), quick(1, [("gcc", ("-std=c99",)), ("g++", ("-std=c++17",))]))
def test_structs_are_the_same_after_windows_h(compiler: str, flags: tuple[str, ...], tmp_path: Path) -> None:
    compiler = require(f"x86_64-w64-mingw32-{compiler}", f"{compiler}-mingw-w64-x86-64")
    for name in ("bench8", "everything6", "held3"):
        write(generated(name).files | batch_files(stand(name), generated(name)), tmp_path)
        user = tmp_path / "user.c"
        user.write_text(f'#include <winsock2.h>\n#include <windows.h>\n#include "{name}_batch.h"\n')
        run(compiler, *flags, "-Wall", "-Wextra", "-Werror", "-fsyntax-only", user)


def test_names_of_the_file_may_be_macros(tmp_path: Path) -> None:
    """Bodies called as macros of C are enumerators with the stand's name before them."""
    text = examples.path("demo3").read_text().replace('"demo3"', '"linux"')
    for name, macro in zip(("w1", "w2", "w3"), ("I", "NULL", "errno"), strict=True):
        text = text.replace(f'"{name}"', f'"{macro}"')
    write(generate(loads(text + '[[point]]\nname = "near"\nposition = [0.1, 0, 0]\n')), tmp_path)
    user = tmp_path / "user.c"
    heads = "#include <complex.h>\n#include <errno.h>\n#define near\n"
    user.write_text(f'{heads}#include "linux.h"\nint at = LINUX_NULL;\n')
    for command in (("gcc", "-std=c99", tmp_path / "linux.c"), ("gcc", "-std=gnu17"), ("g++", "-std=c++17", "-xc++")):
        run(*command, "-Wall", "-Wextra", "-Werror", "-fsyntax-only", user)


def test_a_prefix_that_c_reserves_is_refused() -> None:
    for prefix in ("_X", "_x", "__x"):
        said = refused("generate", str(examples.path("demo3")), "--prefix", prefix)
        assert f'--prefix {prefix}: "{prefix}" begins with _' in said
    text = examples.path("demo3").read_text().replace('name = "demo3"', 'name = "_demo3"')
    with pytest.raises(StandError, match='name: "_demo3" begins with _'):
        loads(text)


@pytest.fixture(scope="module")
def sources(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    """Every kind of source that computes, beside its headers."""
    folder = tmp_path_factory.mktemp("sources")
    made = generated("shaker2")
    write(made.files | batch_files(stand("shaker2"), made) | recorder_files(stand("shaker2"), made), folder)
    write(servos.exported("trimmed").servo | programmes.exported("spin").files, folder)
    fmu = export_fmu(stand("shaker2"), "cs", "torque", binary=False, generated=made).files
    write(
        {Path(name).name: text for name, text in fmu.items() if isinstance(text, str) and name.endswith((".c", ".h"))},
        folder,
    )
    return sorted(path for path in folder.rglob("*.c") if not path.stem.endswith(("_test", "_main", "_fmi2")))


@pytest.mark.parametrize(
    ("flags", "words"),
    [
        (("-m32", "-std=gnu11", "-O2"), "wrong results: x87 keeps more digits"),
        (("-U__DBL_MANT_DIG__", "-D__DBL_MANT_DIG__=24"), "wrong results: shaker2 needs a double of 64 bits"),
        (("-U__FLT_RADIX__", "-D__FLT_RADIX__=16"), "wrong results: shaker2 needs a double of 64 bits"),
        (("-U__INT_MAX__", "-D__INT_MAX__=32767"), "wrong counts: shaker2 needs an int of 32 bits"),
    ],
)
def test_other_numbers_are_refused(flags: tuple[str, ...], words: str, sources: list[Path]) -> None:
    names = {path.stem.removeprefix("shaker2") for path in sources}
    assert names >= {"", "_batch", "_recorder", "_servo", "_programme", "_model"}
    for source in sources:
        done = subprocess.run(
            [require_32_bit(), *flags, "-fsyntax-only", source], capture_output=True, text=True, check=False
        )
        assert f'#error "{words}' in done.stderr, source.name


@pytest.mark.slow
def test_the_first_line_of_the_self_test_tells_x87(tmp_path: Path) -> None:
    made = generated("demo3")
    write(made.files | selftest_files(stand("demo3"), made), tmp_path)
    files, program = (tmp_path / "demo3.c", tmp_path / "verification/demo3_selftest.c"), tmp_path / "selftest"
    defined = ("-DDEMO3_ALLOW_FAST_MATH", "-DDEMO3_SELFTEST_MAIN")
    run(require_32_bit(), "-m32", "-mno-sse", "-std=gnu11", "-O2", "-w", *defined, *files, "-o", program)
    printed = subprocess.run([program], capture_output=True, text=True, check=False, timeout=60).stdout
    first = "wrong results: compiled with x87 arithmetic, without -msse2 -mfpmath=sse"
    assert printed.splitlines()[0] == first
    assert problems(read_log(printed, "selftest")[0])[0] == first
