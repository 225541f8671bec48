"""Stand file -> Stand. Every problem of the file is found before any is reported."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, TypeVar

from pydantic import ValidationError

from mahovik.core.stand import build, datasheet, physical
from mahovik.core.stand.content import readable
from mahovik.core.stand.fields import ZERO3, Table
from mahovik.core.stand.hold import HoldTable, hold_of
from mahovik.core.stand.law import BodyLaw, CarrierLaw
from mahovik.core.stand.laws import (
    AnyTable,
    carrier_laws,
    held_laws,
    hold_with_laws,
    law_arrays,
    law_headers,
    law_tables,
    mounted_keys,
    mounted_laws,
    with_laws,
)
from mahovik.core.stand.model import Carrier, Flywheel, Hold, Instrument, LawData, Point, Stand, StreamProfile, Task
from mahovik.core.stand.problems import Problems, keys_of
from mahovik.core.stand.profile import check_profile
from mahovik.core.stand.schema import (
    CarrierTable,
    FlywheelTable,
    Header,
    InstrumentTable,
    PointTable,
    StreamProfileTable,
)
from mahovik.core.stand.task import TaskTable, check_tasks, name_of_task_problem
from mahovik.core.stand.toml import parse
from mahovik.core.stand.units import show
from mahovik.errors import StandError
from mahovik.nearest import nearest, nearest_name, suggestion

AnyBody = TypeVar("AnyBody", Carrier, Instrument)

_CHECKED = {
    "mass", "center_of_mass", "inertia", "inertia_about", "spin_inertia", "transverse_inertia", "unbalance",
    "axis", "zero", "angles",
}  # fmt: skip
_ARRAYS: dict[str, type[Table]] = {"instrument": InstrumentTable, "flywheel": FlywheelTable, "point": PointTable}


_OTHERS = {"sample_period": "a file of servos", "default": "a regime", "wrench": "a regime"}
"""Keys of other files in TOML, and what these are."""


def load(path: str | Path) -> Stand:
    """Read and check the stand file at `path`. Raises StandError with every problem found."""
    path = Path(path)

    def neighbour() -> str:
        best = nearest_name(path.stem, sorted(each.stem for each in path.parent.glob("*.toml")))
        return "" if best is None else f', did you mean "{path.with_name(f"{best}.toml")}"?'

    try:
        found = readable(path, "a stand file (TOML)", neighbour)
    except ValueError as error:
        raise StandError([str(error)]) from None
    try:
        text = found.decode("utf-8-sig")  # Windows editors write a byte order mark
    except UnicodeDecodeError as error:
        line = found.count(b"\n", 0, error.start) + 1
        raise StandError([f"{path.name}: not UTF-8, byte 0x{found[error.start]:02x} in line {line}"]) from None
    return loads(text, path.name)


def loads(text: str, source: str = "stand") -> Stand:
    """Read and check a stand given as text; `source` names it in messages. Raises StandError."""
    try:
        document = parse(text)
    except (RecursionError, ValueError) as error:
        if text.lstrip().startswith("{"):
            raise StandError(
                [f"{source}: is JSON, as motions and programmes are; expected a stand file (TOML)"]
            ) from None
        raise StandError([f"{source}: not TOML: {error}"]) from None
    other = next((what for key, what in _OTHERS.items() if key in document and "carrier" not in document), None)
    if other is not None:
        raise StandError([f"{source}: is {other}; expected a stand file, with [carrier]"])
    return read(document, source)


def read(document: dict[str, Any], source: str, physics: bool = True) -> Stand:
    """Check a parsed stand file (floats as Decimal) and make a Stand of it. Raises StandError.

    Without `physics` it is not asked whether there can be such bodies, and whether the rows of tasks go together: of
    columns see `screening`.
    """
    problems = Problems(source)
    header = _header(document, problems)
    if any(line.endswith("this version reads schema 1") for line in problems.lines):
        raise StandError([line for line in problems.lines if "schema" in line])  # all else would be noise

    carrier_table = _table(problems, document, "carrier", with_laws(CarrierTable))
    if "carrier" not in document:
        problems.add("carrier", "required, but missing")
    laws = [_law(problems, document, law) for law in carrier_laws() if law not in held_laws()]
    instrument_tables = _array(problems, document, "instrument", with_laws(InstrumentTable))
    flywheel_tables = _array(problems, document, "flywheel", with_laws(FlywheelTable))
    point_tables = _array(problems, document, "point", PointTable)
    _check_names(problems, document)
    if header is not None and header.phase_input != "angle" and not document.get("flywheel"):
        problems.add("phase_input", f"{show(header.phase_input)} says how phases are given, but there is no flywheel")

    mounted = [(law, _array(problems, document, law.key, law_arrays()[law.key])) for law in mounted_laws()]
    carrier = build.carrier(carrier_table, problems) if carrier_table else None
    instruments: list[Instrument] = [build.instrument(table, where, problems) for where, table in instrument_tables]
    wheels = [build.flywheel(table, where, problems) for where, table in flywheel_tables]
    flywheels: list[Flywheel] = [wheel for wheel in wheels if wheel is not None]
    points: list[Point] = [build.point(table) for _, table in point_tables]
    profile = _profile(problems, document, header)
    tasks = _tasks(problems, document)
    in_order = len(problems.lines)
    hold_table = _hold_table(problems, document)
    hold = hold_of(hold_table, problems) if hold_table and len(problems.lines) == in_order else None
    if hold_table and hold:
        laws += _held_laws(problems, hold_table, hold)
    if tasks and "hold" in document:
        problems.add("task", "tasks of a carrier with [hold] are not there yet: expected one without the other")
    if physics:
        check_tasks(problems, tasks, tuple(instruments), tuple(points))
        if carrier is not None and carrier_table is not None:
            physical.check_body(_bearing(carrier, mounted), "carrier", problems, carrier_table.moments)
        for (_, own), instrument in zip(instrument_tables, instruments, strict=True):
            physical.check_body(_bearing(instrument, mounted), f'instrument "{instrument.name}"', problems, own.moments)
        for (_, table), wheel in zip(flywheel_tables, wheels, strict=True):
            if wheel is not None:
                advice = datasheet.thin_disc(table)
                physical.check_body(wheel, f'flywheel "{wheel.name}"', problems, table.moments, advice)

    if problems.lines or header is None or carrier is None:
        raise StandError(problems.lines)
    stand = Stand(
        name=header.name,
        angles=header.angles,
        gravity=header.gravity,
        stream=ZERO3 if header.stream is None and profile is not None else header.stream,
        carrier=_bearing(carrier, mounted),
        instruments=tuple(_bearing(instrument, mounted) for instrument in instruments),
        flywheels=tuple(flywheels),
        points=tuple(points),
        phase_input=header.phase_input,
        tasks=tasks,
        inverse_most=header.inverse_most,
        hold=hold,
        profile=profile,
        laws=tuple(law for law in laws if law is not None),
    )
    if physics:
        physical.check_stand(stand, problems)
    if problems.lines:
        raise StandError(problems.lines)
    return stand


def _header(document: dict[str, Any], problems: Problems) -> Header | None:
    own_keys = keys_of(Header)
    law_keys = [*law_tables(), *law_arrays(), *(key for table in law_headers() for key in keys_of(table))]
    known = [*own_keys, "stream_profile", "carrier", *law_keys, *_ARRAYS, "task", "hold"]
    own = {key: value for key, value in document.items() if key in own_keys}
    for key in document:
        if key not in known:
            problems.add(f"unknown key {show(key)}{suggestion(key, known)}")
    return _validate(problems, "", Header, own)


def _profile(problems: Problems, document: dict[str, Any], header: Header | None) -> StreamProfile | None:
    """`[stream_profile]`, downwards as gravity where it does not say; None without."""
    table = _table(problems, document, "stream_profile", StreamProfileTable)
    if table is None or header is None:
        return None
    if table.down is None and not any(header.gravity):
        problems.add("stream_profile", "down", "required without gravity (the direction of increasing depth)")
        return None
    check_profile(problems, table.depth, table.velocity, header.stream or ZERO3)
    return StreamProfile(table.down or header.gravity, table.depth, table.velocity)


def _law(problems: Problems, document: dict[str, Any], law: type[CarrierLaw]) -> LawData | None:
    """The data of one law; None where the file does not have it, or not in order."""
    header = None
    if (header_table := law.header_table()) is not None:
        raw = {key: value for key, value in document.items() if key in keys_of(header_table)}
        header = _validate(problems, "", header_table, raw)
    if law.item is None:
        found = _table(problems, document, law.key, law.table())
        return law.read(header, [] if found is None else [found])
    return law.read(header, [item for _, item in _array(problems, document, law.key, law.item.table())])


def _hold_table(problems: Problems, document: dict[str, Any]) -> HoldTable | None:
    """`[hold]`; None without, or where it is not in order, which is noted."""
    if isinstance(document.get("hold", {}), dict):
        return _table(problems, document, "hold", hold_with_laws())
    expected = 'expected one table, [hold] with a line such as freedoms = ["yaw"]'
    problems.add("hold", f"{expected}, found {show(document['hold'])}")
    return None


def _held_laws(problems: Problems, table: HoldTable, hold: Hold) -> list[LawData | None]:
    """The data of the laws whose tables are those of the hold."""

    def note(*words: str) -> None:
        problems.add("hold", *words)

    return [law.read_held(getattr(table, law.key), hold, note) for law in held_laws()]


def _bearing(body: AnyBody, mounted: Sequence[tuple[type[BodyLaw], Sequence[tuple[str, Any]]]]) -> AnyBody:
    """The body with the laws that are mounted on it, in the file's order."""
    own: list[LawData | None] = [
        law.read_mounted([t for _, t in tables if t.mount == body.name]) for law, tables in mounted
    ]
    return replace(body, laws=(*body.laws, *(data for data in own if data is not None)))


