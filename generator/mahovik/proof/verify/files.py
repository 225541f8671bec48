"""What no comparison of answers sees: the stand file read a second time, and the text of a delivered folder.

All that judges C begins with what `core/stand` has read of the stand file; and states that are drawn do not reach
every line of C. So a row compares the numbers with a second reading of the file, and another says where the text of
a folder is not what this version generates, with the functions concerned. Line endings do not count.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import zip_longest
from pathlib import Path
from typing import Any

import numpy as np

from mahovik import __version__
from mahovik.contract.limits import DOUBLE, Limits
from mahovik.core.emit.batch import batch_files
from mahovik.core.emit.delivered import declared_functions, files_beside, read_manifest
from mahovik.core.emit.generate import Generated
from mahovik.core.emit.manifest import NAME as MANIFEST
from mahovik.core.emit.manifest import digest, spans
from mahovik.core.emit.names import VERIFICATION
from mahovik.core.emit.recorder import recorder_files
from mahovik.core.stand.model import Stand
from mahovik.errors import UsageError
from mahovik.proof.second.reading import Table, UnknownUnitError, default_options, differences
from mahovik.proof.verify.check import TEXT, Check, difference

FILE = "stand file = second reading"
OPTIONS = "default options = second reading"
NEAR_SINGULAR = {"double": 1e-6, "float": 1e-3}
"""Default of `near_singular` by the contract."""

BATCH = "batch C = as generated"

JUDGED_APART = "what it does is judged by `verify` with programme and motion, or with servo"

BY_HAND = "edited by hand"

SHOWN = 6
"""Names that a line lists; the rest are counted."""


def check_file(stand: Stand, document: Table | None) -> Check:
    """Row: bodies, places and added mass of a stand are those of a second reading of its file.

    `document`: the file's tables; None of a stand that has no file.
    """
    return _second_reading(Check("", FILE, limit=DOUBLE.value), document, lambda tables: differences(stand, tables))


def check_options(options: Mapping[str, Any], document: Table | None, limits: Limits, largest: float) -> Check:
    """Row: the default `options` of the C are those of a second reading of the stand's file.

    `largest`: number of the element type that stands for no limit.
    """

    def relative(tables: Table) -> dict[str, float]:
        expected = default_options(tables, largest, NEAR_SINGULAR[limits.real])
        return {name: difference(value, expected[name], np.abs(expected[name]))[0] for name, value in options.items()}

    return _second_reading(Check("", OPTIONS, limit=limits.value), document, relative)


def _second_reading(row: Check, document: Table | None, relative: Callable[[Table], Mapping[str, float]]) -> Check:
    """The row with relative differences by name."""
    row.words = "the stand has no file"
    if document is not None:
        try:
            for name, value in relative(document).items():
                row.note(value, words=f"{name}: relative difference {value:.1e}" if value > row.limit else "")
        except UnknownUnitError as error:
            row.words = f'the second reading does not know the unit "{error}"'
    return row


def check_text(stand: Stand, generated: Generated, folder: Path) -> Check:
    """Row: the C of a folder is what this version generates; its words name the functions where it is not, and who.

    Text that differs is no failure: the other rows have judged its answers.
    """
    row = Check("", TEXT, verdict="ok")
    recorded = (folder / f"{VERIFICATION}{stand.name}_recorder.c").is_file()
    expected = {**generated.files, **(recorder_files(stand, generated) if recorded else {})}
    there = {name: text for name in expected if (text := _text(folder / name)) is not None}
    edited = [name for name, text in there.items() if text != expected[name]]
    if edited:
        row.verdict = "not compared"
        places = _places(stand.name, declared_functions(folder, stand.name), expected, there)
        author = _author(folder, edited)
        first = (
            f"; {edited[0]}, {_first_difference(there[edited[0]], expected[edited[0]])}" if BY_HAND in author else ""
        )
        row.words = f"{author}: {places}{first}"
    return row


def _first_difference(text: str, expected: str) -> str:
    """The first line of a text that differs from what is expected, in words."""
    pairs = zip_longest(text.split("\n"), expected.split("\n"), fillvalue="end of the file")
    number, actual, wanted = next((k, a.strip(), b.strip()) for k, (a, b) in enumerate(pairs, 1) if a != b)
    return f"line {number}: found `{actual}`, expected `{wanted}`"


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
        row.demand(text == expected[name], "", f"{name} is {words}: generate the batch C again")
    return row


def check_beside(stand: Stand, folder: Path) -> list[Check]:
    """Rows on programmes, servos and loops in a folder: their files are as written; judging them needs their motion."""
    rows = []
    for name, changed in files_beside(folder, stand).items():
        row = Check("", f"{name} = as written", words="" if changed else JUDGED_APART)
        row.demand(not changed, "", f"{_list(changed)}: not what {name}.json lists: generate it again")
        rows.append(row)
    return rows


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
        return f"of another version or {BY_HAND}, {MANIFEST} is missing"
    for name in edited:
        content = (folder / name).read_bytes()
        if manifest["files"].get(name) not in (digest(content), digest(content.replace(b"\r\n", b"\n"))):
            return f"{BY_HAND} after {manifest['generator']} wrote it"
    build = "another build of " if manifest["generator"] == f"mahovik {__version__}" else ""
    return f"of {build}{manifest['generator']}"


def _places(name: str, public: Iterable[str], expected: Mapping[str, str], there: Mapping[str, str]) -> str:
    """Functions whose text differs, internal ones with the public functions that call them, and files beside them.

    A function that uses a changed macro is one whose text differs.
    """
    lines = {line for file, text in there.items() for line in {*expected[file].splitlines()} ^ {*text.splitlines()}}
    macros = {match[1] for line in lines if (match := re.match(r"#define (\w+)", line))}
    functions, outside, calls = dict[str, None](), [], dict[str, set[str]]()
    for file, text in there.items():
        ours, theirs = _functions(expected[file], name), _functions(text, name)
        outside += [file] if ours.pop("") != theirs.pop("") else []
        for function in {**ours, **theirs}:
            both = f"{ours.get(function)} {theirs.get(function)}"
            calls[function] = {*re.findall(rf"\b{name}_(\w+)\(", both)}
            if ours.get(function) != theirs.get(function) or macros & {*re.findall(r"\w+", both)}:
                functions[function] = None
    public = [function for function in public if function in calls]
    reach = {function: {function} for function in public}
    while more := {(p, new) for p, at in reach.items() for f in at for new in calls.get(f, set()) - at}:
        for function, called in more:
            reach[function].add(called)
    words = []
    for function in functions:
        callers = [caller for caller in public if function in reach[caller]]
        internal = f" (internal, of {_list(callers) or 'no public function'})" if function not in public else ""
        words.append(f"{function}{internal}")
    return "; ".join(filter(None, [_list(words), f"{_list(outside)} outside of functions" if outside else ""]))


def _functions(text: str, name: str) -> dict[str, str]:
    """Text of every function of a file, and under "" what is around them."""
    lines, functions, rest, place = text.splitlines(), dict[str, str](), list[str](), 0
    for function, (first, last) in spans(text, name).items():
        functions[function] = "\n".join(lines[first - 1 : last])
        rest += lines[place : first - 1]
        place = last
    return {**functions, "": "\n".join([*rest, *lines[place:]])}


def _list(names: Sequence[str]) -> str:
    more = f" and {len(names) - SHOWN} more" if len(names) > SHOWN else ""
    return ", ".join(names[:SHOWN]) + more
