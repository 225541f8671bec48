"""The file that says which variable of an FMU is which number of `eval`, as TOML.

    [state]                                # what the FMU is given
    V = "carrier.V[{i}]"                   # {i}: 1, 2, ...; {name}: each flywheel
    phi = "{name}.phi"
    phi_dot = ["wheel.w", { variable = "wheel2.w", factor = -1 }]
    [state.wrench]
    carrier = ["X", "Y", "Z", "K", "M", "N"]
    [forward]                              # what it answers: a table for each want
    V_dot = "carrier.V_dot[{i}]"

Of a held carrier u, u_dot, q may take the place of V, V_dot and the pose; {freedom}: the name of each freedom.
`factor`: SI units of one unit of the variable, with a sign.
"""

from __future__ import annotations

import tomllib
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from mahovik.core.stand.content import readable
from mahovik.core.stand.hold import freedom_names, has_coordinates, numbered_freedoms
from mahovik.core.stand.model import Stand
from mahovik.errors import DataError
from mahovik.nearest import suggestion
from mahovik.proof.verify.dependence import depends_on

INPUTS = {
    "position": 3, "quaternion": 4, "angles": 3, "V": 6, "V_dot": 6, "phi": 0, "phi_dot": 0, "phi_ddot": 0, "tau": 0,
}  # fmt: skip
"""Keys of a state and their lengths; 0: one number for each flywheel."""

TWISTS = {"V": "u", "V_dot": "u_dot"}
"""Keys that the speeds of the freedoms of a held carrier, and their rates, may take the place of."""

ANSWERS: Mapping[str, Mapping[str, int]] = {
    "forward": {"V_dot": 6},
    "torque": {"tau": 0},
    "coupled": {"V_dot": 6, "phi_ddot": 0},
    "mounts": {"mount_wrench": -6},
    "momentum": {"Z": 6, "Z0": 6, "energy": 1, "center_of_mass": 3},
}
"""Quantities of each want and their lengths; -6: six numbers for each flywheel."""

NEEDS = {
    "forward": ("phi_ddot",),
    "torque": ("V_dot", "phi_ddot"),
    "coupled": ("tau",),
    "mounts": ("V_dot", "phi_ddot"),
    "momentum": (),
    "reaction": ("V_dot", "phi_ddot"),
}
"""Inputs of each want besides the state."""


def inputs_of(stand: Stand) -> dict[str, int]:
    """Keys of a state of a stand and their lengths, as INPUTS; of a held carrier also those of its freedoms."""
    hold = stand.hold
    if hold is None:
        return dict(INPUTS)
    found = dict(INPUTS) | dict.fromkeys(TWISTS.values(), len(hold.freedoms))
    if has_coordinates(hold):
        own = len(numbered_freedoms(hold))
        found |= {"q": own} | ({"orientation": 4} if own < len(hold.freedoms) else {})
    return {key: length for key, length in found.items() if length or key in INPUTS}


def answers_of(stand: Stand) -> Mapping[str, Mapping[str, int]]:
    """Quantities of each want of a stand and their lengths, as ANSWERS."""
    if stand.hold is None:
        return ANSWERS
    count = len(stand.hold.freedoms)
    motion = ({"u_dot": count} if count else {}) | {"reaction": 6}
    held = {want: {**motion, **of} for want, of in ANSWERS.items() if "V_dot" in of}
    return {**ANSWERS, **held, "reaction": {"reaction": 6}}


def may_leave_out(stand: Stand, quantities: Collection[str]) -> tuple[str, ...]:
    """Quantities of a want that a map need not have beside these: of a held carrier the reaction, which is a want of
    its own, and one of u_dot and V_dot, which are the same motion.
    """
    if stand.hold is None or quantities == {"reaction"}:
        return ()
    motion = {"u_dot", "V_dot"}
    return ("reaction", *(motion if motion & set(quantities) else ()))


@dataclass(frozen=True)
class Place:
    """A variable of an FMU; `factor`: SI units of one of its units."""

    variable: str
    factor: float = 1.0


@dataclass(frozen=True)
class FmuMap:
    """Variables of an FMU by keys of a state, by bodies with a run-time wrench, and by wants and quantities."""

    inputs: Mapping[str, tuple[Place, ...]]
    wrenches: Mapping[str, tuple[Place, ...]]
    answers: Mapping[str, Mapping[str, tuple[Place, ...]]]

    def places_to_set(self) -> Iterator[Place]:
        """Variables that are set."""
        for places in (*self.inputs.values(), *self.wrenches.values()):
            yield from places

    def places_to_read(self) -> Iterator[Place]:
        """Variables that are read."""
        for quantities in self.answers.values():
            for places in quantities.values():
                yield from places


