"""Folder for a programme's files: a folder of `mahovik generate`, or any other; never over files of others."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path

from mahovik.core.emit.header import read_header
from mahovik.core.emit.manifest import digest
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand
from mahovik.errors import CheckError, UsageError
from mahovik.proof.verify.files import write_all


def element_type(folder: Path, stand: Stand, real: str | None) -> str:
    """Element type for the C in a folder: the given one, else that of the stand's header there, else double.

    Raises UsageError if the two differ, CheckError if the header is of another stand.
    """
    header = read_header(folder, stand.name)
    if header is None or header.real is None:
        return real or "double"
    found = identities(stand)
    if (header.structure, header.physics) != (found.structure, found.physics):
        raise CheckError(
            f"{folder / stand.name}.h: is of another stand (structure {header.structure}, physics {header.physics}; "
            f"the stand file has {found.structure}, {found.physics}): generate it again or choose another folder"
        )
    if real is not None and real != header.real:
        raise UsageError(f"{folder / stand.name}.h: has {header.real}, asked was for {real}: leave --real out")
    return header.real


def write_programme(folder: Path, stand: Stand, files: Mapping[str, str]) -> tuple[Path, ...]:
    """Write the files of a programme, all or none. Raises UsageError rather than overwrite files of others."""
    refuse_foreign(folder, stand, "programme", files)
    return write_all(folder, files)


def write_servo(folder: Path, stand: Stand, programme: Mapping[str, str], servo: Mapping[str, str]) -> tuple[Path, ...]:
    """Write the files of a programme and of its servo, all or none. Raises UsageError."""
    refuse_foreign(folder, stand, "programme", programme)
    refuse_foreign(folder, stand, "servo", servo)
    return write_all(folder, {**programme, **servo})


def refuse_foreign(folder: Path, stand: Stand, what: str, files: Mapping[str, str]) -> None:
    """Raise UsageError if one of the files would overwrite a file that mahovik has not written.

    Files that mahovik has written are listed in the manifest of the programme or servo, `what`, with their hash.
    """
    manifest = f"{stand.name}_{what}.json"
    listed = _listed(folder / manifest, what)
    for name, text in files.items():
        path = folder / name
        if not path.is_file() or path.read_bytes() == text.encode("utf-8"):
            continue
        if name == manifest and listed is not None:
            continue
        if listed is None or listed.get(name) != digest(path.read_bytes()):
            why = "was changed by hand" if listed is not None and name in listed else "was not written by mahovik"
            raise UsageError(f"{path}: {why}: move it away or choose another folder, nothing was written")


def _listed(path: Path, what: str) -> dict[str, str] | None:
    """Hashes by name from the manifest of an older programme or servo; None: there is none."""
    if not path.is_file():
        return None
    try:
        found = json.loads(path.read_bytes())
        if str(found["generator"]).startswith("mahovik ") and isinstance(found[what], str):
            return {str(name): str(value) for name, value in found["files"].items()}
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
        pass
    return None
