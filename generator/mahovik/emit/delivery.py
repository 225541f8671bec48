"""What `generate` delivers: a folder that stands alone, as file name to text."""

from __future__ import annotations

from mahovik.emit.generate import Generated
from mahovik.emit.selftest import selftest
from mahovik.lower.golden import golden
from mahovik.stand.identity import identities
from mahovik.stand.model import Stand


def selftest_files(stand: Stand, generated: Generated) -> dict[str, str]:
    """The self-test of generated C: `<stand>_selftest.c`, to be compiled beside its header and source."""
    vectors = golden(generated.program, generated.values)
    return {f"{stand.name}_selftest.c": selftest(generated.program, vectors, identities(stand))}
