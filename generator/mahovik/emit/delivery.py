"""What `generate` delivers: a folder that stands alone, as file name to text."""

from __future__ import annotations

from mahovik.emit.eva import eva_files
from mahovik.emit.generate import Generated, generate_all
from mahovik.emit.readme import readme
from mahovik.emit.recorder import recorder_files
from mahovik.emit.selftest import selftest
from mahovik.lower.golden import golden
from mahovik.stand.identity import identities
from mahovik.stand.model import Stand


def selftest_files(stand: Stand, generated: Generated) -> dict[str, str]:
    """The self-test of generated C: `<stand>_selftest.c`, to be compiled beside its header and source."""
    vectors = golden(generated.program, generated.values)
    return {f"{stand.name}_selftest.c": selftest(generated.program, vectors, identities(stand))}


def firmware(stand: Stand, precision_name: str = "double") -> dict[str, str]:
    """Of these files those that are compiled for a board, and the README. Raises UsageError, StandError."""
    return _firmware(stand, generate_all(stand, precision_name))


def delivery(stand: Stand, precision_name: str = "double") -> dict[str, str]:
    """All files of the folder but its manifest. Raises UsageError, StandError."""
    generated = generate_all(stand, precision_name)
    return {**_firmware(stand, generated), **eva_files(generated.program, identities(stand))}


def _firmware(stand: Stand, generated: Generated) -> dict[str, str]:
    return {
        **generated.files,
        **selftest_files(stand, generated),
        **recorder_files(stand, generated),
        "README.md": readme(stand, generated),
    }
