"""Instructions, stack, code and constants of every public function on a target."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mahovik.contract.quantities import TABLES
from mahovik.core.emit.generate import Generated, generate_all
from mahovik.core.emit.manifest import digest
from mahovik.core.emit.recorder import has_recorder, recorder_files
from mahovik.core.lower.test_inputs import Generator, draw, plan
from mahovik.core.program.function import Program
from mahovik.core.program.types import Kind, NamedCount, Struct
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand
from mahovik.core.toolchain.board import build, require, run, version
from mahovik.core.toolchain.callgrind import NATIVE, instructions_of_host
from mahovik.core.toolchain.compiler import BITS
from mahovik.core.toolchain.footprint import STACK_FLAGS, Footprint, footprint
from mahovik.core.toolchain.process import side_by_side
from mahovik.core.toolchain.targets import TARGETS, Target
from mahovik.core.toolchain.workload import Line, read, workload
from mahovik.errors import ToolchainError, UsageError
from mahovik.nearest import suggestion

STATES = 4
"""Number of states; the most expensive one is reported."""


def measuring_states(program: Program) -> list[dict[str, Any]]:
    """Arguments of the public functions by name, a dict a state: ordinary ones, no flywheel locked."""
    planned = plan(program)
    generator = Generator()
    found = [draw(planned, generator, program.precision) for _ in range(STATES)]
    for state in found:
        if "locked" in state:
            state["locked"] = [0] * len(state["locked"])
    return found


USUAL = (("m4", "float"), ("m7", "double"), ("rv32imafc", "float"), ("rv64gc", "double"))
"""Default targets: processors with an FPU, and the widest element type that it calculates with."""

_TIMEOUT = 300.0


@dataclass(frozen=True)
class FunctionCost:
    """Cost of one call.

    `instructions`: of the costliest state, 0 where the function refuses them all; `stack`: bytes over the call graph;
    `painted`: bytes found used on the emulator, 0 where there is no painted stack; `code`: bytes with what
    it calls; `routines`: called routines of the compiler's library, which `stack` and `code` leave out and the others
    do not.
    """

    function: str
    instructions: int
    stack: int
    painted: int
    code: int
    routines: tuple[str, ...]


@dataclass(frozen=True)
class TargetCost:
    """Cost of a stand's C on one target. `source`: SHA-256 of the measured .c; `text`: bytes of code of the whole file;
    `symbols`, `constants`: bytes of each function, of each table; `unnamed`: bytes of constants without a symbol;
    `flywheel`: bytes that one flywheel adds, by table.
    """

    target: str
    title: str
    real: str
    source: str
    compiler: str
    flags: str
    emulator: str
    functions: tuple[FunctionCost, ...]
    text: int
    symbols: dict[str, int]
    constants: dict[str, int]
    unnamed: int
    flywheel: dict[str, int]


@dataclass(frozen=True)
class Costs:
    """Cost of a stand's C on several targets."""

    stand: str
    structure: str
    physics: str
    flywheels: int
    targets: tuple[TargetCost, ...]


def parse_targets(names: str | None, real: str | None) -> list[tuple[Target, str]]:
    """Targets and element types of `--targets`, `--real`. Raises UsageError."""
    if names is None:
        return [(TARGETS[name], real or own) for name, own in USUAL]
    found = []
    for word in dict.fromkeys(word.strip() for word in names.split(",")):
        target = TARGETS.get(word)
        if target is None:
            raise UsageError(f'--targets: unknown "{word}"{suggestion(word, TARGETS)}')
        if target.linker or target.compiler[0] == "clang":
            raise UsageError(f"--targets: {word} compiles by clang; frames of the stack are known of gcc only")
        reals = (real,) if real else (target.real,) if target.real else ("double", "float")
        found += [(target, each) for each in reals]
    return found


def available(pairs: Sequence[tuple[Target, str]]) -> tuple[list[tuple[Target, str]], list[str]]:
    """Targets that can be measured here; for each of the others a line that says what to install.

    Raises ToolchainError where there is none.
    """
    found, absent = [], dict[str, str]()
    for target, real in pairs:
        try:
            require(target)
            found.append((target, real))
        except ToolchainError as error:
            absent[target.name] = str(error)
    if not found and absent:
        raise ToolchainError(next(iter(absent.values())))
    return found, list(absent.values())


