"""Files that `generate` delivers: a self-contained folder, as file name to text."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from mahovik.core.emit.batch import batch_files
from mahovik.core.emit.code import Code
from mahovik.core.emit.declaration import struct_lines
from mahovik.core.emit.eva import eva_files
from mahovik.core.emit.generate import Generated, generate_all
from mahovik.core.emit.manifest import with_manifest
from mahovik.core.emit.names import VERIFICATION
from mahovik.core.emit.readme import readme
from mahovik.core.emit.recorder import recorder_files
from mahovik.core.emit.selftest import selftest
from mahovik.core.emit.templates import template
from mahovik.core.lower.encoder import COUNTS, ENCODER, lower_encoder
from mahovik.core.lower.golden import golden
from mahovik.core.program.types import DOUBLE, FLOAT, Kind
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import Identities, identities
from mahovik.errors import UsageError
from mahovik.nearest import suggestion


def selftest_files(stand: Stand, generated: Generated) -> dict[str, str]:
    """The self-test of generated C: `<stand>_selftest.c` in VERIFICATION, with a `main` by -D<STAND>_SELFTEST_MAIN."""
    vectors = golden(generated.program, generated.values)
    text = selftest(generated.program, vectors, identities(stand))
    return {f"{VERIFICATION}{stand.name}_selftest.c": text}


NO_STAND = Identities("", "")
"""What text that is the same for every stand depends on."""


def encoder_files(stand: Stand, generated: Generated) -> dict[str, str]:
    """Phases and speeds from encoder counts: the same text for every stand, linked once."""
    codes = []
    for precision in (FLOAT, DOUBLE):
        types = {Kind.REAL: precision.name, Kind.STATUS: "int", Kind.WORD: f"uint{precision.width}_t"}
        codes.append(Code(lower_encoder(precision), NO_STAND, types=types))
    functions = {f["prototype"]: f for code in codes for f in code.functions}
    known = {
        "counts": COUNTS,
        "struct": struct_lines(ENCODER, codes[0].names),
        "declarations": [line for code in codes for line in code.public_declarations(code.public)],
        "functions": list(functions.values()),
    }
    return {f"mahovik_encoder.{kind}": template(f"mahovik_encoder.{kind}.j2").render(**known) for kind in "hc"}


ADDITIONS: Mapping[str, Callable[[Stand, Generated], dict[str, str]]] = {
    "selftest": selftest_files,
    "recorder": recorder_files,
    "eva": eva_files,
    "batch": batch_files,
    "encoder": encoder_files,
}
"""What `generate --with` adds to header, source and README: files whose names end in the name of the addition."""


def added_files(stand: Stand, generated: Generated, additions: tuple[str, ...]) -> dict[str, str]:
    """The files of ADDITIONS. Raises UsageError for an unknown one, and where the C lacks what one of them calls."""
    files: dict[str, str] = {}
    for name in additions:
        if name not in ADDITIONS:
            raise UsageError(f"with_ {name}: there is no such addition{suggestion(name, ADDITIONS)}")
        files |= ADDITIONS[name](stand, generated)
    return files


def delivery(
    stand: Stand, precision_name: str = "double", only: tuple[str, ...] = (), additions: tuple[str, ...] = ()
) -> dict[str, str]:
    """All files of the folder: header, source, README, those of `additions`, manifest.

    `only`: as of `generate_all`; by default the default functions alone.
    Raises UsageError, StandError.
    """
    generated = generate_all(stand, precision_name, only)
    added = added_files(stand, generated, additions)
    files = {**generated.files, **added, "README.md": readme(stand, generated, additions)}
    return with_manifest(stand, generated, files)
