"""Stand file -> Stand, and back. Problems of a file are reported together, but those that mended keys decide."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass, fields
from functools import partial, reduce
from operator import getitem
from pathlib import Path
from types import MappingProxyType
from typing import Any, Generic, TypeVar

from mahovik.core.stand import physical
from mahovik.core.stand.coordinates import check_tasks, name_of_task_problem
from mahovik.core.stand.datasheet import FlywheelForm, Moments, moments_of, thin_disc
from mahovik.core.stand.fields import ZERO3
from mahovik.core.stand.files import TEXT, kind_of, parse_toml, text_of, toml_text, wrong_kind
from mahovik.core.stand.law import BodyLaw, CarrierLaw, HeldLaw
from mahovik.core.stand.laws import (
    arrays,
    body_laws,
    carrier_laws,
    headers,
    held_laws,
    hold_table,
    mounted_keys,
    mounted_laws,
    tables,
)
from mahovik.core.stand.model import (
    Body,
    Carrier,
    Flywheel,
    Header,
    Hold,
    Instrument,
    Law,
    Point,
    Stand,
    StreamProfile,
    Task,
)
from mahovik.core.stand.tables import Problems, Table, keys_of, read_table
from mahovik.core.stand.units import show
from mahovik.errors import StandError
from mahovik.nearest import nearest, suggestion

AnyBody = TypeVar("AnyBody", bound=Body)
_Item = tuple[str, Any, Any]
"""The words that name a table, its keys in the file, and the valid table."""

_CHECKED = {
    "mass", "center_of_mass", "inertia", "inertia_about", "spin_inertia", "transverse_inertia", "unbalance",
    "axis", "zero", "angles",
}  # fmt: skip


def load(path: str | Path) -> Stand:
    """Read and check the stand file at `path`. Raises StandError with every problem found."""
    return read(document_at(path), Path(path).name)


def loads(text: str, source: str = "stand") -> Stand:
    """Read and check a stand given as text; `source` names it in messages. Raises StandError."""
    return read(_document(text, source), source)


def document_at(path: str | Path) -> dict[str, Any]:
    """The keys of the stand file at `path`, floats as Decimal, not checked. Raises StandError of other files."""
    path = Path(path)
    return _document(text_of(path, "a stand file (TOML)", TEXT, StandError), path.name)


def _document(text: str, source: str) -> dict[str, Any]:
    """The keys of a stand file's text. Raises StandError where it is none."""
    try:
        document = parse_toml(text)
    except (RecursionError, ValueError) as error:
        if text.lstrip().startswith("{"):
            raise StandError(
                [f"{source}: is JSON, as motions and programmes are; expected a stand file (TOML)"]
            ) from None
        raise StandError([f"{source}: not TOML: {error}"]) from None
    if "carrier" not in document and (kind := kind_of(document)):
        raise StandError([f"{source}: {wrong_kind(kind, 'stand')}"])
    return document


def read(document: dict[str, Any], source: str, physics: bool = True) -> Stand:
    """Check a parsed stand file (floats as Decimal) and make a Stand of it. Raises StandError.

    Without `physics` it is not asked whether there can be such bodies, and whether the rows of tasks go together: of
    columns see `screening`.
    """
    problems = Problems(source)
    header = _header(document, problems)
    if any(line.endswith("this version reads schema 1") for line in problems.lines):
        raise StandError([line for line in problems.lines if "schema" in line])  # all else would be noise

    if "carrier" not in document:
        problems.add("carrier", "required, but missing")
    laws = [_law(problems, document, law) for law in carrier_laws() if law not in held_laws()]
    parts = {
        law: {key: [table for *_, table in _array(problems, document, key)] for key in law.made_of}
        for law in carrier_laws()
    }
    mounted = {law: [table for *_, table in _array(problems, document, law.key)] for law in mounted_laws()}
    carriers = _bodies(problems, Carrier, _table(problems, document, "carrier"), mounted)
    instruments = _bodies(problems, Instrument, _array(problems, document, "instrument"), mounted)
    flywheels = _bodies(problems, Flywheel, _array(problems, document, "flywheel"), mounted)
    points = tuple(Point.of_table(table) for *_, table in _array(problems, document, "point"))
    _check_names(problems, document)
    if header is not None and header.phase_input != "angle" and not document.get("flywheel"):
        problems.add("phase_input", f"{show(header.phase_input)} says how phases are given, but there is no flywheel")
    profile = None
    for where, _, table in _table(problems, document, "stream_profile") if header is not None else ():
        profile = StreamProfile.read(table, header.gravity, header.stream or ZERO3, partial(problems.add, where))
    tasks = _tasks(problems, document)
    hold, held = _hold(problems, document)
    if tasks and "hold" in document:
        problems.add("task", "tasks of a carrier with [hold] are not there yet: expected one without the other")
    if physics:
        check_tasks(problems, tasks, tuple(entry.body for entry in instruments), points)
        bodies: list[_ReadBody[Any]] = [*carriers, *instruments, *flywheels]
        for entry in bodies:
            advice = thin_disc(entry.table, entry.moments) if isinstance(entry.table, FlywheelForm) else ""
            physical.check_body(entry.body, entry.where, problems, entry.moments, advice)
    if problems.lines or header is None:
        raise StandError(problems.lines)
    stream = ZERO3 if header.stream is None and profile is not None else header.stream
    stand = Stand(
        **vars(Header.of_table(header, stream=stream)),
        carrier=carriers[0].body,
        instruments=tuple(entry.body for entry in instruments),
        flywheels=tuple(entry.body for entry in flywheels),
        points=points,
        tasks=tasks,
        hold=hold,
        profile=profile,
        laws=tuple(law for law in (*laws, *held) if law is not None),
    )
    for law, tables_of in parts.items():
        stand = law.of_parts(stand, document.get(law.key), tables_of, problems.add)
    if physics:
        physical.check_stand(stand, problems)
    if problems.lines:
        raise StandError(problems.lines)
    return stand


