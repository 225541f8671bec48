"""The C++ of docs/other-programs.md compiles without a warning and runs."""

from __future__ import annotations

import re
from pathlib import Path

from docs.pages import ROOT, blocks
from emit.stands import generated, stand, write
from mahovik.core.emit.cpp import cpp_header
from toolchain.tools import compile_c, require, run

PAGE = ROOT / "docs" / "other-programs.md"


def test_the_program(tmp_path: Path) -> None:
    made = generated("bench8")
    source = write({**made.files, **cpp_header(stand("bench8"), made)}, tmp_path)
    (program,) = (b.text for b in blocks(PAGE) if b.language == "cpp")
    user = tmp_path / "user.cpp"
    user.write_text(program)
    compile_c(require("gcc", "gcc"), source, "-O1", "-c", "-o", tmp_path / "stand.o")
    flags = ("-std=c++17", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow", "-Werror")
    run(require("g++", "g++"), *flags, user, tmp_path / "stand.o", "-o", tmp_path / "user")
    assert re.fullmatch(r"-?\d\S* m/s2\n", run(tmp_path / "user"))


def test_what_the_table_names_is_there() -> None:
    text = cpp_header(stand("bench8"), generated("bench8"))["bench8.hpp"]
    section = PAGE.read_text(encoding="utf-8").partition("\n## C++17\n")[2].partition("\n## ")[0]
    rows = [line.split("|")[2] for line in section.splitlines() if line.startswith("| ")][2:]
    named = {word for row in rows for word in re.findall(r"`(\w+)", row)}
    assert {"State", "Status", "N", "default_table", "array_of", "assign", "InverseResult", "Reals", "word"} <= named
    assert [word for word in named if not re.search(rf"\b{word}\b", text)] == []