def measure(
    stand: Stand,
    pairs: Sequence[tuple[Target, str]],
    progress: Callable[[int, int], None] | None = None,
    only: tuple[str, ...] = (),
) -> Costs:
    """Builds and runs the measuring program on each target; `only`: of C that has these public functions alone.

    Raises ToolchainError where a tool is missing.
    """
    for target, _ in pairs:
        require(target)
    made = {real: generate_all(stand, real, only=only) for real in dict.fromkeys(real for _, real in pairs)}
    names = identities(stand)
    found = []
    with side_by_side() as pool:
        tasks = [pool.submit(_measure_target, stand, made[real], target, real) for target, real in pairs]
        for done, task in enumerate(tasks):
            found.append(task.result())
            if progress is not None:
                progress(done + 1, len(pairs))
    return Costs(stand.name, names.structure, names.physics, len(stand.flywheels), tuple(found))


def _measure_target(stand: Stand, made: Generated, target: Target, real: str) -> TargetCost:
    states = measuring_states(made.program)
    with tempfile.TemporaryDirectory(prefix="mahovik-", ignore_cleanup_errors=True) as folder:
        scratch = Path(folder)
        log = has_recorder(made)
        files = {**made.files, **(recorder_files(stand, made) if log else {})}
        program = build(
            target, {**files, "workload.c": workload(made.program, states, log)}, scratch, extra=STACK_FLAGS
        )
        if target.name in NATIVE:
            programs = (workload(made.program, [state], log) for state in states)
            lines = [line for text in programs for line in instructions_of_host(target, files, text, scratch)]
        else:
            lines = read(run(target, program, _TIMEOUT))
        found = whole = footprint(target.compiler[0], scratch / f"{stand.name}.o")
        if log:
            whole = found.joined_with(footprint(target.compiler[0], scratch / f"{stand.name}_recorder.o"))
    functions = [_function(stand, whole, lines, name) for name in dict.fromkeys(line.function for line in lines)]
    named = sum(found.constants.values())
    return TargetCost(
        target=target.name,
        title=target.title,
        real=real,
        source=digest(made.files[f"{stand.name}.c"]),
        compiler=version(target.compiler[0]),
        flags=" ".join(("-std=c99", *target.compiler[1:], target.optimisation, *BITS)),
        emulator="" if not target.emulator else version(target.emulator[0]),
        functions=tuple(functions),
        text=found.text,
        symbols=dict(sorted(found.code.items())),
        constants=dict(sorted(found.constants.items())),
        unnamed=found.data - named,
        flywheel=_flywheel(made, 4 if real == "float" else 8),
    )


def _function(stand: Stand, found: Footprint, lines: Sequence[Line], name: str) -> FunctionCost:
    own = [line for line in lines if line.function == name]
    assert len(own) == STATES
    good = [line for line in own if line.status >= 0]
    symbol = f"{stand.name}_{name.partition('(')[0]}"
    return FunctionCost(
        function=name,
        instructions=max((round(line.instructions / line.calls) for line in good), default=0),
        stack=found.stack_of(symbol),
        painted=max(line.stack for line in own),
        code=found.code_of(symbol),
        routines=tuple(found.routines(symbol)),
    )


def _flywheel(made: Generated, width: int) -> dict[str, int]:
    """How many bytes one flywheel adds to each table of constants, by the table's C name without prefix."""
    tables = {row.struct: row.default for row in TABLES.values() if row.default}
    found = {}
    for struct in made.program.structs:
        if struct.name in tables and made.layout.flywheels:
            rows = (f for f in struct.fields if f.shape and f.shape[0] is made.layout.count)
            found[tables[struct.name]] = width * sum(_numbers(f.type, f.shape[1:]) for f in rows)
    return dict(sorted(found.items()))


def _numbers(type_: Kind | Struct, shape: tuple[int | NamedCount, ...]) -> int:
    """Reals in a value of that type."""
    count = 1
    for n in shape:
        count *= int(n)
    if isinstance(type_, Struct):
        return count * sum(_numbers(f.type, f.shape) for f in type_.fields)
    return count if type_ is Kind.REAL else 0