def _header(document: dict[str, Any], problems: Problems) -> Any:
    """The valid keys of the stand outside any table; None where they are not in order."""
    own_keys = keys_of(Header.table())
    known = [*(key for header in headers() for key in keys_of(header)), *tables(), *arrays(), "task", "hold"]
    for key in document:
        if key not in known:
            problems.add(f"unknown key {show(key)}{suggestion(key, known)}")
    return _valid(problems, "", Header.table(), {key: value for key, value in document.items() if key in own_keys})


def _law(problems: Problems, document: dict[str, Any], law: type[CarrierLaw]) -> Law | None:
    """The data of one law; None where the file does not have it, or not in order."""
    header = None
    if (header_table := law.header_table()) is not None:
        raw = {key: value for key, value in document.items() if key in keys_of(header_table)}
        header = _valid(problems, "", header_table, raw)
    items = (_table if law.item is None else _array)(problems, document, law.key)
    return law.read(header, [table for *_, table in items])


def _hold(problems: Problems, document: dict[str, Any]) -> tuple[Hold | None, list[Law | None]]:
    """`[hold]`, and the laws whose tables are its own; None, and no laws, without, or where it is not in order."""
    in_order, raw = len(problems.lines), document.get("hold", {})
    if not isinstance(raw, dict):
        expected = 'expected one table, [hold] with a line such as freedoms = ["yaw"]'
        problems.add("hold", f"{expected}, found {show(raw)}")
    table = _valid(problems, "hold", hold_table(), raw) if isinstance(raw, dict) and "hold" in document else None
    note = partial(problems.add, "hold")
    hold = Hold.read(table, note) if table is not None and len(problems.lines) == in_order else None
    if hold is None:
        return None, []
    return hold, [law.read_held(getattr(table, law.key), hold, note) for law in held_laws()]


@dataclass(frozen=True)
class _ReadBody(Generic[AnyBody]):
    """A body; the words that name it, its table, and how its moments of inertia are shown."""

    body: AnyBody
    where: str
    table: Any
    moments: Moments


def _bodies(
    problems: Problems, kind: type[AnyBody], items: list[_Item], mounted: Mapping[type[BodyLaw], list[Any]]
) -> list[_ReadBody[AnyBody]]:
    """The bodies of valid tables with all laws on them, as far as they are known."""
    bodies = []
    for where, raw, table in items:
        name, moments = getattr(table, "name", "carrier"), moments_of(raw)
        raw_laws = {law: getattr(table, law.key) for law in body_laws() if not law.mounted}
        laws: list[Law | None] = [law.read(raw_law) for law, raw_law in raw_laws.items() if raw_law is not None]
        laws += [law.read_mounted([item for item in items if item.mount == name]) for law, items in mounted.items()]
        acting = tuple(law for law in laws if law is not None)
        body = kind.read(table, partial(problems.add, where), moments, name=name, laws=acting)
        if body is not None:
            bodies.append(_ReadBody(body, where, table, moments))
    return bodies


def _valid(problems: Problems, where: str, table: type[Table], raw: Any) -> Any:
    """The valid table; None where it is not in order, which is noted.

    It is read without its unreadable keys, and lists of tables without such items, so that unphysical values in the
    rest are reported as well, unless a bad key says, or may be meant to say, what the checks of a body take.
    """
    valid, faults = read_table(table, raw)
    problems.add_all(where, faults)
    if valid is not None or not isinstance(raw, dict):
        return valid
    known = keys_of(table)
    items = (next((i for i, step in enumerate(way) if isinstance(step, int)), 0) for way, *_ in faults)
    bad = {way[: last + 1] for (way, *_), last in zip(faults, items, strict=True) if way}
    bad |= {(key,) for key in raw.keys() - known}
    if not bad or {nearest(str(way[0]), known) for way in bad} & _CHECKED:
        return None
    rest = deepcopy(raw)
    for *way, last in sorted(bad, reverse=True):  # of a list the last first
        place = reduce(getitem, way, rest)
        if isinstance(place, list) or last in place:
            del place[last]
    return read_table(table, rest)[0]