def read_map(path: Path, stand: Stand) -> FmuMap:
    """The map of a file. Raises DataError with a line for each fault."""
    try:
        raw = tomllib.loads(readable(path, "a map of variables").decode("utf-8"))
    except (UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise DataError([f"{path}: no TOML: {error}"]) from None
    except ValueError as error:
        raise DataError([str(error)]) from None
    reader = _Reader(stand, raw)
    found = reader.map()
    if reader.problems:
        raise DataError([f"{path}: {problem}" for problem in reader.problems])
    return found


class _Reader:
    """Reads the tables of a map, and collects what is wrong."""

    def __init__(self, stand: Stand, raw: Mapping[str, Any]) -> None:
        self._stand, self._raw = stand, raw
        self._names = [each.name for each in stand.flywheels]
        self._inputs, self._answers = inputs_of(stand), answers_of(stand)
        self.problems: list[str] = []

    def map(self) -> FmuMap:
        """The map; `problems` are then known."""
        for key in self._raw:
            if key not in ("state", *self._answers):
                self.problems.append(f'unknown key "{key}"{suggestion(key, ("state", *self._answers))}')
        state = self._table("state", self._raw)
        wrenches = self._table("wrench", state)
        takes = [body.name for body in self._stand.bodies if body.wrench_input]
        found = FmuMap(
            self._group("state", {key: value for key, value in state.items() if key != "wrench"}, self._inputs),
            self._group("state.wrench", wrenches, dict.fromkeys(takes, 6)),
            {
                want: self._group(want, self._table(want, self._raw), self._answers[want])
                for want in self._answers
                if want in self._raw
            },
        )
        if not self.problems:
            self._check(found, takes)
        return found

    def _table(self, key: str, of: Mapping[str, Any]) -> Mapping[str, Any]:
        table = of.get(key, {})
        if not isinstance(table, dict):
            self.problems.append(f"{key}: expected a table")
            return {}
        return table

    def _group(self, where: str, table: Mapping[str, Any], known: Mapping[str, int]) -> dict[str, tuple[Place, ...]]:
        found = {}
        for key, value in table.items():
            if key not in known:
                self.problems.append(f'{where}: unknown key "{key}"{suggestion(key, list(known)) if known else ""}')
                continue
            texts = self._expand(value, known[key], self._freedoms(key))
            places = [self._place(f"{where}.{key}", each) for each in texts]
            length = self._length(known[key])
            if len(places) != length:
                self.problems.append(f"{where}.{key}: {len(places)} variables, expected {length}")
            found[key] = tuple(place for place in places if place is not None)
        return found

    def _length(self, length: int) -> int:
        return {0: len(self._names), -6: 6 * len(self._names)}.get(length, length)

    def _freedoms(self, key: str) -> Sequence[str]:
        """Names of the freedoms that the numbers of a key are of."""
        hold = self._stand.hold
        if hold is None or key not in ("q", *TWISTS.values()):
            return ()
        names = freedom_names(hold)
        return [names[k] for k in numbered_freedoms(hold)] if key == "q" else names

    def _expand(self, value: Any, length: int, freedoms: Sequence[str]) -> list[Any]:
        """The list of variables that a pattern stands for."""
        if not isinstance(value, str):
            return value if isinstance(value, list) else [value]
        if freedoms:
            return [value.replace("{i}", str(i + 1)).replace("{freedom}", name) for i, name in enumerate(freedoms)]
        if length > 0:
            return [value.replace("{i}", str(i + 1)) for i in range(length)]
        places = [("", 0)] if length == 0 else [("", i) for i in range(6)]
        return [value.replace("{name}", name).replace("{i}", str(i + 1)) for name in self._names for _, i in places]

    def _place(self, where: str, value: Any) -> Place | None:
        if isinstance(value, str):
            return Place(value)
        if isinstance(value, dict) and isinstance(value.get("variable"), str) and set(value) <= {"variable", "factor"}:
            factor = value.get("factor", 1.0)
            if isinstance(factor, int | float) and not isinstance(factor, bool) and factor:
                return Place(value["variable"], float(factor))
        self.problems.append(
            f"{where}: found {value!r:.60}, expected the name of a variable or "
            '{ variable = "NAME", factor = NUMBER }, the factor not zero'
        )
        return None

    def _check(self, found: FmuMap, takes: list[str]) -> None:
        """Collect what is missing."""
        if not found.answers:
            self.problems.append(f"no answers, expected a table for a want: {', '.join(self._answers)}")
        wheels = ("phi", "phi_dot") if self._names else ()
        for key in ("V", *wheels):
            if not self._is_given(found, key):
                self.problems.append(f"state.{key}{self._instead(key)} is missing: every state has it")
        for want, quantities in found.answers.items():
            spared = may_leave_out(self._stand, quantities)
            self.problems += [
                f"{want}.{name} is missing"
                for name in self._answers[want]
                if name not in quantities and name not in spared
            ]
            for key in NEEDS[want]:
                if not self._is_given(found, key) and (self._names or key == "V_dot"):
                    words = f"state.{key}{self._instead(key)} is missing: {want} needs it as an input of the FMU"
                    self.problems.append(words)
        if "quaternion" in found.inputs and "angles" in found.inputs:
            self.problems.append("state: quaternion and angles, expected one of them")
        posed: dict[Literal["quaternion", "position"], tuple[str, ...]] = {
            "quaternion": ("quaternion", "angles"),
            "position": ("position",),
        }
        whole = {"q", "orientation"} & self._inputs.keys()
        for key, inputs in posed.items():
            if whole and whole <= found.inputs.keys():
                continue
            lacking = not any(each in found.inputs for each in inputs)
            if lacking and not self.problems and depends_on(self._stand, list(found.answers), key):
                self.problems.append(f"state.{key} is missing: answers of this stand depend on it")
        for name in takes:
            if name not in found.wrenches:
                self.problems.append(f"state.wrench.{name} is missing: the stand has `wrench_input` there")

    def _is_given(self, found: FmuMap, key: str) -> bool:
        """Whether the FMU is given a key, or the rates of freedoms in its place; a clamped carrier has no motion."""
        if key not in TWISTS or self._stand.hold is None:
            return key in found.inputs
        return not self._stand.hold.freedoms or bool({key, TWISTS[key]} & found.inputs.keys())

    def _instead(self, key: str) -> str:
        return f" or state.{TWISTS[key]}" if key in TWISTS and self._stand.hold is not None else ""
