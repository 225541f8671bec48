"""The first output in which a target differs from the golden vectors, by name."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator, Mapping
from pathlib import Path

from mahovik.core.lower.golden import CASES, FAR
from mahovik.core.program.function import Function, Program
from mahovik.core.program.types import Kind, NamedCount, Struct
from mahovik.core.toolchain.board import build, difference_main, run, selftest_flags
from mahovik.core.toolchain.targets import Target
from mahovik.errors import ToolchainError


def first_difference(target: Target, program: Program, files: Mapping[str, str], timeout: float) -> str:
    """`forward, V_dot[2], case "ordinary", 3 ulp`; "" where no listed output differs or the target does not run.

    `files` are the delivered C and self-test.
    """
    test = f"{program.name}_selftest.c"
    sources = {name: text for name, text in files.items() if name not in ("main.c", test)}
    sources["main.c"] = difference_main(program.name)
    with tempfile.TemporaryDirectory(prefix="mahovik-", ignore_cleanup_errors=True) as scratch:
        (Path(scratch) / test).write_text(files[test], encoding="utf-8")  # main.c includes it
        try:
            printed = run(target, build(target, sources, Path(scratch), extra=selftest_flags(program.name)), timeout)
        except ToolchainError:
            return ""
    for line in printed.splitlines():
        name, case, number, ulp = line.split()
        distance = f"more than {FAR}" if int(ulp) > FAR else ulp
        outputs = list(output_names(program.function(name)))
        return f'{name}, {outputs[int(number)]}, case "{CASES[int(case)]}", {distance} ulp'
    return ""


def output_names(function: Function) -> Iterator[str]:
    """Names of the reals that a function gives, in the order in which the self-test takes them."""
    for a in sorted(function.arguments, key=lambda a: a.direction != "inout"):
        if a.direction != "in":
            yield from _names(a.name, a.type, a.shape)
    if function.returns is Kind.REAL:
        yield "value"


def _names(name: str, type_: Kind | Struct, shape: tuple[int | NamedCount, ...]) -> Iterator[str]:
    if shape:
        for i in range(int(shape[0])):
            yield from _names(f"{name}[{i}]", type_, shape[1:])
    elif isinstance(type_, Struct):
        for f in type_.fields:
            yield from _names(f"{name}.{f.name}", f.type, f.shape)
    elif type_ is Kind.REAL:
        yield name
