"""Files that `generate` delivers: a self-contained folder, as file name to text."""

from __future__ import annotations

from mahovik.core.emit.batch import batch_files
from mahovik.core.emit.eva import eva_files
from mahovik.core.emit.generate import Generated, generate_all
from mahovik.core.emit.names import VERIFICATION
from mahovik.core.emit.readme import readme
from mahovik.core.emit.recorder import has_recorder, recorder_files
from mahovik.core.emit.selftest import selftest
from mahovik.core.lower.golden import golden
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand


def selftest_files(stand: Stand, generated: Generated) -> dict[str, str]:
    """The self-test of generated C: `<stand>_selftest.c` in VERIFICATION, with a `main` by -D<STAND>_SELFTEST_MAIN."""
    vectors = golden(generated.program, generated.values)
    text = selftest(generated.program, vectors, identities(stand))
    return {f"{VERIFICATION}{stand.name}_selftest.c": text}


def firmware(stand: Stand, precision_name: str = "double", only: tuple[str, ...] = ()) -> dict[str, str]:
    """Return the files that are compiled for a board, and the README. Raises UsageError, StandError."""
    return _firmware(stand, generate_all(stand, precision_name, only))


def delivery(
    stand: Stand,
    precision_name: str = "double",
    batch: bool = False,
    only: tuple[str, ...] = (),
) -> dict[str, str]:
    """All files of the folder except its manifest; `batch`: with the functions for many states.

    `only`: with these public functions alone; no recorder without a step.
    Raises UsageError, StandError.
    """
    generated = generate_all(stand, precision_name, only)
    return {**_firmware(stand, generated, batch), **eva_files(generated.program, identities(stand))}


def _firmware(stand: Stand, generated: Generated, batch: bool = False) -> dict[str, str]:
    return {
        **generated.files,
        **selftest_files(stand, generated),
        **(recorder_files(stand, generated) if has_recorder(generated) else {}),
        **(batch_files(stand, generated) if batch else {}),
        "README.md": readme(stand, generated, batch),
    }
