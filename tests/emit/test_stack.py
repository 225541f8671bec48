"""The stack that headers state: above what compilers take, and not far above."""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import cache
from pathlib import Path

import pytest

from emit.stands import stand, write
from mahovik.core.emit.generate import Generated, generate_all
from mahovik.core.program.function import Program
from mahovik.core.program.walk import called_names
from toolchain.tools import compile_c, require

LEVELS = ("-O1", "-O2", "-O3", "-Os")


def stated(header: str) -> dict[str, int]:
    """Read from a header how many bytes of stack each function needs."""
    bounds = re.findall(r"/\* (\w+): (?:(?!\*/).)*?Stack: at most (\d+) bytes\. \*/", header, re.DOTALL)
    return {name: int(size) for name, size in bounds}


def frames(listing: Path, prefix: str) -> Mapping[str, int]:
    """Read the frame of each function (bytes, by name without prefix): the largest clone, the sum of parts."""
    sizes: dict[str, int] = {}
    for line in listing.read_text().splitlines():
        place, size, kind = line.split("\t")
        assert kind in ("static", "dynamic,bounded"), line
        symbol, _, suffix = place.rpartition(":")[2].removeprefix(f"{prefix}_").partition(".")
        before = sizes.get(symbol, 0)
        sizes[symbol] = before + int(size) if "part" in suffix else max(before, int(size))
    return sizes


def chains(program: Program, taken: Mapping[str, int]) -> dict[str, int]:
    """Return the bytes along the deepest chain of calls from each function; an inlined function has no frame."""
    sizes: dict[str, int] = {}
    for f in program.functions:
        sizes[f.name] = taken.get(f.name, 0) + max((sizes[name] for name in called_names(f.body)), default=0)
    return sizes


def measured(program: Program, source: Path, compiler: str, level: str) -> dict[str, int]:
    """Stack of all functions of a source, by the compiler's frames."""
    made = source.parent / f"{source.stem}.o"
    compile_c(compiler, source, level, f"-D{program.name.upper()}_PLAIN_NAMES", "-fstack-usage", "-c", "-o", made)
    return chains(program, frames(made.with_suffix(".su"), program.name))


@cache
def generated(name: str, real: str) -> Generated:
    """Program and C of a stand."""
    return generate_all(stand(name), real)


@pytest.mark.slow
@pytest.mark.parametrize("compiler", ["gcc", "clang"])
@pytest.mark.parametrize(("name", "real"), [("demo3", "double"), ("everything6", "float")])
def test_bounds_hold_for_every_optimisation(name: str, real: str, compiler: str, tmp_path: Path) -> None:
    program = generated(name, real).program
    source = write(generated(name, real).files, tmp_path)
    bounds = stated(source.with_suffix(".h").read_text())
    assert bounds.keys() == {f.name for f in program.functions if f.public}
    for level in LEVELS:
        taken = measured(program, source, require(compiler, compiler), level)
        for function, bound in bounds.items():
            assert taken[function] <= bound, (level, function, taken[function])