def _validate(problems: Problems, where: str, table: type[AnyTable], raw: Any) -> AnyTable | None:
    try:
        return table.model_validate(raw)
    except ValidationError as error:
        problems.add_schema_errors(where, table, error)
        return _readable(table, raw, error)


def _readable(table: type[AnyTable], raw: Any, error: ValidationError) -> AnyTable | None:
    """Read the table without its unreadable keys, so that unphysical values in the rest are reported as well.

    None where a bad key says, or may be meant to say, what the checks of a body take.
    """
    locations = [item["loc"] for item in error.errors(include_url=False)]
    bad = {str(location[0]) for location in locations if location}
    known = keys_of(table)
    meant = {nearest(key, known) for key in bad}
    if not isinstance(raw, dict) or not all(locations) or meant & _CHECKED:
        return None
    try:
        return table.model_validate({key: value for key, value in raw.items() if key not in bad})
    except ValidationError:
        return None


def _table(problems: Problems, document: dict[str, Any], key: str, table: type[AnyTable]) -> AnyTable | None:
    return _validate(problems, key, table, document[key]) if key in document else None


def _array(problems: Problems, document: dict[str, Any], key: str, table: type[AnyTable]) -> list[tuple[str, AnyTable]]:
    """The valid tables of an array, each with the words that name it."""
    raw = document.get(key, [])
    if not isinstance(raw, list):
        problems.add(key, f"expected an array of tables, [[{key}]], found {show(raw)}")
        return []
    found = []
    for i, item in enumerate(raw):
        name = item.get("name") if isinstance(item, dict) else None
        where = f"{key} {show(name)}" if isinstance(name, str) else f"{key}[{i}]"
        valid = _validate(problems, where, table, item)
        if valid is not None:
            found.append((where, valid))
    return found


