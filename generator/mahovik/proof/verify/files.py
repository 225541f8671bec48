"""Files written whole or not at all."""

from __future__ import annotations

import contextlib
import os
import tempfile
from collections.abc import Mapping
from pathlib import Path

from mahovik.errors import UsageError


def write(path: Path, text: str | bytes) -> None:
    """Write one file, atomically. Raises UsageError."""
    write_all(path.parent, {path.name: text})


def probe(path: Path) -> None:
    """Raises UsageError where `write` could not: tries with an empty file beside it, which is taken away again."""
    if path.is_dir():
        raise UsageError(f"{path}: is a directory, expected a file to write")
    made = _make(path.parent)
    try:
        _draft(path.parent, path.name, b"").unlink()
    except OSError as error:
        raise UsageError(f"{path}: cannot be written: {error.strerror or error}") from None
    finally:
        for each in made:
            with contextlib.suppress(OSError):
                each.rmdir()


def write_all(folder: Path, files: Mapping[str, str | bytes] | Mapping[str, str]) -> tuple[Path, ...]:
    """Write several files into a folder, which is made if need be: all of them or none. Raises UsageError.

    Each is written beside its place and moved there when all are complete, so that a build that runs at the same
    time never sees half a file. What has the same content already is not touched: its date stays.
    """
    made = _make(folder)
    targets = {name: folder / name for name in files}
    drafts: dict[str, Path] = {}
    replaced: dict[Path, bytes | None] = {}
    name = ""
    try:
        for name, target in targets.items():
            if target.is_dir():
                raise UsageError(f"{target}: is a directory, expected a file to write")
            given = files[name]
            content = given.encode("utf-8") if isinstance(given, str) else given
            if not (target.is_file() and target.read_bytes() == content):
                drafts[name] = _draft(folder, name, content)
        for name, draft in drafts.items():
            replaced[targets[name]] = targets[name].read_bytes() if targets[name].is_file() else None
            os.replace(draft, targets[name])
    except BaseException as error:  # an interrupt as well: the old files come back
        _restore(replaced)
        if isinstance(error, OSError):
            raise UsageError(f"{targets.get(name, folder)}: cannot be written: {error.strerror or error}") from None
        raise
    finally:
        for draft in drafts.values():
            draft.unlink(missing_ok=True)
        for each in made:  # innermost first; stays where it holds something
            with contextlib.suppress(OSError):
                each.rmdir()
    return tuple(targets.values())


def _restore(replaced: Mapping[Path, bytes | None]) -> None:
    """What was replaced before a later file failed gets its old content back, or goes where there was none."""
    for target, before in replaced.items():
        with contextlib.suppress(OSError):
            if before is None:
                target.unlink(missing_ok=True)
            else:
                os.replace(_draft(target.parent, target.name, before), target)


def _draft(folder: Path, name: str, content: bytes) -> Path:
    """The content in a temporary file of the folder, with the permissions of an ordinary new file."""
    handle, path = tempfile.mkstemp(prefix=f".{name}.", dir=folder)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(content)
        mask = os.umask(0)
        os.umask(mask)
        os.chmod(path, 0o666 & ~mask)
    except (OSError, KeyboardInterrupt):
        Path(path).unlink(missing_ok=True)
        raise
    return Path(path)


def _make(folder: Path) -> list[Path]:
    """Makes the folder and its parents; returns those made, innermost first."""
    missing = [each for each in (folder, *folder.parents) if not each.exists()]
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except FileExistsError:
        raise UsageError(f"{folder}: is a file, expected a folder to write into") from None
    except NotADirectoryError:
        raise UsageError(f"{folder}: cannot be made, a part of the path is a file") from None
    except OSError as error:
        raise UsageError(f"{folder}: cannot be made: {error.strerror or error}") from None
    except ValueError as error:  # a NUL in the name
        raise UsageError(f"{str(folder)!r}: {error}") from None
    return missing
