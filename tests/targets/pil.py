"""Processor in the loop: a program with servos and the stand that they drive, which may have other numbers."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import partial

from mahovik.core.emit.generate import generate_all
from mahovik.core.emit.literal import initialiser, real_literal
from mahovik.core.emit.servo import ServoPrinter
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import identities
from mahovik.out.export.servo import ExportedServo
from targets import programs

_COUNT = re.compile(r"(# )?(.+?) (\d+)")


@dataclass(frozen=True)
class Run:
    """Output of a board.

    torques    one line per sample: the bits
    followed   largest error of an angle in the last quarter, rad
    limited    samples with a torque cut
    counts     the board's own, by what they count
    """

    torques: tuple[str, ...]
    followed: float
    limited: int
    counts: dict[str, int]


def processor_in_the_loop(stand: Stand, real_stand: Stand, made: ExportedServo, samples: int) -> dict[str, str]:
    """C texts by file name for `targets.build`: servos made for `stand` against `real_stand`, of the same structure."""
    assert identities(stand).structure == identities(real_stand).structure
    precision = made.program.precision
    generated, other = generate_all(stand, precision.name), generate_all(real_stand, precision.name)
    words = "as its file says" if real_stand == stand else "with other numbers than its file"
    main = ServoPrinter(stand, made.program, made.form, made.tables).render(
        programs.PIL,
        parameters=initialiser(
            generated.layout.parameters, other.values.parameters, partial(real_literal, precision=precision), {}
        ),
        other=words,
        hex_digits=precision.width // 4,
        pil_samples=samples,
        pil_last=samples * 3 // 4,
    )
    name = stand.name
    equations = {f"{name}.h", f"{name}.c"}
    tables = {f"{name}_programme{end}" for end in (".h", ".c")}
    servo = {f"{name}_servo{end}" for end in (".h", ".c")}
    files = generated.files | made.programme.files | made.servo
    return {file: text for file, text in files.items() if file in equations | tables | servo} | {"pil.c": main}


def read_run(printed: str) -> Run:
    """Output of the program."""
    lines = printed.splitlines()
    torques = tuple(line for line in lines if line.startswith(" "))
    numbers: dict[str, int] = {}
    counts: dict[str, int] = {}
    for line in lines[len(torques) :]:
        match = _COUNT.fullmatch(line)
        assert match is not None, line
        (counts if match[1] else numbers)[match[2]] = int(match[3])
    followed = numbers["largest error of an angle in the last part, urad"] * 1e-6
    return Run(torques, followed, numbers["samples with a torque cut"], counts)