def _tasks(problems: Problems, document: dict[str, Any]) -> tuple[Task, ...]:
    """The valid tasks, in the file's order."""
    raw = document.get("task", {})
    if not isinstance(raw, dict):
        problems.add("task", f"expected tables [task.NAME], found {show(raw)}")
        return ()
    if raw and not document.get("flywheel"):
        problems.add("task", "a task is what flywheels are to do, but there is no flywheel")
    found = []
    for name, item in raw.items():
        where = f"task {show(name)}"
        if (problem := name_of_task_problem(name)) is not None:
            problems.add(where, problem)
        table = _validate(problems, where, TaskTable, item)
        if table is not None:
            found.append(Task(name, table.rows))
    return tuple(found)


def _tables_with_names(document: dict[str, Any], key: str) -> list[tuple[str, dict[str, Any]]]:
    raw = document.get(key, [])
    tables = [item for item in raw if isinstance(item, dict)] if isinstance(raw, list) else []
    return [(item["name"], item) for item in tables if isinstance(item.get("name"), str)]


def _check_names(problems: Problems, document: dict[str, Any]) -> None:
    """No two bodies or points of one name; every mount is the carrier or an instrument."""
    taken = {"carrier": "the carrier"}
    mounted = ("flywheel", "point", *mounted_keys())
    for key in ("instrument", *mounted):
        for name, _ in _tables_with_names(document, key):
            if name in taken:
                problems.add(f"{key} {show(name)}", "name", f"taken by {taken[name]}")
            else:
                taken[name] = f"{'an' if key == 'instrument' else 'a'} {key}"
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
