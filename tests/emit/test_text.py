"""The text of emitted files as a reader and a careful reviewer see it."""

import re
import socket
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from emit.stands import AIR, HELD, generated, other_numbers, stand
from mahovik.contract.status import STATUS_VALUES
from mahovik.core.emit.batch import batch_files
from mahovik.core.emit.generate import generate, generate_all
from mahovik.core.emit.layout import WIDTH
from mahovik.core.emit.readme import readme
from mahovik.core.program.simplify import loops_of_no_turn
from mahovik.core.stand.random import random_stand
from mahovik.core.stand.structure import structure
from toolchain.quick import quick

COMMENT = re.compile(r"/\*.*?\*/", re.S)
TABLES = "/* ---- tables ---- */"


@pytest.fixture(scope="module", params=("demo3", "sat4", "everything6", "hung5", "held3", "bare0"))
def files(request: pytest.FixtureRequest) -> dict[str, str]:
    """File name to text of a stand."""
    return generated(request.param).files


def code_of(text: str) -> str:
    """The text without its comments and strings."""
    return re.sub(r'"[^"\n]*"', '""', COMMENT.sub(" ", text))


def test_no_function_of_a_library(files: dict[str, str]) -> None:
    header, source = files.values()
    called = set(re.findall(r"\b(\w+)\(", code_of(source)))
    name = next(iter(files)).removesuffix(".h")
    hook = f"{name.upper()}_SQRT"
    words = {"if", "for", "return", "real", "__asm__", "__attribute__", hook}
    assert {c for c in called if not c.startswith(f"{name}_")} <= words
    allowed = {"__attribute__((noinline))", "__attribute__((always_inline))"}
    assert set(re.findall(r"__attribute__.*", source)) <= allowed
    standard = [f"#include <{include}.h>" for include in ("stddef", "stdint", "float", "limits")]
    assert re.findall(r"#include .*", source) == [f'#include "{name}.h"', *standard]
    assert re.findall(r"#include .*", header) == []
    assert not re.search(r"\b(goto|while|static\s+\w+\s+\w+\s*=|malloc|volatile|long double)\b", code_of(source))


def test_contracts_name_arguments_statuses_and_cost(files: dict[str, str]) -> None:
    header = next(iter(files.values()))
    name = next(iter(files)).removesuffix(".h")
    for f in generated(name).program.functions:
        if f.public:
            start = header.index(f"/* {f.name}: ")
            comment = " ".join(header[start : header.index("*/", start)].replace("\n *", " ").split())
            for a in f.arguments:
                assert re.search(rf"\b{a.name}\b", comment), (f.name, a.name)
            due = [*f.statuses, *(() if "BAD_ARGUMENT" in f.statuses else ("BAD_ARGUMENT",))]  # a null pointer
            assert set(due) <= set(STATUS_VALUES), f.name
            assert f"Returns {', '.join(due)}." in comment
            assert re.search(r"(At most \d+ operations|No operation) on reals", comment), f.name


def test_no_place_no_host_no_date(files: dict[str, str]) -> None:
    root = str(Path(__file__).resolve().parents[2])
    for text in files.values():
        for secret in (root, str(Path.home()) + "/", "/tmp", socket.gethostname()):
            assert secret not in text
        for comment in COMMENT.findall(text):
            assert not re.search(r"\b(19|20)\d\d-\d|\d\d:\d\d|\b(Jan|Mon)\b", comment), comment


def without_numbers(text: str, name: str) -> str:
    """The text up to its tables, its identities masked."""
    return re.sub(
        rf"(0x|structure |physics |{name}_|_f\d\d_)[0-9a-f]{{8}}(?=u?\b)",
        r"\1########",
        text.split(TABLES, maxsplit=1)[0],
    )


@pytest.mark.parametrize("name", quick(1, ["hung5", "everything6", "wet7"]))
def test_structure_decides_the_text(name: str) -> None:
    example = stand(name)
    other = other_numbers(example, np.random.default_rng(8))
    assert structure(example) == structure(other)
    assert example != other
    ours, theirs = generated(name).files, generate(other)
    for file, text in ours.items():
        assert without_numbers(text, name) == without_numbers(theirs[file], name)
    assert ours[f"{name}.c"] != theirs[f"{name}.c"]
    # the members of the tables are the same as well: only numbers, and the room they take, differ
    assert masked_tables(ours[f"{name}.c"]) == masked_tables(theirs[f"{name}.c"])


def masked_tables(text: str) -> str:
    """The tables without numbers and blanks."""
    return re.sub(r"\s+", "", re.sub(r"-?\b\d+\.\d+(e[-+]?\d+)?\b|-?\b\d+\.\d+e\d+\b", "#", text.split(TABLES)[1]))


@pytest.mark.parametrize(
    ("flywheels", "held"), quick(2, [(0, False), (1, True), (0, True), (1, False), (2, False), (2, True)])
)
def test_few_flywheels_leave_no_idle_loop_or_operation(flywheels: int, held: bool) -> None:
    """MISRA C:2012, rule 2.2, with tasks of one row; one flywheel leaves nothing between two of them."""
    example = random_stand(np.random.default_rng(3), flywheels, AIR if held else replace(AIR, tasks=2), "few")
    one = HELD["hinge5"][2]
    made = generate_all(replace(example, hold=one) if held else example)
    assert [f.name for f in made.program.functions if any(loops_of_no_turn(f.body))] == []
    idle = re.compile(r"(?<![\w.])[01] \* | [+-] 0(?![.\w])| \* [01](?![.\w])")
    assert [line for line in code_of(made.files["few.c"]).splitlines() if idle.search(line)] == []


@pytest.mark.parametrize(("name", "twist"), [("wet7", "V_r"), ("channel1", "V"), ("demo3", "V")])
def test_headers_say_the_equation_in_the_twist_that_it_takes_within_the_width_of_a_line(name: str, twist: str) -> None:
    """Added mass in a stream takes V_r, where V_dot stays that of V; names of stands have at most 8 letters."""
    example, made = stand(name), generated(name)
    header, page = made.files[f"{name}.h"], readme(example, made)
    for text in (header, page):
        assert f"K {twist}_dot + M {twist}" in text
        assert ("V_r_dot" in text) == bool(example.stream or example.profile)
        assert not re.search(r"\bK V_dot\b|\bM V\b", text) or twist == "V"
    texts = (header, made.files[f"{name}.c"], *batch_files(example, made).values())
    assert max(len(line) for text in texts for line in text.splitlines()) <= WIDTH
