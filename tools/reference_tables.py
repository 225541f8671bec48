"""Tables of the reference pages, made of the code: keys of the stand file, functions, statuses and ranges of the C."""

from __future__ import annotations

import inspect
import json
import re
import sys
import typing
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import MISSING, is_dataclass
from functools import cache, partial
from pathlib import Path
from typing import Annotated, Any

from mahovik.contract.evaluation import text_lines
from mahovik.contract.functions import ALL, CHOSEN, JUDGES, ROWS, task_of
from mahovik.contract.quantities import BOUNDS, QUANTITIES, Bound
from mahovik.contract.status import STATUSES
from mahovik.core.emit.declaration import purpose_with_number
from mahovik.core.emit.generate import generate_all
from mahovik.core.lower.limits import THRESHOLDS
from mahovik.core.motion.motion_file import MotionTable, SlewTable
from mahovik.core.motion.programme import Programme
from mahovik.core.motion.regime import DrivenTable
from mahovik.core.program.call import Argument
from mahovik.core.program.cost import cost, stack_bound
from mahovik.core.program.function import Function, Program
from mahovik.core.program.types import NamedCount, Shape, Struct
from mahovik.core.stand import load
from mahovik.core.stand.datasheet import UnbalanceTable
from mahovik.core.stand.declare import Declared, Tables
from mahovik.core.stand.fields import Mat3, Mat6, Vec3
from mahovik.core.stand.law import BodyLaw, Bounds, FreedomItem, HeldLaw
from mahovik.core.stand.laws import body_laws, body_table, carrier_laws
from mahovik.core.stand.model import (
    Carrier,
    Encoder,
    Flywheel,
    Header,
    Hold,
    Instrument,
    Motor,
    Point,
    StreamProfile,
    Task,
)
from mahovik.core.stand.tables import Key, QuantityValidator, Table, declared_keys
from mahovik.core.stand.units import Dimension
from mahovik.out.campaign.file import CampaignTable
from mahovik.out.campaign.quantities import QuantityTable
from mahovik.stands import path

HELD = Path(__file__).resolve().parents[1] / "docs" / "held" / "pendulum.toml"


def table(head: tuple[str, ...], rows: Iterable[tuple[str, ...]]) -> Iterator[str]:
    """Lines of a table; pipes in its cells are text."""
    yield f"| {' | '.join(head)} |"
    yield "|---" * len(head) + "|"
    for row in rows:
        yield f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in row)} |"


# -- keys of the stand file ------------------------------------------------------------------------------------------


def entries(*classes: type) -> dict[str, str]:
    """Meanings of keys: lines `key  meaning` of the docstrings of these classes and their bases, the first of each."""
    meanings: dict[str, str] = {}
    for cls in (base for first in classes for base in first.__mro__):
        key = ""
        for line in inspect.cleandoc(cls.__dict__.get("__doc__") or "").splitlines():
            match = re.fullmatch(r"(\w+)  +(\S.*)", line)
            if match:
                key = match[1] if match[1] not in meanings else ""
            elif not line.startswith("  "):
                key = ""
            if key:
                meanings[key] = f"{meanings.get(key, '')} {match[2] if match else line.strip()}".lstrip()
    return meanings


Rows = Callable[[], Iterable[tuple[str, ...]]]


def key_rows(keys: type, data: type, known: type[Table] | None = None) -> Iterator[tuple[str, ...]]:
    """A row for each key of a table of the file, as its class declares it, less those that `known` has likewise."""
    meanings = {law.key: law_words(law) for law in body_laws() if not law.mounted} | entries(
        getattr(data, "keys", data), keys, data
    )
    first = ("schema_", "name", "freedom", "mount", "position", "wrench", "of")
    likewise = {key.key: key.default for key in declared_keys(known)} if known else {}
    for key in sorted(declared_keys(keys), key=lambda key: (*first, key.name).index(key.name)):
        if key.key not in likewise or likewise[key.key] != key.default:
            default = "required" if key.default is MISSING else default_words(key.default, key.validator)
            words = meanings.get(key.key) or sys.exit(f"{data.__name__}: {key.key} has no entry in its docstring")
            yield f"`{key.key}`", value_words(data, key), default, words


