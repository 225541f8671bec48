"""What no comparison of answers sees: the stand file read a second time, and the text of a delivered folder.

All that judges C begins with what `core/stand` has read of the stand file; and states that are drawn do not reach
every line of C. So a row compares the numbers with a second reading of the file, and another says where the text of
a folder is not what this version generates, with the functions concerned. Line endings do not count.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from pathlib import Path

from mahovik import __version__
from mahovik.core.emit.batch import batch_files
from mahovik.core.emit.generate import Generated
from mahovik.core.emit.manifest import NAME as MANIFEST
from mahovik.core.emit.manifest import digest
from mahovik.core.emit.reading import spans
from mahovik.core.emit.recorder import has_recorder, recorder_files
from mahovik.core.stand.model import Stand
from mahovik.errors import UsageError
from mahovik.proof.second.reading import Table, UnknownUnitError, differences
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.delivery import declared_functions, made_by, read_manifest
from mahovik.proof.verify.report import TEXT

ACCEPTED = 1e-12
"""Relative difference of two readings of a file that rounding may make; seen are 4e-16."""

FILE = "stand file = second reading"
BATCH = "batch C = as generated"

SHOWN = 6
"""Names that a line lists; the rest are counted."""


def check_file(stand: Stand, document: Table | None) -> Check:
    """Row: bodies, places and added mass of a stand are those of a second reading of its file.

    `document`: the file's tables; None of a stand that has no file.
    """
    row = Check("", FILE, limit=ACCEPTED, words="the stand has no file")
    if document is not None:
        try:
            for name, off in differences(stand, document).items():
                row.note(off, words=f"{name}: relative difference {off:.1e}" if off > ACCEPTED else "")
        except UnknownUnitError as error:
            row.words = f'the second reading does not know the unit "{error}"'
    return row


def check_text(stand: Stand, generated: Generated, folder: Path) -> Check:
    """Row: the C of a folder is what this version generates; its words name the functions where it is not, and who.

    Text that differs is no failure: the other rows have judged its answers.
    """
    row = Check("", TEXT, verdict="ok")
    expected = {**generated.files, **(recorder_files(stand, generated) if has_recorder(generated) else {})}
    there = {name: text for name in expected if (text := _text(folder / name)) is not None}
    edited = {name for name, text in there.items() if text != expected[name]}
    if edited:
        row.verdict = "not compared"
        row.words = (
            f"{_author(folder, edited)}: {_places(stand.name, declared_functions(folder, stand.name), expected, there)}"
        )
    return row


def check_batch(stand: Stand, generated: Generated, folder: Path) -> Check | None:
    """Row on `<stand>_batch.h` and `<stand>_batch.c` in a folder, which nothing else judges; None if neither exists.

    `generated`: C with the element type of the folder.
    """
    names = [f"{stand.name}_batch.{kind}" for kind in ("h", "c")]
    there = {name: _text(folder / name) for name in names}
    if not any(there.values()):
        return None
    row, expected = Check("", BATCH), batch_files(stand, generated)
    for name, text in there.items():
        words = "missing" if text is None else "not what this version generates"
        row.demand(text == expected[name], "", f"{name} is {words}: generate it again with --batch")
    return row


def is_as_generated(files: Mapping[str, str], folder: Path) -> bool:
    """Whether a folder has these texts."""
    return all(_text(folder / name) == text for name, text in files.items())


def _text(path: Path) -> str | None:
    return path.read_text(encoding="utf-8", errors="replace") if path.is_file() else None  # universal newlines


def _author(folder: Path, edited: Iterable[str]) -> str:
    """Who has written these files of a folder: another version, or a hand, as far as its manifest says."""
    try:
        manifest = read_manifest(folder)
    except UsageError:
        manifest = None
    if manifest is None:
        return f"of another version or edited by hand, {MANIFEST} is missing"
    listed = manifest["files"]
    by_hand = [name for name in sorted(edited) if listed.get(name) not in _digests(folder / name)]
    if by_hand:
        return f"edited by hand after {manifest['generator']} wrote it"
    generator = str(manifest["generator"])
    commit = made_by(folder).get("commit")
    build = "" if generator != f"mahovik {__version__}" else "another build of "
    return f"of {build}{generator}" + (f", commit {str(commit)[:8]}" if commit else "")


def _digests(path: Path) -> tuple[str, ...]:
    """Hashes of a file as it is and with the line endings that it was written with."""
    content = path.read_bytes()
    return digest(content), digest(content.replace(b"\r\n", b"\n"))


def _places(name: str, public: Iterable[str], expected: Mapping[str, str], there: Mapping[str, str]) -> str:
    """Functions whose text differs, internal ones with the public functions that call them, and files beside them.

    A function that uses a changed macro is one whose text differs.
    """
    functions, rest, calls = dict[str, None](), [], dict[str, set[str]]()
    macros = {macro for file, text in there.items() for macro in _changed_macros(expected[file], text)}
    for file, text in there.items():
        ours, theirs = _functions(expected[file], name), _functions(text, name)
        for source in (ours, theirs):
            for function, body in source.items():
                calls.setdefault(function, set()).update(re.findall(rf"\b{name}_(\w+)\(", body))
                if function and macros & set(re.findall(r"\w+", body)):
                    functions[function] = None
        changed = [f for f in {**ours, **theirs} if ours.get(f) != theirs.get(f)]
        functions |= dict.fromkeys(f for f in changed if f)
        rest += [file] if "" in changed else []
    public = [function for function in public if function in calls]
    reach = {function: _reached(function, calls) for function in public}
    words = []
    for function in functions:
        callers = [caller for caller in public if function in reach[caller]]
        internal = f" (internal, of {_list(callers) or 'no public function'})" if function not in public else ""
        words.append(f"{function}{internal}")
    outside = [f"{_list(rest)} outside of functions"] if rest else []
    return "; ".join(filter(None, [_list(words), *outside]))


def _changed_macros(ours: str, theirs: str) -> set[str]:
    """Macros that are defined otherwise."""
    changed = set(ours.splitlines()) ^ set(theirs.splitlines())
    return {found[1] for line in changed if (found := re.match(r"#define (\w+)", line))}


def _functions(text: str, name: str) -> dict[str, str]:
    """Text of every function of a file, and under "" what is around them."""
    lines, found, rest, place = text.splitlines(), dict[str, str](), list[str](), 0
    for function, (first, last) in spans(text, name).items():
        found[function] = "\n".join(lines[first - 1 : last])
        rest += lines[place : first - 1]
        place = last
    return {**found, "": "\n".join([*rest, *lines[place:]])}


def _reached(function: str, calls: Mapping[str, set[str]]) -> set[str]:
    """What a function calls, and what that calls."""
    reached, left = set[str](), [function]
    while left:
        for called in calls.get(left.pop(), ()):
            if called not in reached and called in calls:
                reached.add(called)
                left.append(called)
    return reached


def _list(names: Iterable[str]) -> str:
    every = list(names)
    more = f" and {len(every) - SHOWN} more" if len(every) > SHOWN else ""
    return ", ".join(every[:SHOWN]) + more
