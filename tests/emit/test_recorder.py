"""The emitted recorder under strict compilers: no warning, no library, little stack, a header for C++ as well."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from emit.stands import stand
from mahovik.core.emit.generate import generate_all
from mahovik.core.emit.recorder import RECORDED, recorder_files
from mahovik.core.toolchain.footprint import STACK_FLAGS, footprint
from toolchain.quick import quick
from toolchain.tools import compile_c, compile_elsewhere, require, run, symbols_of

CASES = [
    ("bench8", "double"),
    ("everything6", "float"),
    ("everything0", "double"),
    ("bare5", "float"),
    ("auv6", "double"),
]


@pytest.fixture(scope="module", params=CASES, ids="-".join)
def source(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The recorder's C file, all that it includes beside it."""
    name, real = request.param
    folder = tmp_path_factory.mktemp(name)
    generated = generate_all(stand(name), real)
    for file, text in (generated.files | recorder_files(stand(name), generated)).items():
        (folder / file).write_text(text, encoding="ascii")
    return folder / f"{name}_recorder.c"


def test_strict_warnings_and_bare_objects(source: Path, tmp_path: Path) -> None:
    name = source.stem.removesuffix("_recorder")
    listed = symbols_of(source, tmp_path)
    wanted = {symbol for kind, symbol in listed if kind == "U"}
    assert wanted <= {*(f"{name}_{step}" for step in RECORDED), "memcpy", "memset"}
    assert {kind for kind, _ in listed} <= set("UTtRr")  # no data that could change
    assert {symbol for kind, symbol in listed if kind == "T"} >= {f"{name}_recorder_start", f"{name}_recorder_step"}


def test_clang_and_32_bits(source: Path) -> None:
    compile_elsewhere(source)


def test_header_in_cpp(source: Path, tmp_path: Path) -> None:
    user = tmp_path / "user.cpp"
    user.write_text(f'#include "{source.stem}.h"\n' * 2)
    flags = ("-std=c++17", "-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Werror", f"-I{source.parent}")
    run(require("g++", "g++"), *flags, "-fsyntax-only", user)


@pytest.mark.slow
@pytest.mark.parametrize("optimisation", quick(1, ["-O2", "-O3", "-O1", "-Os"]))
def test_stack_is_as_the_header_says(optimisation: str, source: Path) -> None:
    """The frames of the recorder and of the steps, deepest chain; the bound is less than three times as large."""
    name, gcc = source.stem.removesuffix("_recorder"), require("gcc", "gcc")
    prints = []
    for file in (source, source.with_name(f"{name}.c")):
        made = file.with_suffix(".o")
        compile_c(gcc, file, optimisation, *STACK_FLAGS, "-c", "-o", made)
        prints.append(footprint("gcc", made))
    whole = prints[0].joined_with(prints[1])
    stated = re.findall(
        r"/\* (recorder_\w+): (?:(?!\*/).)*?Stack: at most (\d+) bytes", source.with_suffix(".h").read_text(), re.S
    )
    assert len(stated) >= 2
    for function, bound in stated:
        measured = whole.stack_of(f"{name}_{function}")
        assert measured <= int(bound) <= 3 * measured + 512, function


def test_the_real_must_be_that_of_the_header(source: Path, tmp_path: Path) -> None:
    """A recorder for double beside a header for float is refused by the compiler."""
    name = source.stem.removesuffix("_recorder")
    for file in source.parent.iterdir():
        if file.suffix in (".c", ".h"):
            text = file.read_text()
            if file.name == f"{name}.h":
                text = re.sub(rf"typedef \w+ {name}_real", f"typedef char {name}_real", text)
            (tmp_path / file.name).write_text(text)
    with pytest.raises(AssertionError, match="negative"):
        run(require("gcc", "gcc"), "-std=c99", "-fsyntax-only", tmp_path / source.name)
