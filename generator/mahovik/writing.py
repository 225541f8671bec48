"""Files written whole or not at all: an interrupt at any instruction leaves the old or the new, and no draft.

A draft lies beside its place under a name that is chosen, and known to the clean-up, before the file exists. What is
no regular file, such as a device or a FIFO, is written through; a link stays, and the file it leads to is replaced.
"""

from __future__ import annotations

import contextlib
import errno
import os
import shutil
import stat
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path

from mahovik.errors import UsageError


def write(path: Path, content: str | bytes) -> None:
    """Write one file, atomically. Raises UsageError."""
    write_all(path.parent, {path.name: content})


def is_written_through(path: Path) -> bool:
    """Whether a path, behind all links, is a device, a FIFO or the like, which no draft can replace."""
    try:
        kind = path.stat().st_mode
    except (OSError, ValueError):
        return False
    return not (stat.S_ISREG(kind) or stat.S_ISDIR(kind))


def format_of(path: Path, formats: Sequence[str], name: str = "output") -> str:
    """The end of a file's name among `formats`, such as ".csv". Raises UsageError of an argument `name` for another.

    What is no regular file may have any name: its format is the first one unless its name says another.
    """
    named = next((suffix for suffix in formats if path.name.endswith(suffix)), None)
    if named is None and not is_written_through(path):
        raise UsageError(f"{name} {path}: expected a name that ends in {' or '.join(formats)}")
    return named or formats[0]


def probe(path: Path) -> None:
    """Raise UsageError if `write` would fail: tries with an empty draft beside it; a FIFO or device is not opened."""
    drafts: list[Path] = []
    missing = _missing(path.parent)
    try:
        _make(path.parent)
        place = _place(path)
        if place is not None:
            drafts.append(_draft_name(place))
            _create(drafts[0], b"")
        elif not os.access(path, os.W_OK):
            raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
        _remove(drafts, missing)
    except OSError as error:
        raise _unwritable(path, error) from None
    finally:
        _remove(drafts, missing)  # again, if an interrupt came between


def write_all(
    folder: Path, files: Mapping[str, str | bytes] | Mapping[str, str], mode: int = 0o666
) -> tuple[Path, ...]:
    """Write several files, by their paths in a folder, which is made if missing: all or none. Raises UsageError.

    Each is written beside its place and moved there when all are complete, so that a build that runs at the same
    time never sees half a file. What has the same content already is not touched: its date stays. What is written
    through comes last, since it cannot be taken back. `mode`: permissions of new files, less those of the umask.
    """
    targets = {name: folder / name for name in files}
    drafts: dict[Path, Path] = {}
    places: dict[Path, Path] = {}
    through: dict[Path, bytes] = {}
    replaced: dict[Path, bytes | None] = {}
    folders = {folder, *(target.parent for target in targets.values())}
    missing = sorted({place for parent in folders for place in _missing(parent)}, reverse=True)
    target = folder
    try:
        _make(folder)
        for name, target in targets.items():
            _make(target.parent)
            text = files[name]
            content = text.encode("utf-8") if isinstance(text, str) else text
            place = _place(target)
            if place is None:
                through[target] = content
            elif not (place.is_file() and place.read_bytes() == content):
                places[target], drafts[target] = place, _draft_name(place)
                _create(drafts[target], content, mode)
        for target, place in places.items():
            replaced[place] = place.read_bytes() if place.is_file() else None
            os.replace(drafts[target], place)
        for target, content in through.items():
            with open(target, "wb", opener=lambda name, _: os.open(name, os.O_WRONLY)) as file:
                file.write(content)
    except BaseException as error:  # an interrupt as well: the old files come back
        _restore(replaced, mode)
        if isinstance(error, OSError):
            raise _unwritable(target, error) from None
        raise
    finally:
        _remove(drafts.values(), missing)
    return tuple(targets.values())