def law_words(law: type) -> str:
    """What a law of a body is, as a link to its keys."""
    words = inspect.cleandoc(law.__doc__ or "").partition("\n")[0]
    words = re.split(r": |, (?:wrench|products|in) |, `", words)[0].rstrip(".")
    return f"[{words}](#{law.__dict__['key']})"


SHAPES: tuple[tuple[Any, str], ...] = (
    (float, "number"),
    (int, "whole number"),
    (bool, "`true`, `false`"),
    (str, "text"),
    (Vec3, "3 numbers"),
    (Mat3, "3x3"),
    (Mat6, "6x6"),
    (tuple[Vec3, ...], "list of 3 numbers"),
    (tuple[float, ...], "numbers"),
    (Any, "list"),
)
"""Words for types of keys."""


def value_words(data: type, key: Key) -> str:
    """What a key takes: shape, unit and bounds, or its words."""
    if issubclass(data, FreedomItem) and (bounds := data.marked(Bounds).get(key.name)):
        units = dict.fromkeys(of.si for kind in ("slide", "turn") if (of := data.dimension(key.name, kind)))
        return ", ".join([" or ".join(units), *bound_words(bounds)])
    kind, reader = typed(key.annotation), key.validator
    origin = typing.get_origin(kind)
    if key.table is not None or origin in (dict, Mapping) or is_dataclass(kind):
        return "tables" if origin in (list, Sequence) else "table"
    if origin is typing.Literal:
        return ", ".join(f'`"{word}"`' for word in typing.get_args(kind))
    plain = next((words for shape_type, words in SHAPES if shape_type == kind), "list" if origin else "number")
    if reader is None:
        return plain
    if reader.words:
        return ", ".join(f'`"{word}"`' for word, _ in reader.words)
    shape = reader.shape or ("list" if plain == "number" and kind is not float else plain)
    unit = reader.dimension.si if isinstance(reader.dimension, Dimension) else ""
    parts = ["" if shape == "number" and unit else shape, unit, *bound_words(reader)]
    return ", ".join(part for part in parts if part)


def typed(annotation: Any) -> Any:
    """The type in an annotation that may be None."""
    inner = [argument for argument in typing.get_args(annotation) if argument is not type(None)]
    if typing.get_origin(annotation) is Annotated or type(None) in typing.get_args(annotation):
        return typed(inner[0])
    return annotation


def bound_words(bounds: QuantityValidator | Bounds) -> list[str]:
    """The bounds of a number in words."""
    least, above, most = bounds.least, bounds.above, bounds.most
    if least is not None and most is not None:
        return [f"{digits(least)} to {digits(most)}"]
    parts = [f"above {digits(above)}"] if above is not None else [] if least is None else [f"at least {digits(least)}"]
    return parts if most is None else [*parts, f"at most {digits(most)}"]


def digits(value: float) -> str:
    """A number in its shortest form: 1e5, 0.1, 1e-6."""
    texts = (f"{value:.6e}", f"{value:.0e}", f"{value:g}", f"{value:.17g}")
    exact = (re.sub(r"e\+?(-?)0*", r"e\1", text) for text in texts if float(text) == value)
    return min(exact, key=len)


def default_words(value: Any, reader: QuantityValidator | None) -> str:
    """A default as the file would have it."""
    if reader is not None and reader.words:
        return next((f'`"{word}"`' for word, meant in reader.words if meant == value), "none")
    if value is None or value in ((), {}, "") or is_dataclass(value):
        return "none"
    if isinstance(value, bool | str):
        return f"`{json.dumps(value)}`"
    if isinstance(value, tuple):
        flat = [x for item in value for x in (item if isinstance(item, tuple) else (item,))]
        return f"`[{', '.join(map(digits, flat))}]`" if any(flat) else "0"
    return digits(value)