def _table(problems: Problems, document: dict[str, Any], key: str) -> list[_Item]:
    """The valid table [key], if there is one."""
    table = _valid(problems, key, tables()[key], document[key]) if key in document else None
    return [] if table is None else [(key, document[key], table)]


def _array(problems: Problems, document: dict[str, Any], key: str) -> list[_Item]:
    """The valid tables [[key]]."""
    raw = document.get(key, [])
    if not isinstance(raw, list):
        problems.add(key, f"expected an array of tables, [[{key}]], found {show(raw)}")
        return []
    result = []
    for i, item in enumerate(raw):
        name = item.get("name") if isinstance(item, dict) else None
        where = f"{key} {show(name)}" if isinstance(name, str) else f"{key}[{i}]"
        if (table := _valid(problems, where, arrays()[key], item)) is not None:
            result.append((where, item, table))
    return result


def _tasks(problems: Problems, document: dict[str, Any]) -> tuple[Task, ...]:
    """The valid tasks, in the file's order."""
    raw = document.get("task", {})
    if not isinstance(raw, dict):
        problems.add("task", f"expected tables [task.NAME], found {show(raw)}")
        return ()
    if raw and not document.get("flywheel"):
        problems.add("task", "a task is what flywheels are to do, but there is no flywheel")
    tasks = []
    for name, item in raw.items():
        where = f"task {show(name)}"
        if (problem := name_of_task_problem(name)) is not None:
            problems.add(where, problem)
        if (table := _valid(problems, where, Task.table(), item)) is not None:
            tasks.append(Task.of_table(table, name=name))
    return tuple(tasks)


def _tables_with_names(document: dict[str, Any], key: str) -> list[tuple[str, dict[str, Any]]]:
    raw = document.get(key, [])
    items = [item for item in raw if isinstance(item, dict)] if isinstance(raw, list) else []
    return [(item["name"], item) for item in items if isinstance(item.get("name"), str)]


def _check_names(problems: Problems, document: dict[str, Any]) -> None:
    """No two bodies or points of one name; every mount is the carrier or an instrument."""
    taken = {"carrier": "the carrier"}
    mounted = ("flywheel", "point", *mounted_keys())
    for key in ("instrument", *mounted, *(key for law in carrier_laws() for key in law.made_of)):
        for name, _ in _tables_with_names(document, key):
            if name in taken:
                problems.add(f"{key} {show(name)}", "name", f"taken by {taken[name]}")
            else:
                taken[name] = f"{'an' if key[0] == 'i' else 'a'} {key}"
    mounts = ["carrier", *(name for name, _ in _tables_with_names(document, "instrument"))]
    flywheels = {name for name, _ in _tables_with_names(document, "flywheel")}
    for key in mounted:
        for name, item in _tables_with_names(document, key):
            mount = item.get("mount", "carrier")
            if not isinstance(mount, str) or mount in mounts:
                continue
            if mount in flywheels:
                reason = f'{show(mount)} is a flywheel, expected "carrier" or an instrument'
            else:
                reason = f"unknown {show(mount)}{suggestion(mount, mounts)}"
            problems.add(f"{key} {show(name)}", "mount", reason)


# -- Stand -> stand file in SI, every float with all its digits: reading it back gives the same Stand ------------------

_NONE: Mapping[str, Sequence[str]] = MappingProxyType({})


def document_of(stand: Stand) -> dict[str, Any]:
    """The keys of a stand file, in SI."""
    header = Header(**{f.name: getattr(stand, f.name) for f in fields(Header)})
    laws = [law for kind in carrier_laws() if (law := stand.law(kind)) is not None]
    held = {law.key: [item.as_keys() for item in law.items] for law in laws if isinstance(law, HeldLaw)}
    document = {"schema": 1, **header.as_keys()}
    tables: dict[str, Any] = {}
    for law in (law for law in laws if law.key not in held):
        if law.item is not None:
            document |= law.as_keys()
        tables |= law.as_tables()
    if stand.profile is not None:
        document["stream_profile"] = stand.profile.as_keys()
    document |= {"carrier": stand.carrier.as_keys(), **tables}
    if stand.hold is not None:
        document["hold"] = stand.hold.as_keys() | held
    document |= {
        "instrument": [instrument.as_keys() for instrument in stand.instruments],
        "flywheel": [flywheel.as_keys() for flywheel in stand.flywheels],
        "point": [point.as_keys() for point in stand.points],
    }
    for kind in mounted_laws():
        document[kind.key] = [
            {"mount": body.name, **item.as_keys()} for _, body, law in kind.of(stand) for item in law.items
        ]
    document["task"] = {task.name: task.as_keys() for task in stand.tasks}
    return {key: value for key, value in document.items() if value not in ([], {})}


def dumps(stand: Stand, comments: Mapping[str, Sequence[str]] = _NONE) -> str:
    """The stand as TOML text. `loads(dumps(stand)) == stand`, except all-zero parts, which are absent.

    `comments`: lines over the table of a body or point, by its name.
    """
    return toml_text(document_of(stand), comments)
