"""Files named by the user: their content up to a limit of size, their kind by their keys; TOML and CSV."""

from __future__ import annotations

import csv
import errno
import io
import json
import math
import re
import tomllib
from collections.abc import Callable, Collection, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from decimal import Decimal, InvalidOperation
from itertools import starmap
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.units import Dimension, QuantityError, factor, show
from mahovik.errors import FileError
from mahovik.nearest import nearest_name, suggestion

TEXT = 4 << 20
"""Largest stand file, regime or start that is read, bytes. A stand file of 64 flywheels has 30 kB."""

TABLE = 256 << 20
"""Largest table in time, or log of a console, that is read, bytes."""

FLIGHT = 1 << 30
"""Largest flight log that is read, bytes: hours of a thousand steps a second."""

CSV, ZIP = "a table (CSV)", "a ZIP archive"

KINDS = {
    "stand": "a stand file",
    "programme": "a programme file",
    "motion": "a motion file",
    "regime": "a regime",
    "servo": "a file of servos",
    "state": "a state",
    "campaign": "a campaign file",
    "influence": "a file of influences",
    "map": "a map of variables",
    "free": "a list of free numbers",
    "manifest": "a manifest of generated C",
    "result": "what a command printed with --json",
    "table": CSV,
    "data": "a file of measured data",
    "fmu": "an FMU",
}
"""Kinds of files, in words."""

FORMS = {"data": (CSV,), "fmu": (ZIP,)}
"""What files of a kind may look like."""

_OF_STATES = {"position", "quaternion", "angles", "V", "phi", "phi_dot", "want"}

_BY_KEYS: dict[str, Callable[[Mapping[str, Any]], bool]] = {
    "campaign": lambda keys: "vary" in keys and bool(keys.keys() & {"samples", "quantity", "over"}),
    "map": lambda keys: isinstance(keys.get("state"), dict) and bool(keys.keys() & {"forward", "torque", "coupled"}),
    "influence": lambda keys: "A" in keys and bool(keys.keys() & {"B", "U", "ALPHA"}),
    "free": lambda keys: isinstance(keys.get("free"), list),
    "manifest": lambda keys: str(keys.get("generator", "")).startswith("mahovik "),
    "result": lambda keys: {"messages", "ok"} <= keys.keys(),
    "state": lambda keys: not keys.keys() & {"schema", "carrier"} and bool(keys.keys() & _OF_STATES),
}
"""How the keys of files that only commands read show what they are, the surest first."""

_BY_BEGINNING = {
    "<robot": "a URDF", "<mujoco": "an MJCF", "<sdf": "an SDF", "<?xml": "an XML file", "<!--": "an XML file",
    "PK": ZIP, "\x7fELF": "a program", "ULog": "a flight log of PX4",
}  # fmt: skip

_PIECE = 1 << 20


def kind_of(document: Mapping[str, Any]) -> str:
    """The kind of a file of schema 1, one of KINDS, by its keys; empty where they do not tell."""
    if isinstance(document.get("carrier"), dict) and "name" in document:
        return "stand"
    if "stand" in document and "flywheels" in document:
        return "programme"
    if document.keys() & {"type", "harmonics"} or isinstance(document.get("samples"), dict):
        return "motion"
    if document.keys() & {"default", "wrench"} or isinstance(document.get("flywheel"), dict):
        return "regime"
    return "servo" if "sample_period" in document else ""


def words_of_file(path: Path) -> str | None:
    """What a file is; None where it cannot be read or nothing shows it."""
    try:
        text = content(path).decode("utf-8-sig", "replace")
    except (OSError, ValueError):
        return None
    for beginning, words in _BY_BEGINNING.items():
        if text.lstrip().startswith(beginning):
            return words
    for parse in (json.loads, parse_toml):
        with suppress(ValueError, RecursionError):
            keys = parse(text)
            keys = keys if isinstance(keys, dict) else {}
            return KINDS.get(next((kind for kind, shows in _BY_KEYS.items() if shows(keys)), kind_of(keys)))
    head = text.partition("\n")[0].strip()
    commas = {line.count(",") for line in text.split("\n", 2)[:2]}  # the first row has as many as the head
    is_table = len(commas) == 1 and "," in head and head.isprintable() and not head.startswith(("{", "[", "#"))
    return CSV if is_table else None