def key_tables() -> dict[str, Callable[[], Iterable[str]]]:
    """Tables of keys, by the name of their mark on the page."""
    laws = {law.key: law.item or law for law in (*carrier_laws(), *body_laws())}
    parts = {key: part for law in carrier_laws() for key, part in law.made_of.items()}
    plain: dict[str, type[Declared]] = {
        "point": Point, "motor": Motor, "encoder": Encoder, "hold": Hold, "task": Task,
        "stream_profile": StreamProfile, **laws, **parts,
    }  # fmt: skip
    plain |= {f"{key} {name}": mark.of for key, law in laws.items() for name, mark in law.marked(Tables).items()}
    carrier = body_table(Carrier)
    rows: dict[str, Rows] = {key: partial(key_rows, data.table(), data) for key, data in plain.items()}
    rows["carrier"] = partial(key_rows, carrier, Carrier)
    rows["instrument"] = partial(key_rows, body_table(Instrument), Instrument, carrier)
    rows["flywheel"] = partial(key_rows, body_table(Flywheel), Flywheel, carrier)
    rows["unbalance"] = partial(key_rows, UnbalanceTable, Flywheel)
    rows["top"] = top_rows
    rows["campaign"] = partial(key_rows, CampaignTable, CampaignTable)
    rows["regime"] = partial(key_rows, DrivenTable, DrivenTable)
    rows["motion"] = partial(key_rows, MotionTable, MotionTable)
    rows["slew"] = partial(key_rows, SlewTable, SlewTable)
    rows["programme"] = partial(key_rows, Programme, Programme)
    rows["quantity"] = partial(key_rows, QuantityTable, QuantityTable)
    return {f"keys {key}": partial(key_table, make_rows) for key, make_rows in rows.items()}


def key_table(rows: Rows) -> Iterator[str]:
    """A table of keys."""
    return table(("key", "value", "default", "meaning"), rows())


def top_rows() -> Iterator[tuple[str, ...]]:
    """Keys outside any table: those of the stand, then those of laws."""
    yield from key_rows(Header.table(), Header)
    for law in carrier_laws():
        if keys := law.header_table():
            yield from (row for row in key_rows(keys, law) if row[0].strip("`") in law.header)


def law_lines() -> Iterator[str]:
    """The table of laws, in the order in which their wrenches are added up."""
    rows = [("`laws/weight`", "`gravity`", "every body", "Force of gravity at the centre of mass")]
    for law in (*body_laws(), *carrier_laws()):
        data = law.item or law
        words = inspect.cleandoc(data.__doc__ or "").partition("\n")[0].rstrip(".")
        prefix, bearer = "", "carrier"
        if issubclass(law, HeldLaw):
            prefix, bearer = "hold.", "freedoms"
        elif law.mounted:
            bearer = "carrier, instruments"
        elif issubclass(law, BodyLaw):
            bearer = "every body"
        key = f"`[[{prefix}{law.key}]]`" if law.item else f"`{law.key}`"
        rows.append((f"`laws/{law.__module__.split('.')[2]}`", key, bearer, words))
    return table(("folder", "keys", "acts on", "what it is"), rows)


# -- functions of the C ----------------------------------------------------------------------------------------------


COMMON = ("OK", "NOT_FINITE", "RANGE", "BAD_ARGUMENT")
"""Statuses that nearly every function can return."""


@cache
def functions() -> dict[str, tuple[str, Function, Program]]:
    """Public functions by name, in the order of the contract, of the first stand that has each; tasks are `_TASK`."""
    by_name: dict[str, tuple[str, Function, Program]] = {}
    for stand in (path("bench8"), path("sat4"), path("auv6"), HELD):
        made = generate_all(load(stand), only=ALL)
        for function in made.program.functions:
            if function.public:
                task = task_of(function.name)
                name = function.name.replace(f"_{task}", "_TASK") if task else function.name
                by_name.setdefault(name, (Path(stand).stem, function, made.program))
    order = [*ROWS, *CHOSEN]
    return dict(sorted(by_name.items(), key=lambda item: order.index(item[0].removesuffix("_TASK"))))


def function_lines() -> Iterator[str]:
    """The table of functions: what each does, takes and returns, and what it costs."""
    rows = []
    for name, (stand, function, program) in functions().items():
        taken = ", ".join(a.name + lengths(a.shape) for a in function.arguments if a.direction != "out")
        results = ", ".join(map(result_text, (a for a in function.arguments if a.direction != "in")))
        more = [f"`{status}`" for status in function.statuses if status not in COMMON]
        does = purpose_with_number(function).replace(f"the task {task_of(function.name)}", "a task")
        text = f"{does[0].upper()}{does[1:]} Takes `{taken}`; gives `{results}`."
        if more:
            text += f" Also returns {', '.join(more)}."
        counted = f"{cost(function, program.whole).total:,}" + ("" if stand == "bench8" else f" ({stand})")
        rows.append((f"`{name}`", text, counted, f"{stack_bound(function, program):,}"))
    return table(("function", "what it does, takes, gives and returns", "operations", "stack"), rows)


