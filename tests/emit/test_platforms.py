"""Emitted files on platforms that replace words by macros, or that compute with other numbers."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from cli.run import refused
from emit.stands import generated, stand, write
from export import programmes, servos
from mahovik import stands as examples
from mahovik.core.emit.batch import batch_files
from mahovik.core.emit.templates import folders
from toolchain.quick import quick
from toolchain.tools import require, run

MACROS = frozenset((Path(__file__).parent / "macros.txt").read_text().split("\n", 1)[1].split())
"""Macros of the C library and of <windows.h> with a small letter, or of at most three: by the command on line 1."""


def words(text: str) -> set[str]:
    """Words of C outside comments and strings."""
    return set(re.findall(r"[A-Za-z_]\w*", re.sub(r'/\*.*?\*/|"[^"\n]*"|<\w+\.h>', " ", text, flags=re.DOTALL)))


def headers() -> Iterator[tuple[str, str]]:
    """Name and text of emitted headers of every kind; of those that other tests emit their templates alone."""
    made = [generated(name).files for name in (*examples.names(), "everything6", "hung5", "held3")]
    made += [batch_files(stand(name), generated(name)) for name in ("everything6", "hung5")]
    made += [servos.exported(name).servo for name in ("trimmed", "swaying")]
    made.append(programmes.exported("spin").files)
    for files in made:
        yield from ((name, text) for name, text in files.items() if name.endswith(".h"))
    for template in (path for folder in folders() for path in folder.rglob("*.h*.j2") if ".html" not in path.name):
        text = re.sub(r"\[=.*?=\]|\[%.*?%\]", "x", template.read_text())
        yield template.name, re.sub(r"\b(bool|static_assert)\b", "", text) if ".hpp" in template.name else text


def test_no_word_of_a_header_is_a_macro() -> None:
    """After <windows.h> an empty macro `near` took a member out of a struct, and callers wrote the one beside it."""
    assert {"near", "far", "I", "min", "errno", "linux", "interface"} <= MACROS
    assert {(name, word) for name, text in headers() for word in words(text) & MACROS} == set()


@pytest.mark.slow
@pytest.mark.parametrize(("compiler", "flags"), quick(1, [("gcc", ("-std=c99",)), ("g++", ("-std=c++17",))]))
def test_structs_are_the_same_after_windows_h(compiler: str, flags: tuple[str, ...], tmp_path: Path) -> None:
    compiler = require(f"x86_64-w64-mingw32-{compiler}", f"{compiler}-mingw-w64-x86-64")
    for name in ("bench8", "everything6", "held3"):
        write(generated(name).files | batch_files(stand(name), generated(name)), tmp_path)
        user = tmp_path / "user.c"
        user.write_text(f'#include <winsock2.h>\n#include <windows.h>\n#include "{name}_batch.h"\n')
        run(compiler, *flags, "-Wall", "-Wextra", "-Werror", "-fsyntax-only", user)


def test_a_prefix_that_c_reserves_is_refused() -> None:
    for prefix in ("_X", "_x", "__x"):
        said = refused("generate", str(examples.path("demo3")), "--prefix", prefix)
        assert f'--prefix {prefix}: "{prefix}" begins with _' in said