def wrong_kind(kind: str, *expected: str) -> str:
    """Words on a file of one kind where another was expected."""
    wanted = " or ".join(KINDS[name] for name in expected) or "another file"
    return f"is {KINDS[kind]}, expected {wanted}"


def is_file(path: Path) -> bool:
    """Whether there is such a file; a text too long for a name, or with a NUL, names none."""
    try:
        return path.is_file()
    except OSError:
        return False


def content(path: Path, most: int = TEXT) -> bytes:
    """All bytes of a file. Raises OSError, also where it is larger than `most` or has no end, such as /dev/zero.

    Of a file that is not there it says which one beside it, of the same kind, may be meant.
    """
    result = bytearray()
    try:
        opened = path.open("rb")
    except FileNotFoundError:
        suffix = path.suffix or ".toml"
        siblings = sorted(sibling.stem for sibling in path.parent.glob(f"*{suffix}") if sibling.is_file())
        near = nearest_name(path.stem, siblings)
        meant = "" if near is None else f', did you mean "{path.with_name(f"{near}{suffix}")}"?'
        raise FileNotFoundError(errno.ENOENT, f"no such file{meant}", str(path)) from None
    with opened as file:
        while piece := file.read(_PIECE):
            result += piece
            if len(result) > most:
                raise OSError(errno.EFBIG, f"larger than {most >> 20} MB", str(path))
    return bytes(result)


def readable_text(path: Path, expected: str, most: int = TEXT) -> str:
    """The text of a file that should be `expected`. Raises ValueError with one line that names it."""
    data = readable(path, expected, most)
    try:
        return data.decode("utf-8-sig")  # Windows editors write a byte order mark
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        found_byte = f"byte 0x{data[error.start]:02x} in line {line}"
        raise ValueError(f"{path}: not UTF-8, {found_byte}: save it as UTF-8; expected {expected}") from None


def readable(path: Path, expected: str, most: int = TEXT) -> bytes:
    """All bytes of a file that should be `expected`. Raises ValueError with one line that names it."""
    try:
        return content(path, most)
    except FileNotFoundError as error:
        raise ValueError(f"{path}: {error.strerror}") from None
    except IsADirectoryError:
        raise ValueError(f"{path}: is a directory, expected {expected}") from None
    except OSError as error:
        raise ValueError(f"{path}: cannot be read: {error.strerror or error}") from None
    except ValueError as error:  # a NUL in the name
        raise ValueError(f"{show(str(path))}: {error}") from None


# -- TOML, with every digit of its numbers -----------------------------------------------------------------------------

_DEEPEST = 50
"""Parts of a dotted key. tomllib's time grows with their square: a line of 100 kB would take an hour."""

_DEEP_KEY = re.compile(rf"(?<![\w'\"-])(?:['\"\w-]++[ \t]*+\.[ \t]*+){{{_DEEPEST}}}")


def parse_toml(text: str) -> dict[str, Any]:
    """The document, floats as Decimal so that a unit can be applied before they are rounded.

    Raises ValueError (TOMLDecodeError is one; an integer of 5000 digits is another) and RecursionError.
    """
    deep = _DEEP_KEY.search(text)
    if deep is not None:
        line = text.count("\n", 0, deep.start()) + 1
        raise ValueError(f"a key of more than {_DEEPEST} parts (at line {line})")
    return tomllib.loads(text, parse_float=exact)


def exact(text: str) -> Decimal:
    """A float literal with every digit it has."""
    try:
        return Decimal(text)
    except InvalidOperation:  # an exponent too long even for Decimal
        return Decimal("Infinity") if "e-" not in text.lower() else Decimal(0)