def lengths(shape: Shape) -> str:
    """Lengths of an array, `[N][6]`."""
    return "".join(f"[{length.name if isinstance(length, NamedCount) else length}]" for length in shape)


def result_text(result: Argument) -> str:
    """A result with its lengths; of a struct of its own, its members."""
    if isinstance(result.type, Struct) and result.name == "out" and not result.shape:
        return ", ".join(f"{field.name}{lengths(field.shape)}" for field in result.type.fields)
    return f"{result.name}{lengths(result.shape)}"


def argument_lines() -> Iterator[str]:
    """The table of quantities that functions take: numbers, unit, frame, accepted range."""
    taken = {name for row in (*ROWS.values(), *CHOSEN.values()) for name in row.takes}
    members = ("position", "attitude", "V", "phi", "phi_dot")
    counts = {"W": "6 each", "": "1"}
    special_counts = {"demand": "rows", "q": "freedoms"}
    rows = []
    for quantity in QUANTITIES.values():
        if (quantity.symbol in taken or quantity.symbol in members) and quantity.axes and not quantity.struct:
            of = "`x`: " if quantity.symbol in members else ""
            limits = ", ".join(f"`{name}`" for name in quantity.bounds)
            rows.append(
                (
                    f"`{quantity.symbol}`",
                    special_counts.get(quantity.symbol, counts.get(quantity.count, quantity.count)),
                    quantity.unit,
                    of + quantity.axes,
                    limits,
                )
            )
    return table(("argument", "numbers", "unit", "of, in", "range"), rows)


def status_lines() -> Iterator[str]:
    """The table of statuses."""
    double, single = THRESHOLDS["double"], THRESHOLDS["float"]
    both = "{} (`float`: {})".format
    words = {
        "unreachable": both(digits(double.unreachable), digits(single.unreachable)),
        "rank": both(digits(double.rank), digits(single.rank)),
        "lengths": "a quaternion or (sine, cosine) off unit length",
    }
    return table(
        ("name", "value", "when"),
        ((f"`{status.name}`", str(status.value), status.meaning.format(**words)) for status in STATUSES),
    )


def range_lines() -> Iterator[str]:
    """The table of ranges."""

    def value(bound: Bound) -> str:
        double, single = digits(bound.at("double")), digits(bound.at("float"))
        return double if single == double else f"{double}; in `float` {single}"

    return table(
        ("macro", "value", "limits"),
        (
            (f"`{limit.name}`", value(limit), ", ".join(filter(None, (limit.comment, limit.unit))))
            for limit in BOUNDS.values()
        ),
    )


def judge_names() -> Iterator[str]:
    """The table of the independent checks of functions."""
    return table(("judge", "what it is"), ((f"`{name}`", words) for name, words in JUDGES.items()))


def judge_lines() -> Iterator[str]:
    """The table of who offers and judges each function; forms that take sines have the row of their function."""
    rows = []
    for row in (ROWS | CHOSEN).values():
        marks = ("yes" if row.want else "", "yes" if row.batch else "", "yes" if row.python else "")
        rows.append((f"`{row.name}`", *marks, ", ".join(row.judges)))
    return table(("function", "`eval`", "batch", "Python", "judges"), rows)


def contract_lines() -> Iterable[str]:
    """The contract of programs that are judged, as `eval --help` shows it."""
    return ["```text", *text_lines(), "```"]


MADE: dict[str, Callable[[], Iterable[str]]] = {
    **key_tables(),
    "laws": law_lines,
    "functions": function_lines,
    "arguments": argument_lines,
    "statuses": status_lines,
    "ranges": range_lines,
    "judges": judge_lines,
    "judge names": judge_names,
    "contract": contract_lines,
}
"""What stands between marks on pages, by the name of the mark."""
