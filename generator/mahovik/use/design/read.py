"""Read the freedom of a design from a file (TOML) or a list of keys; all problems are found before any is reported."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any, cast

import numpy as np

from mahovik.core.motion.document import text_of
from mahovik.core.stand.content import TABLE
from mahovik.core.stand.model import Stand
from mahovik.core.stand.problems import Problems
from mahovik.core.stand.shapes import vector
from mahovik.core.stand.toml import parse
from mahovik.core.stand.units import (
    ANGLE,
    LENGTH,
    MASS,
    PLAIN,
    STATIC_UNBALANCE,
    Dimension,
    QuantityError,
    number,
    show,
)
from mahovik.errors import DesignError
from mahovik.nearest import meant
from mahovik.use.design.freedom import MIRRORS, PARTS, WIDTH, Freedom, Key, Limits, Tie, Weights
from mahovik.use.design.limits import nearest_two
from mahovik.use.design.section import Section
from mahovik.use.design.space import flywheel_numbers

TOP = ("schema", "number", "phase", "speed", "harmonics", "quality", "free", "group", "limits", "cost")
CHOICES = ("phase", "speed", "number")
DIMENSIONS: dict[Key, Dimension] = {
    "position": LENGTH,
    "angles": ANGLE,
    "unbalance": STATIC_UNBALANCE,
    "unbalance_at": ANGLE,
    "mass": MASS,
    "inertia": PLAIN,
}
MOST_FLYWHEELS, MOST_HARMONICS, FASTEST = 24, 8, 1000
HARMONICS, QUALITY = 3, 1e-3


def load_freedom(path: str | Path, stand: Stand) -> Freedom:
    """Read and check the file at `path` for `stand`. Raises DesignError with every problem."""
    path = Path(path)
    return read_freedom(text_of(path, TABLE, DesignError), stand, path.name)


def read_freedom(text: str, stand: Stand, source: str = "free") -> Freedom:
    """Read and check a freedom given as text; `source` names it in messages. Raises DesignError."""
    try:
        document = parse(text)
    except (RecursionError, ValueError) as error:
        raise DesignError([f"{source}: not TOML: {error}"]) from None
    problems = Problems(source)
    top = Section(problems, document)
    top.only(TOP)
    if top.has("schema") and (isinstance(document["schema"], bool) or document["schema"] != 1):
        top.refuse("schema", f"expected 1, found {show(document['schema'])}")
    reader = _FreedomReader(top, stand)
    freedom = reader.freedom()
    if problems.lines:
        raise DesignError(problems.lines)
    return freedom


def freedom_of_keys(keys: str, stand: Stand) -> Freedom:
    """Freedom of all flywheels from `--free position,unbalance`, with default bounds. Raises DesignError."""
    known = (*PARTS, *CHOICES)
    names = [key.strip() for key in keys.split(",")]
    problems = Problems(f"--free {keys}")
    document: dict[str, Any] = {"schema": 1}
    free: dict[str, Any] = {}
    for name in names:
        if name not in known:
            problems.add(f"unknown key {show(name)}{meant(name, known)} The name of a freedom file ends in .toml")
        elif name in CHOICES:
            document[name] = True
        else:
            free[name] = True
    if free:
        document["free"] = [free]
    freedom = _FreedomReader(Section(problems, document), stand).freedom()
    if problems.lines:
        raise DesignError(problems.lines)
    return freedom


class _FreedomReader:
    """Reads one document; after a problem was noted, the values read are not used."""

    def __init__(self, top: Section, stand: Stand) -> None:
        self.top, self.stand, self.N = top, stand, len(stand.flywheels)
        self.names = [s.name for s in stand.flywheels]
        now = np.array([flywheel_numbers(s) for s in stand.flywheels]).reshape(self.N, WIDTH)
        self.least, self.most, self.free = now.copy(), now.copy(), np.zeros((self.N, WIDTH), dtype=bool)
        self.current = now

    def freedom(self) -> Freedom:
        """The whole document."""
        top = self.top
        if not self.N:
            top.problems.add(f"stand {self.stand.name} has no flywheels: there is nothing to design")
            return Freedom(self.least, self.most, self.free)
        number = self._number()
        for where, section in self._tables("free"):
            section.only(("flywheels", *PARTS))
            chosen = self._flywheels(section)
            for key in PARTS:
                if key in section:
                    self._free(where, section, chosen, key)
            if "unbalance" in section and "unbalance_at" not in section and section.given["unbalance"] is not False:
                self._free_direction(chosen, "unbalance_at")
        phase = self._flag("phase")
        speeds = self._speeds()
        choosing = phase or speeds is not None or "number" in top
        if not self.free.any() and not choosing and not top.problems.lines:
            top.problems.add(f"nothing is free: free one of {', '.join((*PARTS, *CHOICES))}")
        return Freedom(
            self.least, self.most, self.free, self._ties(), self._limits(), self._weights(), phase, speeds, number,
            self._integer("harmonics", HARMONICS, 0, MOST_HARMONICS), self._quality(),
        )  # fmt: skip

    def _tables(self, key: str) -> list[tuple[str, Section]]:
        found = []
        for i, raw in enumerate(self.top.rows(key)):
            where = f"{key}[{i}]"
            if isinstance(raw, dict):
                found.append((where, Section(self.top.problems, raw, (where,))))
            else:
                self.top.refuse(where, f"expected a table, found {show(raw)}")
        return found

    def _flywheels(self, section: Section) -> list[int]:
        """Numbers of the flywheels that a table names; all if it names none."""
        if "flywheels" not in section:
            return list(range(self.N))
        found: list[int] = []
        for name in section.rows("flywheels"):
            if name not in self.names:
                section.refuse("flywheels", f"unknown {show(name)}{meant(str(name), self.names)}")
            elif self.names.index(name) in found:
                section.refuse("flywheels", f"{show(name)} is named twice; name it once")
            else:
                found.append(self.names.index(name))
        return found

    def _free(self, where: str, section: Section, chosen: list[int], key: Key) -> None:
        """Read one key of one table."""
        raw = section.given[key]
        if raw is False:
            return
        if key == "unbalance" and any(self.stand.flywheels[s].mass <= 0.0 for s in chosen):
            section.refuse(key, "a flywheel without mass has no unbalance")
            return
        if raw is True:
            self._default(section, chosen, key)
            return
        if not isinstance(raw, dict):
            section.refuse(key, f"expected true, false or {{ min = .., max = .. }}, found {show(raw)}")
            return
        box = Section(section.problems, raw, (where, key))
        box.only(("min", "max"))
        if not box.has("min", "max"):
            return
        low, high = (self._bound(box, side, key) for side in ("min", "max"))
        if low is None or high is None:
            return
        for a, b, unit in zip(low, high, (DIMENSIONS[key].si,) * len(low), strict=True):
            if a > b:
                section.refuse(key, f"min {a:g} is above max {b:g} {unit}".rstrip())
                return
        if key in ("unbalance", "mass", "inertia") and low[0] < 0.0:
            section.refuse(key, f"min {low[0]:g} is negative")
            return
        if key in ("mass", "inertia") and low[0] == 0.0:
            section.refuse(key, "min 0: expected a minimum above 0")
            return
        for s in chosen:
            self.least[s, PARTS[key]], self.most[s, PARTS[key]] = low, high
            self.free[s, PARTS[key]] = True

    def _bound(self, box: Section, side: str, key: Key) -> tuple[float, ...] | None:
        part = PARTS[key]
        width = part.stop - part.start
        try:
            if width == 1:
                return (number(box.given[side], DIMENSIONS[key]),)
            return vector(box.given[side], (width,), DIMENSIONS[key])
        except QuantityError as error:
            box.refuse(side, str(error))
            return None

    def _default(self, section: Section, chosen: list[int], key: Key) -> None:
        """Default bounds, for a key that is just `true`."""
        if key in ("angles", "unbalance_at"):
            self._free_direction(chosen, key)
            return
        low, high = self.current[:, PARTS[key]], self.current[:, PARTS[key]]
        if key == "position":
            far = float(np.abs(low).max())
            low, high = np.full_like(low, -far), np.full_like(high, far)
        elif key == "unbalance":
            low, high = np.zeros_like(low), np.full_like(high, 2.0 * float(high.max()))
        else:
            low, high = 0.5 * low, 2.0 * high
        if not np.any(high > low):
            section.refuse(key, "all values in the stand are zero: give { min = .., max = .. } instead of true")
            return
        for s in chosen:
            self.least[s, PARTS[key]], self.most[s, PARTS[key]] = low[s], high[s]
            self.free[s, PARTS[key]] = True

    def _free_direction(self, chosen: list[int], key: Key) -> None:
        """Free angles in any direction."""
        for s in chosen:
            self.least[s, PARTS[key]], self.most[s, PARTS[key]] = -math.inf, math.inf
            self.free[s, PARTS[key]] = True

    def _ties(self) -> tuple[Tie, ...]:
        found = []
        for _, section in self._tables("group"):
            section.only(("flywheels", "same", "mirror"))
            if not section.has("flywheels"):
                continue
            chosen = self._flywheels(section)
            same = section.rows("same")
            for key in same:
                if not isinstance(key, str) or key not in PARTS:
                    section.refuse("same", f"unknown key {show(key)}{meant(str(key), PARTS)}")
            mirror = section.given.get("mirror")
            if mirror is not None and mirror not in MIRRORS:
                section.refuse("mirror", f"expected one of {', '.join(MIRRORS)}, found {show(mirror)}")
            elif mirror is not None and len(chosen) != 2:
                section.refuse("mirror", f"needs two flywheels, found {len(chosen)}")
            elif mirror is not None and {"position", "angles"} & set(map(str, same)):
                section.refuse("mirror", "contradicts `same` about position and angles")
            elif len(chosen) < 2:
                section.refuse("flywheels", f"a group needs two or more flywheels, found {len(chosen)}")
            elif mirror is None and not same:
                section.problems.add(*section.path, "nothing is tied: expected `same`, `mirror` or both")
            elif len({self.stand.flywheels[s].mount for s in chosen}) > 1:
                section.refuse("flywheels", "all flywheels of a group need the same mount")
            else:
                keys = tuple(key for key in PARTS if key in same)
                found.append(Tie(tuple(chosen), keys, mirror))
        return tuple(found)

    def _limits(self) -> Limits:
        section = self.top.section("limits")
        if section is None:
            return Limits()
        kinds = {"distance": LENGTH, "total_mass": MASS, "total_unbalance": STATIC_UNBALANCE}
        section.only(tuple(kinds))
        found = {key: section.number(key, unit) if key in section else None for key, unit in kinds.items()}
        for key, limit in found.items():
            if limit is not None and limit < 0.0:
                section.refuse(key, f"{limit:g} {kinds[key].si} is negative")
        for key, k in (("total_mass", 7), ("total_unbalance", 5)):
            limit, least = found[key], float(self.least[: self._number()[0], k].sum())
            if limit is not None and limit < least * (1.0 - 1e-12):
                section.refuse(key, f"{limit:g} {kinds[key].si} is below the sum of the least, {least:g}")
        if "distance" not in section and self.free[:, PARTS["position"]].any():
            found["distance"] = self._default_distance()
        return Limits(found["distance"] or None, found["total_mass"], found["total_unbalance"])

    def _default_distance(self) -> float:
        """Default distance: half the least distance in the given stand, so that flywheels keep apart."""
        nearest_now = nearest_two(self.stand)
        return 0.5 * nearest_now[0] if nearest_now is not None else 0.0

    def _weights(self) -> Weights:
        section = self.top.section("cost")
        if section is None or not section.given:
            return Weights()
        section.only(("unbalance", "torque"))
        values = {}
        for key in ("unbalance", "torque"):
            value = section.number(key, PLAIN) if key in section else 0.0
            if value is not None and value < 0.0:
                section.refuse(key, f"{value:g} is negative, expected a weight")
            values[key] = value or 0.0
        return Weights(values["unbalance"], values["torque"])

    def _flag(self, key: str) -> bool:
        raw = self.top.given.get(key, False)
        if not isinstance(raw, bool):
            self.top.refuse(key, f"expected true or false, found {show(raw)}")
        return raw is True

    def _speeds(self) -> tuple[int, ...] | None:
        raw = self.top.given.get("speed", False)
        if isinstance(raw, bool):
            return (-2, -1, 0, 1, 2) if raw else None
        found = [self.top.integer("speed", each) for each in self.top.rows("speed")]
        if not found:
            self.top.refuse("speed", "expected turns a period to choose from, as [-1, 1]")
        for turns in found:
            if turns is not None and abs(turns) > FASTEST:
                self.top.refuse("speed", f"expected at most {FASTEST} turns a period, found {turns}")
        return tuple(sorted({turns for turns in found if turns is not None}))

    def _number(self) -> tuple[int, int]:
        raw = self.top.given.get("number", False)
        if isinstance(raw, bool):
            return (1, self.N) if raw else (self.N, self.N)
        if isinstance(raw, list) and len(raw) == 2:
            pair = [self.top.integer("number", each) for each in raw]
            if None in pair:
                return (self.N, self.N)
            least, most = cast("list[int]", pair)
            if not 1 <= least <= MOST_FLYWHEELS or not 1 <= most <= MOST_FLYWHEELS:
                self.top.refuse(
                    "number", f"expected 1 to {MOST_FLYWHEELS} flywheels, found {show(least)}, {show(most)}"
                )
            elif least > most:
                self.top.refuse("number", f"least {least} is above most {most}")
            elif most > self.N:
                self.top.refuse(
                    "number", f"{most} flywheels, but the stand has {self.N}: copy one of its tables for each new one"
                )
            else:
                return least, most
        else:
            self.top.refuse("number", f"expected least and most, as [2, 4], found {show(raw)}")
        return (self.N, self.N)

    def _integer(self, key: str, default: int, least: int, most: int) -> int:
        if key not in self.top:
            return default
        found = self.top.integer(key, self.top.given[key])
        if found is not None and not least <= found <= most:
            self.top.refuse(key, f"expected {least} to {most}, found {found}")
            return default
        return default if found is None else found

    def _quality(self) -> float:
        if "quality" not in self.top:
            return QUALITY
        found = self.top.above_zero("quality", PLAIN)
        if found is not None and found > 0.1:
            self.top.refuse("quality", f"{found:g} is not a quality, expected a relative residual of at most 0.1")
        return found or QUALITY