@contextlib.contextmanager
def write_synced(path: Path) -> Iterator[Path]:
    """Yield a draft beside a file, to be written by the body; at its end the draft takes the place of the file.

    Before that it is on the disk, and its folder after that, so that a loss of power leaves the old file or the new
    one. The folder is made if need be. Raises UsageError, also for an OSError of the body.
    """
    place: Path | None = path
    draft: Path | None = None
    try:
        _make(path.parent)
        place = _place(path)
        if place is None:
            raise UsageError(f"{path}: is a device or a FIFO, expected a file to write")
        draft = _draft_name(place)
        yield draft
        _sync(draft)
        os.replace(draft, place)
        _sync(place.parent)
    except OSError as error:
        raise _unwritable(path, error) from None
    finally:
        if draft is not None:
            _remove([draft], [])


def _sync(path: Path) -> None:
    """Wait until a file or folder is on the disk. Raises OSError."""
    number = os.open(path, os.O_RDONLY)
    try:
        os.fsync(number)
    finally:
        os.close(number)


def write_folder(folder: Path, fill: Callable[[Path], None]) -> None:
    """Put what `fill` writes into an empty folder in the place of `folder`, all of it or none. Raises UsageError.

    Where `fill` raises, or the folder cannot be moved, the old folder stays.
    """
    draft, old = _draft_name(folder), _draft_name(folder)
    try:
        try:
            try:
                folder.parent.mkdir(parents=True, exist_ok=True)
                draft.mkdir()
            except OSError as error:
                raise UsageError(f"{folder}: cannot be made: {error.strerror or error}") from None
            fill(draft)
            try:
                if folder.exists():
                    os.rename(folder, old)
                os.rename(draft, folder)
            except OSError as error:
                raise _unwritable(folder, error) from None
        finally:
            _settle(draft, old, folder)
    finally:
        _settle(draft, old, folder)  # again, if an interrupt came between


def _settle(draft: Path, old: Path, folder: Path) -> None:
    """Remove the old folder if the draft has taken its place; else give it back, and remove the draft."""
    if draft.exists() and old.exists() and not folder.exists():
        os.rename(old, folder)
    shutil.rmtree(draft if draft.exists() else old, ignore_errors=True)


def _place(path: Path) -> Path | None:
    """The file that a draft shall replace, behind all links; None for what is written through.

    Raises OSError; UsageError for a folder.
    """
    try:
        kind = path.stat().st_mode
    except FileNotFoundError:  # new, or a link to what is not there yet
        return Path(os.path.realpath(path))
    if stat.S_ISDIR(kind):
        raise UsageError(f"{path}: is a directory, expected a file to write")
    return Path(os.path.realpath(path)) if stat.S_ISREG(kind) else None


def _draft_name(place: Path) -> Path:
    """A name for a draft in the same folder that no other process has."""
    return place.parent / f".{place.name}.{os.urandom(8).hex()}"


def _create(draft: Path, content: bytes, mode: int = 0o666) -> None:
    """Write a new file with these permissions, less those of the umask. Raises OSError."""
    with open(draft, "xb", opener=lambda name, flags: os.open(name, flags, mode)) as file:
        file.write(content)


def _restore(replaced: Mapping[Path, bytes | None], mode: int) -> None:
    """Give files that were replaced before a later one failed their old content, or remove them if they are new."""
    for place, before in replaced.items():
        with contextlib.suppress(OSError):
            if before is None:
                place.unlink(missing_ok=True)
                continue
            draft = _draft_name(place)
            try:
                _create(draft, before, mode)
                os.replace(draft, place)
            finally:
                draft.unlink(missing_ok=True)


def _remove(drafts: Iterable[Path], missing: Iterable[Path]) -> None:
    """Remove drafts, and the folders that were missing, innermost first, unless they hold something now."""
    for draft in drafts:
        with contextlib.suppress(OSError):  # was not made, or is in its place
            draft.unlink()
    for path in missing:
        with contextlib.suppress(OSError):
            path.rmdir()


def _missing(folder: Path) -> list[Path]:
    """The folder and its parents as far as they do not exist, innermost first."""
    return [part for part in (folder, *folder.parents) if not part.exists()]


def _make(folder: Path) -> None:
    """Make the folder and its parents. Raises UsageError."""
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


def _unwritable(path: Path, error: OSError) -> UsageError:
    return UsageError(f"{path}: cannot be written: {error.strerror or error}")
