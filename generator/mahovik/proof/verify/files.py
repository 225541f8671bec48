"""What no comparison of answers sees: the stand file read a second time, and the text of a delivered folder.

All that judges C begins with what `core/stand` has read of the stand file; and states that are drawn do not reach
every line of C. So a row compares the numbers with a second reading of the file, and another says where the text of
a folder is not what this version generates, with the functions concerned. Line endings do not count.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Mapping, Sequence
from itertools import zip_longest
from pathlib import Path
from typing import Any

import numpy as np

from mahovik import __version__
from mahovik.contract.limits import DOUBLE, Limits
from mahovik.core.emit.delivered import delivered_options, files_beside, has_hash, manifest_there
from mahovik.core.emit.delivery import ADDITIONS
from mahovik.core.emit.generate import Generated
from mahovik.core.emit.manifest import NAME as MANIFEST
from mahovik.core.emit.manifest import as_text, digest, spans, with_manifest
from mahovik.core.emit.names import VERIFICATION
from mahovik.core.emit.readme import readme
from mahovik.core.stand.model import Stand
from mahovik.errors import MahovikError
from mahovik.proof.second.reading import Table, UnknownUnitError, default_options, differences
from mahovik.proof.verify.check import TEXT, Check, difference

FILE = "stand file = second reading"
OPTIONS = "default options = second reading"
NEAR_SINGULAR = {"double": 1e-6, "float": 1e-3}
"""Default of `near_singular` by the contract."""

UNJUDGED = ("batch", "encoder")
"""Additions of `generate --with` whose answers nothing judges here: they must be what this version generates."""

JUDGED_APART = "what it does is judged by `verify` with programme and motion, or with servo"

BY_HAND = "edited by hand"

Generate = Callable[[str, str, bool], Mapping[str, str]]
"""Makes the files that this version generates, of an element type and a kind of table, with or without torques."""

SHOWN = 6
"""Names that a line lists; the rest are counted."""


def check_file(stand: Stand, document: Table | None) -> Check:
    """Row: bodies, places and added mass of a stand are those of a second reading of its file.

    `document`: the file's tables; None of a stand that has no file.
    """

    def relative(tables: Table) -> dict[str, tuple[float, str]]:
        return {name: (value, "") for name, value in differences(stand, tables).items()}

    return _second_reading(Check("", FILE, limit=DOUBLE.value), document, relative)


def check_options(options: Mapping[str, Any], document: Table | None, limits: Limits, largest: float) -> Check:
    """Row: the default `options` of the C are those of a second reading of the stand's file.

    `largest`: number of the element type that stands for no limit.
    """

    def relative(tables: Table) -> dict[str, tuple[float, str]]:
        expected = default_options(tables, largest, NEAR_SINGULAR[limits.real])
        return {name: difference(value, expected[name], np.abs(expected[name])) for name, value in options.items()}

    return _second_reading(Check("", OPTIONS, limit=limits.value), document, relative)


def _second_reading(
    row: Check, document: Table | None, relative: Callable[[Table], Mapping[str, tuple[float, str]]]
) -> Check:
    """The row with relative differences by name, or why the values have none."""
    row.words = "the stand has no file"
    if document is not None:
        try:
            for name, (value, why) in relative(document).items():
                words = f"{name}: {why or f'relative difference {value:.1e}'}"
                row.note(value, words=words if value > row.limit else "")
        except UnknownUnitError as error:
            row.words = f'the second reading does not know the unit "{error}"'
    return row


def check_texts(stand: Stand, generated: Generated, folder: Path) -> list[Check]:
    """Rows: the files of a folder are what this version generates, or as listed; their words say where not, and who.

    Text that differs is no failure, as other rows have judged its answers: but of what nothing judges.

    `generated`: C with the element type of the folder.
    """
    stems = {path.stem for place in (folder, folder / VERIFICATION) for path in place.glob("*.[ch]")}
    there = [name for name in (*UNJUDGED, "recorder") if {f"{stand.name}_{name}", f"mahovik_{name}"} & stems]
    added = {name: ADDITIONS[name](stand, generated) for name in there}
    expected = dict(item for files in (generated.files, *added.values()) for item in files.items())
    if (origin := manifest_there(folder)) is not None:
        expected |= _beside_c(stand, generated, folder, origin)
    rows = [text_row(folder, f"(?:{stand.name}|mahovik)", expected)]
    for name in UNJUDGED:
        row = Check("", f"{name} C = as generated")
        for file, text in added.get(name, {}).items():
            present = _text(folder / file)
            words = "missing" if present is None else "not what this version generates"
            row.demand(present == text, "", f"{file} is {words}: generate the {name} C again")
        rows += [row] if row.states else []
    return rows


def _beside_c(stand: Stand, generated: Generated, folder: Path, origin: Mapping[str, Any]) -> dict[str, str]:
    """The manifest with the facts that are due, and the README of these additions, if it is that of the manifest."""
    facts = json.loads(with_manifest(stand, generated, {})[MANIFEST])
    due = {key: facts[key] for key in origin.keys() & facts.keys() - {"generator", "files"}}
    options = delivered_options(folder)
    page = readme(stand, generated, () if options is None else options.additions)
    pages = {"README.md": page} if origin["files"].get("README.md") == digest(page) else {}
    return {**pages, MANIFEST: as_text({**origin, **due})}


def text_row(folder: Path, name: str, expected: Mapping[str, str], manifest: str = MANIFEST) -> Check:
    """Row: files of a folder have the texts `expected`, if they are there, and others are as the manifest lists them.

    `name`: prefix of the functions, a regular expression; `manifest`: name of its file.
    """
    row = Check("", TEXT, verdict="ok")
    origin = manifest_there(folder, manifest)
    listed = {} if origin is None else origin["files"]
    there = {file: text for file in expected if (text := _text(folder / file)) is not None}
    edited = [file for file, text in there.items() if text != expected[file]]
    by_hand = [
        file for file, digest in listed.items() if (folder / file).is_file() and not has_hash(folder / file, digest)
    ]
    by_hand += [file for file in edited if file not in (*listed, manifest)]
    if edited or by_hand:
        row.verdict = "not compared"
        author = _author(origin, manifest, bool(by_hand) or edited == [manifest])
        beside = [file for file in dict.fromkeys((*edited, *by_hand)) if file not in there or not _is_c(file)]
        places = [_places(name, expected, {file: text for file, text in there.items() if _is_c(file)}), _list(beside)]
        row.words = f"{author}: {'; '.join(filter(None, places))}"
        if edited and BY_HAND in author:
            row.words += f"; {edited[0]}, {_first_difference(there[edited[0]], expected[edited[0]])}"
    return row


def text_of_servo(stand: Stand, folder: Path, manifest: str, programme: str, generate: Generate | None) -> Check:
    """Row: the files of a servo in a folder are as their `manifest` lists them.

    `programme`: name of its programme in C; `generate`: tells the functions that differ.
    """
    row, origin = text_row(folder, stand.name, {}, manifest), manifest_there(folder, manifest)
    if row.verdict == "ok" or generate is None or origin is None:
        return row
    try:
        return text_row(folder, f"{stand.name}(?:_{programme})?", generate(origin["real"], "quintic", True), manifest)
    except MahovikError:  # it cannot be generated any more
        return row


def _is_c(file: str) -> bool:
    return file.endswith((".h", ".c"))


def _first_difference(text: str, expected: str) -> str:
    """The first line of a text that differs from what is expected, in words."""
    pairs = zip_longest(text.split("\n"), expected.split("\n"), fillvalue="end of the file")
    number, actual, wanted = next((k, a.strip(), b.strip()) for k, (a, b) in enumerate(pairs, 1) if a != b)
    return f"line {number}: found `{actual}`, expected `{wanted}`"


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


def _author(origin: Mapping[str, Any] | None, manifest: str, by_hand: bool) -> str:
    """Who has written files that differ: another version, or a hand, as far as their manifest says."""
    if origin is None:
        return f"of another version or {BY_HAND}, {manifest} is missing"
    if by_hand:
        return f"{BY_HAND} after {origin['generator']} wrote it"
    build = "another build of " if origin["generator"] == f"mahovik {__version__}" else ""
    return f"of {build}{origin['generator']}"


def _places(name: str, expected: Mapping[str, str], there: Mapping[str, str]) -> str:
    """Functions whose text differs, internal ones with the public functions that call them, and files outside of them.

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
    declared = [f for text in there.values() for f in re.findall(rf"^\w+ {name}_(\w+)\([^{{]*?;", text, re.MULTILINE)]
    public = [function for function in dict.fromkeys(declared) if function in calls]
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