def toml_value(value: Any) -> str:
    """A value in TOML, a number with all its digits."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return repr(value)
    if isinstance(value, Mapping):
        return f"{{ {', '.join(toml_line(key, item) for key, item in value.items())} }}"
    if isinstance(value, Sequence) and not isinstance(value, str):
        return "[" + ", ".join(toml_value(item) for item in value) + "]"
    return f'"{value}"' if isinstance(value, str) else str(value)


def toml_line(key: str, value: Any) -> str:
    """`key = value` in TOML."""
    return f"{key} = {toml_value(value)}"


def toml_text(document: Mapping[str, Any], comments: Mapping[str, Sequence[str]]) -> str:
    """The text of a document; `comments`: lines over the tables, by their names.

    Keys outside any table come first. A table of nothing but tables has none of its own: [task.pointing].
    """
    lines = [toml_line(key, value) for key, value in document.items() if not _is_table(value) and not _tables(value)]
    for key, value in document.items():
        if _is_table(value):
            inner = value and all(map(_is_table, value.values()))
            for title, table in ((f"{key}.{name}", part) for name, part in value.items()) if inner else [(key, value)]:
                lines += _table(f"[{title}]", title, table, comments)
        else:
            lines += [line for item in _tables(value) for line in _table(f"[[{key}]]", key, item, comments)]
    return "\n".join(lines) + "\n"


def _table(head: str, title: str, table: Mapping[str, Any], comments: Mapping[str, Sequence[str]]) -> list[str]:
    """The lines of a table, and those of the arrays of tables inside it."""
    above = [f"# {line}" for line in comments.get(table.get("name", title), ())]
    inner = {key: value for key, value in table.items() if _tables(value)}
    lines = ["", *above, head, *(toml_line(key, value) for key, value in table.items() if key not in inner)]
    for key, items in inner.items():
        lines += [line for item in items for line in ("", f"[[{title}.{key}]]", *starmap(toml_line, item.items()))]
    return lines


def _is_table(value: Any) -> bool:
    return isinstance(value, Mapping)


def _tables(value: Any) -> list[Mapping[str, Any]]:
    """The tables of an array of them; empty of anything else."""
    return value if isinstance(value, list) and value and all(map(_is_table, value)) else []


# -- documents of schema 1 in JSON and TOML: read strictly, every digit kept -------------------------------------------


def text_of(path: Path, expected: str, most: int, error: type[FileError]) -> str:
    """The text of a file of at most `most` bytes. Raises `error` with one line that names the file."""
    try:
        return readable_text(path, expected, most)
    except ValueError as problem:
        raise error([str(problem)]) from None


def parse_json(text: str) -> Any:
    """The value of a JSON text, floats as Decimal. Raises ValueError; a repeated key is an error."""

    def once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        table: dict[str, Any] = {}
        for key, value in pairs:
            if key in table:
                raise ValueError(f"key {show(key)} appears twice")
            table[key] = value
        return table

    return json.loads(text, parse_float=exact, object_pairs_hook=once)


def kind_of_text(text: str, is_json: bool) -> str:
    """The kind of a file by its text, one of KINDS; empty where it is none."""
    try:
        document = parse_json(text) if is_json else parse_toml(text)
    except (RecursionError, ValueError):
        return ""
    return kind_of(document) if isinstance(document, dict) else ""


def document_of(text: str, source: str, error: type[FileError], *kinds: str, is_json: bool = True) -> dict[str, Any]:
    """The keys of a file of schema 1, which is of one of these KINDS. Raises `error` with one line."""
    try:
        document = parse_json(text) if is_json else parse_toml(text)
        if is_json and "\\u" in text:  # half of a pair, such as \ud800, is no character
            json.dumps(document, ensure_ascii=False, default=str).encode()
    except (RecursionError, ValueError) as problem:
        if (kind := kind_of_text(text, not is_json)) and kind not in kinds:
            raise error([f"{source}: {wrong_kind(kind, *kinds)}"]) from None
        raise error([f"{source}: not {'JSON' if is_json else 'TOML'}: {problem}"]) from None
    if not isinstance(document, dict):
        raise error([f"{source}: expected an object, found {show(document)}"])
    if (kind := kind_of(document)) and kind not in kinds:
        raise error([f"{source}: {wrong_kind(kind, *kinds)}"])
    if "schema" not in document:
        raise error([f"{source}: schema: required, but missing"])
    if isinstance(document["schema"], bool) or document["schema"] != 1:
        raise error([f"{source}: schema: expected 1, found {show(document['schema'])}"])
    return {key: value for key, value in document.items() if key != "schema"}


# -- CSV: the first line names the columns, with units in brackets: `t [ms],torque [mN m]` -----------------------------

WORDS = Dimension("a text", "")
"""Dimension of a column of words, which has no unit."""

_HEAD = re.compile(r"\s*([^\[\]]*?)\s*(?:\[\s*([^\[\]]*?)\s*\])?\s*")


class TableError(FileError):
    """A table in a CSV file was refused."""


@dataclass(frozen=True, eq=False)
class Columns:
    """Columns of a table in SI, and those of texts, by name; `lines`: line of the file of each row."""

    path: Path
    numbers: Mapping[str, NDArray[np.float64]]
    texts: Mapping[str, list[str]]
    lines: list[int]

    @property
    def rows(self) -> int:
        """Number of rows."""
        return len(self.lines)

    def get(self, name: str) -> NDArray[np.float64]:
        """A column of numbers; zero where it is missing."""
        return self.numbers.get(name, np.zeros(self.rows))

    def refuse(self, row: int, words: str) -> TableError:
        """The error on a row, counted from 0."""
        return TableError([f"{self.path}, row {self.lines[row]}: {words}"])


def read_columns(
    path: Path, known: Mapping[str, Dimension], required: Collection[str], *, units: bool = True, empty: float = 0.0
) -> Columns:
    """The columns `known` of a CSV file, of which `required` must be there; `#` begins a line of comment.

    units   whether a column must have its unit; else it is in SI where it has none
    empty   what an empty cell stands for, NaN: nothing

    Raises TableError: no file, no unit, an unknown column, a cell that is no number.
    """
    (_, head), *rows = _lines(path)
    names, scales = zip(*(_head(path, cell, known, units) for cell in head), strict=True)
    for name in names:
        if names.count(name) > 1:
            raise TableError([f'{path}: column "{name}" appears twice'])
    for name in required:
        if name not in names:
            raise TableError([f'{path}: no column "{name}"'])
    table = Columns(path, numbers := {}, texts := {}, [line for line, _ in rows])
    for i, (_, cells) in enumerate(rows):
        if len(cells) != len(names):
            raise table.refuse(i, f"{len(cells)} cells, but the header has {len(names)}")
    for k, (name, scale) in enumerate(zip(names, scales, strict=True)):
        column = [cells[k].strip() for _, cells in rows]
        if known[name] is WORDS:
            texts[name] = column
            continue
        numbers[name] = np.array([float(cell) if _is_number(cell) else math.nan if cell else empty for cell in column])
        if (bad := np.flatnonzero(~np.isfinite(numbers[name]))).size:
            raise table.refuse(int(bad[0]), f'column "{name}": {show(column[bad[0]])} is not a number')
        numbers[name] *= scale
    return table


def split_head(head: str) -> tuple[str, str]:
    """Name and unit of a column by its head; "" where there is none, both where brackets do not match."""
    match = _HEAD.fullmatch(head)
    return ("", "") if match is None else (match[1], match[2] or "")


def _lines(path: Path) -> list[tuple[int, list[str]]]:
    """Cells of the lines that are no comment, each with its number."""
    try:
        reader = csv.reader(io.StringIO(content(path, TABLE).decode("utf-8-sig"), newline=""))
        rows = [(reader.line_num, row) for row in reader]
    except OSError as error:
        where = str(path) if len(str(path)) <= 500 else f"{str(path)[:200]} ... {str(path)[-200:]}"  # no system has it
        raise TableError([f"{where}: cannot be read: {error.strerror or error}"]) from None
    except (UnicodeDecodeError, ValueError, csv.Error) as error:
        raise TableError([f"{path}: not a CSV file: {error}"]) from None
    lines = [(k, row) for k, row in rows if any(cell.strip() for cell in row) and not row[0].lstrip().startswith("#")]
    if len(lines) < 2:
        raise TableError([f"{path}: expected a header and at least one row, found {len(lines)} lines"])
    return lines


def _head(path: Path, cell: str, known: Mapping[str, Dimension], units: bool) -> tuple[str, float]:
    """Name of a column and factor to SI."""
    name, unit = split_head(cell)
    if name not in known:
        raise TableError([f"{path}: unknown column {show(cell.strip())}{suggestion(name, known)}"])
    dimension, where = known[name], f'{path}, column "{name}"'
    if not dimension.si:
        if unit not in ("", "-", "1", "%"):
            raise TableError([f'{where}: unit "{unit}", expected a plain number, [-] or [%]'])
        return name, 0.01 if unit == "%" else 1.0
    if not unit and units:
        raise TableError([f"{where}: no unit; expected {dimension.words}, as [{dimension.si}]"])
    if "Hz" in unit and "(rad/s)" in dimension.si:
        raise TableError([f'{where}: unit "{unit}": Hz may be turns or radians by s; write rpm, rev/s or rad/s'])
    try:
        return name, float(factor(unit, dimension)) if unit else 1.0
    except QuantityError as error:
        raise TableError([f"{where}: {error}"]) from None


def _is_number(cell: str) -> bool:
    try:
        return math.isfinite(float(cell))
    except ValueError:
        return False
