"""Cost of the emitted C on a processor: instructions, stack, code, constants of every public function.

COST.md tells it; it lies beside the C and is no part of its delivery: the manifest does not list it.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mahovik.core.emit.delivered import COST_PAGE, delivered_options, is_cost_page, manifest_of
from mahovik.core.emit.generate import Generated, generate_all
from mahovik.core.emit.manifest import digest
from mahovik.core.emit.recorder import recorder_files
from mahovik.core.emit.templates import template
from mahovik.core.lower.test_inputs import Generator, draw, plan
from mahovik.core.program.function import Program
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import identities
from mahovik.core.toolchain.compiler import BITS
from mahovik.core.toolchain.cost import NATIVE, STACK_FLAGS, footprint, instructions_of_host, read, workload
from mahovik.core.toolchain.process import side_by_side
from mahovik.core.toolchain.targets import TARGETS, Target, build, require, run, version
from mahovik.errors import ToolchainError, UsageError
from mahovik.proof.verify import selftest

STATES = 4
"""Number of states; the most expensive one is reported."""

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
    `constants`: bytes of each table; `unnamed`: bytes of constants without a symbol.
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
    constants: dict[str, int]
    unnamed: int

    @property
    def refused(self) -> bool:
        """Whether a function refuses all states."""
        return not all(f.instructions for f in self.functions)

    @property
    def routines(self) -> list[str]:
        """Called routines of the compiler's library."""
        return sorted({name for f in self.functions for name in f.routines})


@dataclass(frozen=True)
class Costs:
    """Cost of a stand's C on several targets."""

    stand: str
    structure: str
    physics: str
    targets: tuple[TargetCost, ...]


def parse_targets(names: str | None, real: str | None) -> list[tuple[Target, str]]:
    """Targets and element types by names and an element type. Raises UsageError."""
    if names is None:
        return [(TARGETS[name], real or usual) for name, usual in USUAL]
    pairs = selftest.parse_targets(names, (real,) if real else None)
    for target, _ in pairs:
        if target.linker or target.compiler[0] == "clang":
            raise UsageError(f"targets: {target.name} compiles by clang; frames of the stack are known of gcc only")
    return [(target, type_) for target, type_ in pairs if type_ == (real or target.real or type_)]


def available(pairs: Sequence[tuple[Target, str]]) -> tuple[list[tuple[Target, str]], list[str]]:
    """Targets that can be measured here; for each of the others a line that says what to install.

    Raises ToolchainError where there is none.
    """
    present, absent = [], dict[str, str]()
    for target, real in pairs:
        try:
            require(target)
            present.append((target, real))
        except ToolchainError as error:
            absent[target.name] = str(error)
    if not present and absent:
        raise ToolchainError(next(iter(absent.values())))
    return present, list(absent.values())


def measure(
    stand: Stand,
    pairs: Sequence[tuple[Target, str]],
    progress: Callable[[int, int], None] = lambda done, count: None,
    only: tuple[str, ...] | None = None,
    recorder: bool = False,
) -> Costs:
    """Builds and runs the measuring program on each target; `only`: of C that has these public functions alone.

    `recorder`: of the steps with a log as well.

    Raises ToolchainError where a tool is missing.
    """
    for target, _ in pairs:
        require(target)
    made = {real: generate_all(stand, real, only=only) for real in dict.fromkeys(real for _, real in pairs)}
    names, costs = identities(stand), []
    with side_by_side() as pool:
        tasks = [pool.submit(_measure_target, stand, made[real], target, real, recorder) for target, real in pairs]
        for done, task in enumerate(tasks, start=1):
            costs.append(task.result())
            progress(done, len(pairs))
    return Costs(stand.name, names.structure, names.physics, tuple(costs))


def measuring_states(program: Program) -> list[dict[str, Any]]:
    """Arguments of the public functions by name, a dict a state: ordinary ones, no flywheel locked."""
    planned, generator = plan(program), Generator()
    states = [draw(planned, generator, program.precision) for _ in range(STATES)]
    return [state | ({"locked": [0] * len(state["locked"])} if "locked" in state else {}) for state in states]


def _measure_target(stand: Stand, made: Generated, target: Target, real: str, log: bool) -> TargetCost:
    states = measuring_states(made.program)
    files = {**made.files, **(recorder_files(stand, made) if log else {})}
    with tempfile.TemporaryDirectory(prefix="mahovik-", ignore_cleanup_errors=True) as folder:
        scratch = Path(folder)
        main = workload(made.program, states, log)
        program = build(target, {**files, "workload.c": main}, scratch, extra=STACK_FLAGS)
        if target.name in NATIVE:
            programs = (workload(made.program, [state], log) for state in states)
            lines = [line for text in programs for line in instructions_of_host(target, files, text, scratch)]
        else:
            lines = read(run(target, program, _TIMEOUT))
        sizes = whole = footprint(target.compiler[0], scratch / f"{stand.name}.o")
        if log:
            whole = sizes.joined_with(footprint(target.compiler[0], scratch / f"{stand.name}_recorder.o"))
    functions = []
    for name in dict.fromkeys(line.function for line in lines):
        calls = [line for line in lines if line.function == name]
        symbol = f"{stand.name}_{name.partition('(')[0]}"
        functions.append(
            FunctionCost(
                function=name,
                instructions=max((round(c.instructions / c.calls) for c in calls if c.status >= 0), default=0),
                stack=whole.stack_of(symbol),
                painted=max(call.stack for call in calls),
                code=whole.code_of(symbol),
                routines=tuple(whole.routines(symbol)),
            )
        )
    return TargetCost(
        target=target.name,
        title=target.title,
        real=real,
        source=digest(made.files[f"{stand.name}.c"]),
        compiler=version(target.compiler[0]),
        flags=" ".join(("-std=c99", *target.compiler[1:], target.optimisation, *BITS)),
        emulator="" if not target.emulator else version(target.emulator[0]),
        functions=tuple(functions),
        text=sizes.text,
        constants=dict(sorted(sizes.constants.items())),
        unnamed=sizes.data - sum(sizes.constants.values()),
    )


def page(costs: Costs) -> str:
    """COST.md, the same text for the same figures."""
    sources = sorted({(target.real, target.source) for target in costs.targets})
    return template("cost.md.j2").render(costs=costs, states=STATES, sources=sources)


def require_place(folder: Path, stand: Stand) -> None:
    """Raises UsageError unless COST.md of a stand may be written into a folder.

    That is one that is new or empty, or that holds this stand's C as its file gives it; COST.md there must be ours.
    """
    options = delivered_options(folder)
    if options is not None:
        manifest_of(folder, stand)
        made, source = generate_all(stand, options.real, options.only).files, folder / f"{stand.name}.c"
        if not source.is_file() or source.read_bytes() != made[source.name].encode():
            raise UsageError(
                f"{folder}: holds other C than the stand file gives: `mahovik generate` first, nothing was written"
            )
    elif folder.is_dir() and any(path.name != COST_PAGE for path in folder.iterdir()):
        raise UsageError(
            f"{folder}: is neither empty nor a folder of `mahovik generate`: choose another, nothing was written"
        )
    if (folder / COST_PAGE).exists() and not is_cost_page(folder, stand):
        raise UsageError(
            f"{folder / COST_PAGE}: was not written by mahovik for {stand.name}: move it away or choose another "
            "folder, nothing was written"
        )
