"""Laws of wrenches: on bodies, between E0 and the carrier, along the freedoms of a hold. `declare` has their marks."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import MISSING, asdict, dataclass
from functools import cache
from typing import Annotated, Any, ClassVar, Self, TypeVar

from mahovik.core.stand.declare import Declared, Draw, Note, Size
from mahovik.core.stand.fields import Text, Vec3, require_bounds, text, validator
from mahovik.core.stand.hold import coordinate_problem, find_freedom, freedom_labels, freedom_names
from mahovik.core.stand.model import TWIST_LETTERS, Body, FreedomKind, Hold, Law, Stand
from mahovik.core.stand.tables import Default, Table, TableError, make_table
from mahovik.core.stand.units import Dimension, QuantityError, number


@dataclass(frozen=True)
class Actuator:
    """An input that a law takes at run time, which has the name of its fin or propeller in states.

    what   the quantity and its unit
    limit  largest magnitude, SI; None: that of every speed
    usual  magnitude in states that are drawn, SI
    """

    what: str
    limit: float | None
    usual: float


class BodyLaw(Law, ABC):
    """A law that acts on a body in its own frame: its key is one of a body, or [[key]] where it is `mounted`.

    limited   members that the emitted C takes up to a largest size only
    optional  is the key missing in the identity of a stand's physics where no body has the law?
    newer     keys that are missing there at their defaults: other stands had identities before there were such keys
    steers    is it drawn after the others, as it names what they have?
    """

    limited: ClassVar[tuple[str, ...]] = ()
    optional: ClassVar[bool] = True
    newer: ClassVar[tuple[str, ...]] = ()
    steers: ClassVar[bool] = False

    @classmethod
    def read(cls, table: Table) -> Self | None:
        """The data of the valid table; None where it does nothing."""
        law = cls.of_table(table)
        return law if law.acts else None

    @classmethod
    def read_mounted(cls, tables: Sequence[Table]) -> Self | None:
        """The data of all valid tables that are mounted on one body; None without."""
        assert cls.item is not None
        law = cls(tuple(cls.item.of_table(table) for table in tables))  # type: ignore[call-arg]  # its list
        return law if law.acts else None

    @classmethod
    @abstractmethod
    def structure(cls, stand: Stand) -> dict[str, Any]:
        """What of all bodies decides the text of the C, by key."""

    def problem(self, body: Body) -> tuple[str, str] | None:
        """Key and words of what a body lacks for its data; None where it lacks nothing."""
        return None

    @classmethod
    def of(cls, stand: Stand) -> list[tuple[int, Body, Self]]:
        """Index of each body that has it, the body, and the data."""
        laws = ((i, body, body.law(cls)) for i, body in enumerate(stand.bodies))
        return [(i, body, law) for i, body, law in laws if law is not None]

    @classmethod
    def bearers(cls, stand: Stand) -> list[str]:
        """Names of the bodies that have it."""
        return [body.name for _, body, _ in cls.of(stand)]

    @classmethod
    def short(cls, stand: Stand) -> str:
        """The law in a word; empty where no body has it."""
        return cls.name if cls.of(stand) else ""

    @classmethod
    def warnings(cls, stand: Stand) -> list[str]:
        """Matrices that drive, as one with a negative diagonal does."""
        laws = cls.of(stand)
        return [line for _, body, law in laws for line in law.negative_diagonals(f"{body.name}: {cls.key}")]

    @classmethod
    def random_with(cls, draw: Draw, of: Size) -> Self | None:
        """A random one of a body that is being drawn; None: it is none of those that come with the body."""
        return None

    @classmethod
    def random_on(cls, draw: Draw, body: Body) -> Self | None:
        """A random one of a body, after all bodies were drawn; None where it has none."""
        return None

    @property
    def actuators(self) -> dict[str, Actuator]:
        """What a state may set, by name of its table."""
        return {}

    def actuated(self, deflections: Mapping[str, float]) -> Self:
        """The law with what a state sets, by name of its table."""
        return self


class CarrierLaw(Law):
    """A law between E0 and the carrier: a table [key] with its fields, or a list of tables [[key]].

    header      fields that are keys of the file outside any table
    legend      sign in the drawing, and what it means
    at_origin   does it act at O1, as the drawing shows?
    made_of     tables [[key]] of parts that its numbers are made of, by key
    """

    header: ClassVar[tuple[str, ...]] = ()
    made_of: ClassVar[Mapping[str, type[Declared]]] = {}
    legend: ClassVar[tuple[str, str]] = ("", "")
    at_origin: ClassVar[bool] = False

    @classmethod
    @cache
    def header_table(cls) -> type[Table] | None:
        """Its keys outside any table; None where it has none."""
        return cls.table() if cls.header else None

    @classmethod
    def read(cls, header: Table | None, tables: Sequence[Table]) -> Self | None:
        """The data of the valid tables; None where they do nothing."""
        if cls.item is None:
            result = [cls.of_table(table) for table in tables]
        else:
            shared = {name: getattr(header, name) for name in cls.header if header is not None}
            result = [cls(*shared.values(), tuple(map(cls.item.of_table, tables)))]  # type: ignore[call-arg]  # its list
        return next((law for law in result if law.acts), None)

    @classmethod
    def of_parts(cls, stand: Stand, raw: Any, tables: dict[str, list[Any]], note: Note) -> Stand:
        """The stand with the law as its parts make it, by their valid tables; `raw`: the keys of [key] in the file."""
        return stand

    def as_tables(self) -> dict[str, Any]:
        """Its tables in a stand file, by key."""
        return {self.key: self.as_keys() if self.item is None else [item.as_keys() for item in self.items]}

    @classmethod
    def content(cls, law: Self | None) -> dict[str, Any]:
        """The numbers that the identity of a stand has of it; nothing without it, as other stands have it."""
        return {} if law is None else asdict(law)

    @classmethod
    def structure(cls, law: Self | None, stand: Stand) -> dict[str, Any]:
        """What of the data, or of None, decides the text of the C, by key."""
        raise NotImplementedError

    @classmethod
    def short(cls, stand: Stand) -> str:
        """The law in a few words, with how many there are; empty where the stand does not have it."""
        law = stand.law(cls)
        return "" if law is None else f"{len(law.items)} {cls.plural}" if cls.item else cls.name

    @classmethod
    def warnings(cls, stand: Stand) -> list[str]:
        """Matrices that drive or push away, as one with a negative diagonal does."""
        law = stand.law(cls)
        return [] if law is None else list(law.negative_diagonals(cls.key))

    @classmethod
    def random_of(cls, draw: Draw, count: int | None, mounts: Sequence[str]) -> Self | None:
        """A random one: of a list `count` tables, where that is given; None: nothing is drawn, as of laws of a hold."""
        return None

    def longest_steps(self, inertias: Sequence[float]) -> list[tuple[str, float]]:
        """Freedoms along which it needs short steps, and a step (s) that is too long.

        inertias  along each freedom of the hold, kg or kg m2
        """
        return []

    @property
    def ties(self) -> tuple[tuple[Vec3, Vec3], ...]:
        """Ends of the ties that the drawing shows: on the carrier in E1, on the ground in E0, m."""
        return ()


# -- laws along the freedoms of a hold -------------------------------------------------------------------------------


@dataclass(frozen=True)
class HoldNumber:
    """A number of a hold, in SI: `of` says of what, such as "friction of yaw"; `value` three numbers of a vector."""

    of: str
    name: str
    value: float | tuple[float, float, float]
    unit: str

    @property
    def printed(self) -> tuple[tuple[float, ...], str]:
        """The numbers and their unit as people read them: angles in degrees."""
        values = self.value if isinstance(self.value, tuple) else (self.value,)
        return (tuple(map(math.degrees, values)), "deg") if self.unit == "rad" else (values, self.unit)


@dataclass(frozen=True)
class Bounds:
    """A number of a freedom, which has the unit of what slides or turns, and its bounds, SI."""

    least: float | None = None
    above: float | None = None
    most: float | None = None


class FreedomTable(Table):
    """The freedom that a table of a hold is about.

    freedom  its name in `freedoms`, or the number of its place, `"1"`, `"2"`, ...; required where the hold has several
    """

    freedom: Text | None = None


@dataclass(frozen=True)
class FreedomItem(Declared):
    """A table [[hold.key]]: it is about one freedom.

    freedom    its number in the order of the hold; `name` is that of the file
    dimensions  of the numbers, in the order of the fields, by what the freedom does
    """

    freedom: int
    name: str

    keys: ClassVar[type[Table]] = FreedomTable
    dimensions: ClassVar[Mapping[FreedomKind, tuple[Dimension, ...]]]
    needs_coordinate: ClassVar[str] = ""

    @classmethod
    @cache
    def table(cls) -> type[Table]:
        """The table of the file: the freedom, then the numbers, whose units are known with the hold."""
        defaults = {name: mark.value for name, mark in cls.marked(Default).items()}
        hints = {name: (Any, defaults.get(name, MISSING)) for name in cls.marked(Bounds)}
        return make_table(cls, cls.keys, hints)

    @classmethod
    def dimension(cls, key: str, kind: FreedomKind) -> Dimension | None:
        """Dimension of a number by its key; None: it is no number."""
        return dict(zip(cls.marked(Bounds), cls.dimensions[kind], strict=True)).get(key)

    @classmethod
    def read(cls, table: Any, hold: Hold, note: Note) -> Self | None:
        """The data of a valid table; None where it is not in order, which is noted."""
        try:
            freedom = find_freedom(hold, table.freedom)
        except QuantityError as error:
            note("freedom", str(error))
            return None
        if cls.needs_coordinate and (problem := coordinate_problem(hold, freedom)) is not None:
            note("freedom", f"{problem}: {cls.needs_coordinate}")
            return None
        kind, numbers, in_order = hold.freedoms[freedom].kind, dict[str, float | None](), True
        for (key, bounds), dimension in zip(cls.marked(Bounds).items(), cls.dimensions[kind], strict=True):
            raw = getattr(table, key)
            try:
                value = None if raw is None else number(raw, dimension)
                numbers[key] = None if value is None else require_bounds(
                    value, dimension.si, bounds.least, bounds.above, bounds.most, raw
                )  # fmt: skip
            except QuantityError as error:
                note(key, str(error))
                in_order = False
        return cls.of_numbers(table, freedom, freedom_names(hold)[freedom], kind, numbers, note) if in_order else None

    @classmethod
    def of_numbers(
        cls, table: Any, freedom: int, name: str, kind: FreedomKind, numbers: Mapping[str, float | None], note: Note
    ) -> Self | None:
        """The data of numbers in SI; None where several of them do not go together, which is noted."""
        raise NotImplementedError

    @property
    def numbers(self) -> dict[str, float]:
        """Its numbers, by key."""
        return {key: value for key in self.marked(Bounds) if (value := getattr(self, key)) is not None}

    @property
    def acts(self) -> bool:
        """False where it does nothing."""
        return True

    def as_keys(self) -> dict[str, Any]:
        """Its keys in a stand file, in SI."""
        return {"freedom": self.name, **self.numbers}

    def titled(self, label: str) -> str:
        """What it is, of a freedom that goes by a label."""
        raise NotImplementedError


Item = TypeVar("Item", bound=FreedomItem)


class HeldLaw(CarrierLaw):
    """A law along the freedoms of a hold: its tables are [[hold.key]]."""

    item: ClassVar[type[FreedomItem]]

    @classmethod
    def read_held(cls, tables: Sequence[Table], hold: Hold, note: Note) -> Self | None:
        """The data of the valid tables, and notes on them; None where they do nothing."""
        items: dict[int, Any] = {}
        for k, table in enumerate(tables):
            item = cls.item.read(table, hold, lambda *words, k=k: note(f"{cls.key}[{k}]", *words))
            if item is not None:
                items[k] = item
        cls.check_together(items, hold, note, len(items) == len(tables))
        acting = tuple(item for item in items.values() if item.acts)
        return cls(acting) if acting else None  # type: ignore[call-arg]  # its list

    @classmethod
    def check_together(cls, items: Mapping[int, Any], hold: Hold, note: Note, complete: bool) -> None:
        """Notes what several tables, by their places in the file, tell together; `complete`: all are in order."""

    @classmethod
    def short(cls, stand: Stand) -> str:
        """The law and its freedoms; empty where the stand does not have it."""
        law, hold = stand.law(cls), stand.hold
        if law is None or hold is None:
            return ""
        return f"{cls.plural} of {', '.join(dict.fromkeys(freedom_labels(hold)[item.freedom] for item in law.items))}"

    @classmethod
    def numbers(cls, stand: Stand) -> list[HoldNumber]:
        """The numbers of each table."""
        law, hold = stand.law(cls), stand.hold
        return [
            HoldNumber(item.titled(freedom_labels(hold)[item.freedom]), key, value, dimension.si)
            for item in (law.items if law and hold else ())
            for key, value in item.numbers.items()
            if hold and (dimension := item.dimension(key, hold.freedoms[item.freedom].kind))
        ]


# -- derivatives of a wrench as published ------------------------------------------------------------------------------
#
# Products of velocities, and of what a law beside takes, whose value has the unit that follows from them.


@dataclass(frozen=True)
class Velocity:
    """A component 0..5 of V_r as a factor, or its magnitude."""

    component: int
    absolute: bool

    @property
    def text(self) -> str:
        """Letter of SNAME as in the stand file: "u" or "|u|"."""
        result = TWIST_LETTERS[self.component]
        return f"|{result}|" if self.absolute else result

    @property
    def powers(self) -> tuple[int, int, int]:
        """Powers of metre, radian and 1/second."""
        return (0, 1, 1) if self.component >= 3 else (1, 0, 1)


def without_bars(raw: Any) -> tuple[str, bool]:
    """What stands between the bars of a magnitude, and whether there are any. Raises QuantityError: no text."""
    spelling = text(raw)
    bars = len(spelling) > 2 and spelling[0] == spelling[-1] == "|"
    return (spelling[1:-1] if bars else spelling), bars


def velocity(raw: Any) -> Velocity | None:
    """A factor "u" or "|u|"; None for anything else. Raises QuantityError: no text."""
    letter, absolute = without_bars(raw)
    return Velocity(TWIST_LETTERS.index(letter), absolute) if letter in TWIST_LETTERS else None


def texts(factors: Iterable[Any]) -> list[str]:
    """Factors as in the stand file."""
    return [factor.text for factor in factors]


class TermTable(Table):
    """The value of a derivative.

    value  in SI, or with the unit that follows from the component and the factors
    """

    value: Annotated[Any, validator(lambda raw: raw, shape="number")]

    def check(self: Any) -> None:
        """Reads the value. Raises TableError."""
        metres, radians, rates = (sum(column) for column in zip(*(f.powers for f in self.of), strict=True))
        force = "N m" if self.wrench >= 3 else "N"
        times = [f"^{power}" if power > 1 else "" for power in (rates, metres, radians)]
        unit = f"{force} s{times[0]}" if rates else force
        unit += (f"/m{times[1]}" if metres else "") + (f"/rad{times[2]}" if radians else "")
        try:
            self.value = number(self.value, Dimension("a derivative", unit))
        except QuantityError as error:
            raise TableError(str(error), "value") from None
