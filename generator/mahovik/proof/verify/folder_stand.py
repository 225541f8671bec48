"""The stand of the C in a folder, under the name that it has there: its own, or that of `generate --prefix`."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

from mahovik.core.emit.reading import Header, read_header
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand
from mahovik.core.stand.names import stand_name_problem
from mahovik.errors import CheckError, MahovikError, UsageError


def with_prefix(stand: Stand, prefix: str | None) -> Stand:
    """The stand by another name, which is that of its files and the first word of every name in C. UsageError."""
    if prefix is None:
        return stand
    problem = stand_name_problem(prefix)
    if problem is not None:
        raise UsageError(f"--prefix {prefix}: {problem}")
    return replace(stand, name=prefix)


def under_name(stand: Stand, name: str, physics: str | None) -> Stand | None:
    """The stand by the name that its C has, its own or that of `generate --prefix`; None for C of another stand.

    `physics`: identity of the C, which the name is a part of.
    """
    if stand_name_problem(name) is not None:
        return None
    with_prefix = stand if name == stand.name else replace(stand, name=name)
    return with_prefix if identities(with_prefix).physics == physics else None


def stand_in(folder: Path, stand: Stand, refusal: type[MahovikError] = CheckError) -> Stand:
    """The stand under the name of its C in a folder; unchanged if the folder has C of its own name, or none at all.

    Raises `refusal` for C of other stands only, and where two names fit.
    """
    headers = _headers(folder)
    if stand.name in headers or not headers:
        return stand
    named = [under_name(stand, name, header.physics) for name, header in headers.items()]
    fitting = [each for each in named if each is not None]
    if len(fitting) == 1:
        return fitting[0]
    if fitting:
        names = " and ".join(f'"{each.name}"' for each in fitting)
        raise refusal(f"{folder}: holds C of this stand under the names {names}: move all but one to other folders")
    found = ", ".join(f'"{name}", physics {header.physics}' for name, header in headers.items())
    raise refusal(
        f'{folder}: holds the C of stand {found}, expected that of "{stand.name}", also under another name '
        "(generate --prefix): generate it again, or choose another folder"
    )


def declared_functions(folder: Path, name: str) -> tuple[str, ...]:
    """Functions that the header of a stand in a folder declares, without prefix, in its order."""
    text = (folder / f"{name}.h").read_text(encoding="utf-8", errors="replace")
    return tuple(re.findall(rf"^\w+ {name}_(\w+)\(", text, re.MULTILINE))


def _headers(folder: Path) -> dict[str, Header]:
    """Headers of all stands whose C is in a folder, by the name in that C."""
    names = sorted(path.stem for path in folder.glob("*.h") if path.with_suffix(".c").is_file())
    headers = {name: read_header(folder, name) for name in names if name.isidentifier()}
    return {name: header for name, header in headers.items() if header is not None and header.physics is not None}
