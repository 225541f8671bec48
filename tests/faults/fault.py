"""A planted fault: where it is, how it is planted, and which checks must catch it."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from faults.emitted import Emitted, Host, files_of

BENCH = Host("bench8")
FLUID = Host("auv6")
SINGLE = Host("bench8", "float")


@dataclass(frozen=True)
class Fault:
    """`pattern` becomes `new`, `hits` times, in the body of `function` or, where that is "", in the whole file.

    `NAME` and `name` in pattern and text stand for the stand's name. `flags` of the compiler are a fault of their own.
    """

    name: str
    kind: str
    caught_by: tuple[str, ...]
    function: str = ""
    pattern: str = ""
    new: str = ""
    host: Host = BENCH
    hits: int = 1
    file: str = ".c"
    flags: tuple[str, ...] = ()

    @property
    def place(self) -> str:
        """Where it is, for the table."""
        if self.flags:
            return " ".join(self.flags)
        return f"`{self.function}`" if self.function else f"`{self.file}`"


def planted(fault: Fault, folder: Path) -> Emitted:
    """The C of the host with the fault. Asserts that the text has it as often as it should."""
    files = dict(files_of(fault.host))
    if fault.pattern:
        name = f"{fault.host.name}{fault.file}"
        files[name] = changed(fault, files[name])
        assert files[name] != files_of(fault.host)[name], fault.name
    return Emitted(fault.host, folder, files, *fault.flags)


def changed(fault: Fault, text: str) -> str:
    """The text of a file with the fault."""
    stand = fault.host.name
    pattern, new = (t.replace("NAME", stand.upper()).replace("name_", f"{stand}_") for t in (fault.pattern, fault.new))
    start, stop = 0, len(text)
    if fault.function:
        bodies = list(
            re.finditer(
                rf"^(?:static )?(?:inline |\w+_COPIED )?\w+ {stand}_{fault.function}\(.*?\n}}\n",
                text,
                re.DOTALL | re.MULTILINE,
            )
        )
        assert len(bodies) == 1, fault.function
        start, stop = bodies[0].span()
    edited, count = re.subn(pattern, new, text[start:stop])
    assert count == fault.hits, f"{fault.name}: {count} hits of {pattern}"
    return text[:start] + edited + text[stop:]
