"""The file that says which variable of an FMU is which number of the contract of `eval`, as TOML.

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
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from mahovik.contract.evaluation import ANSWERS, STATE, answers_of, needs_of
from mahovik.core.stand.content import readable
from mahovik.core.stand.hold import freedom_names, has_coordinates, numbered_freedoms
from mahovik.core.stand.model import Stand
from mahovik.errors import DataError
from mahovik.nearest import suggestion
from mahovik.proof.verify.dependence import depends_on

WANTS = ("forward", "torque", "coupled", "mounts", "momentum")
"""Wants that an FMU may answer; of a held carrier also `reaction`."""

TWISTS = {"V": "u", "V_dot": "u_dot"}
"""Keys that the speeds of the freedoms of a held carrier, and their rates, may take the place of."""

POSES: Mapping[Literal["quaternion", "position"], tuple[str, ...]] = {
    "quaternion": ("quaternion", "angles"),
    "position": ("position",),
}
"""Parts of a pose, and the keys of which one is to be there."""


@dataclass(frozen=True)
class Place:
    """A variable of an FMU; `factor`: SI units of one of its units."""

    variable: str
    factor: float = 1.0


Group = Mapping[str, tuple[Place, ...]]
"""Variables by key."""


@dataclass(frozen=True)
class FmuMap:
    """Variables of an FMU by keys of a state, by bodies with a run-time wrench, and by wants and quantities."""

    inputs: Group
    wrenches: Group
    answers: Mapping[str, Group]

    def places_to_set(self) -> tuple[Place, ...]:
        """Variables that are set."""
        return tuple(place for places in (*self.inputs.values(), *self.wrenches.values()) for place in places)

    def places_to_read(self) -> tuple[Place, ...]:
        """Variables that are read."""
        return tuple(place for group in self.answers.values() for places in group.values() for place in places)


Names = Sequence[Mapping[str, str]]
"""What takes the place of {i}, {name} and {freedom} in a pattern, for each of the numbers of a key."""


def inputs_of(stand: Stand) -> dict[str, Names]:
    """Keys of a state that an FMU of a stand may be given."""
    keys = ["position", "quaternion", "angles", "V", "V_dot", "phi", "phi_dot", "phi_ddot", "tau"]
    found = {key: _names(stand, STATE[key].shape) for key in keys}
    hold = stand.hold
    if hold is not None and hold.freedoms:
        freedoms = [{"i": str(k + 1), "freedom": name} for k, name in enumerate(freedom_names(hold))]
        found |= dict.fromkeys(TWISTS.values(), freedoms)
        if has_coordinates(hold):
            numbered = numbered_freedoms(hold)
            found |= {"q": [freedoms[k] for k in numbered]} if numbered else {}
            found |= {"orientation": _names(stand, (4,))} if len(numbered) < len(freedoms) else {}
    return found


def wants_of(stand: Stand) -> dict[str, dict[str, Names]]:
    """Quantities of the wants that an FMU of a stand may answer."""
    held = stand.hold is not None
    found = {}
    for want in (*WANTS, *(("reaction",) if held else ())):
        shapes = {name: ANSWERS[name].shape for name in answers_of(want, held)}
        found[want] = {name: _names(stand, shape) for name, shape in shapes.items() if shape != ("m",)}
        if ("m",) in shapes.values() and "u_dot" in inputs_of(stand):
            found[want] |= {"u_dot": inputs_of(stand)["u_dot"]}
    return found


def _names(stand: Stand, shape: Sequence[int | str] | None) -> Names:
    """One of each number of a shape, by flywheels and by its place."""
    wheels = [{"name": wheel.name} for wheel in stand.flywheels] if "N" in (shape or ()) else [{}]
    places = [{"i": str(i + 1)} for count in (shape or ()) if isinstance(count, int) for i in range(count)]
    return [{**wheel, **place} for wheel in wheels for place in places or [{"i": "1"}]]


def read_map(path: Path, stand: Stand) -> FmuMap:
    """The map of a file. Raises DataError with a line for each fault."""
    try:
        raw = tomllib.loads(readable(path, "a map of variables").decode("utf-8"))
    except (UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise DataError([f"{path}: no TOML: {error}"]) from None
    except ValueError as error:
        raise DataError([str(error)]) from None
    problems: list[str] = []
    wants, takes = wants_of(stand), [body.name for body in stand.bodies if body.wrench_input]
    known = ("state", *wants)
    problems += [f'unknown key "{key}"{suggestion(key, known)}' for key in raw if key not in known]
    state = _table(raw, "state", problems)
    wrenches = _table(state, "wrench", problems)
    found = FmuMap(
        _group({key: state[key] for key in state if key != "wrench"}, inputs_of(stand), "state", problems),
        _group(wrenches, dict.fromkeys(takes, _names(stand, (6,))), "state.wrench", problems),
        {
            want: _group(_table(raw, want, problems), quantities, want, problems)
            for want, quantities in wants.items()
            if want in raw
        },
    )
    if problems := problems or _missing(stand, found):
        raise DataError([f"{path}: {problem}" for problem in problems])
    return found


def _table(table: Mapping[str, Any], key: str, problems: list[str]) -> Mapping[str, Any]:
    found = table.get(key, {})
    if isinstance(found, dict):
        return found
    problems.append(f"{key}: expected a table")
    return {}


def _group(table: Mapping[str, Any], known: Mapping[str, Names], where: str, problems: list[str]) -> Group:
    """The variables of each key: by a pattern, or by a list."""
    unknown = [key for key in table if key not in known]
    problems += [f'{where}: unknown key "{key}"{suggestion(key, known) if known else ""}' for key in unknown]
    found = {}
    for key, names in known.items():
        if key not in table:
            continue
        value = table[key]
        if isinstance(value, str):
            texts: list[Any] = []
            for each in names:
                text = value
                for name, word in each.items():
                    text = text.replace(f"{{{name}}}", word)
                texts.append(text)
        else:
            texts = value if isinstance(value, list) else [value]
        places = [_place(text) for text in texts]
        problems += [
            f"{where}.{key}: found {text!r:.60}, expected the name of a variable or "
            '{ variable = "NAME", factor = NUMBER }, the factor not zero'
            for text, place in zip(texts, places, strict=True)
            if place is None
        ]
        if len(places) != len(names):
            problems.append(f"{where}.{key}: {len(places)} variables, expected {len(names)}")
        found[key] = tuple(place for place in places if place is not None)
    return found


def _place(value: Any) -> Place | None:
    if isinstance(value, str):
        return Place(value)
    if isinstance(value, dict) and isinstance(value.get("variable"), str) and set(value) <= {"variable", "factor"}:
        factor = value.get("factor", 1.0)
        if isinstance(factor, int | float) and not isinstance(factor, bool) and factor:
            return Place(value["variable"], float(factor))
    return None


def _missing(stand: Stand, found: FmuMap) -> list[str]:
    """What a map lacks, in words."""
    wants, hold, given = wants_of(stand), stand.hold, found.inputs
    problems = [] if found.answers else [f"no answers, expected a table for a want: {', '.join(wants)}"]

    def require(keys: Sequence[str], reason: str) -> None:
        for key in keys:
            of_hold = hold is not None and key in TWISTS
            lacks = key not in given and bool(key in TWISTS or stand.flywheels)
            if of_hold:  # a clamped carrier has no motion
                lacks = lacks and TWISTS[key] not in given and bool(hold and hold.freedoms)
            if lacks:
                problems.append(f"state.{key}{f' or state.{TWISTS[key]}' if of_hold else ''} is missing: {reason}")

    require(("V", "phi", "phi_dot"), "every state has it")
    for want, group in found.answers.items():
        # of a held carrier the reaction is a want of its own, and u_dot and V_dot are one motion
        motion = {"u_dot", "V_dot"} if {"u_dot", "V_dot"} & group.keys() else set()
        spared = {"reaction", *motion} if hold is not None and want != "reaction" else set()
        problems += [f"{want}.{name} is missing" for name in wants[want] if name not in {*group, *spared}]
        require(needs_of(want), f"{want} needs it as an input of the FMU")
    if "quaternion" in given and "angles" in given:
        problems.append("state: quaternion and angles, expected one of them")
    coordinates = {"q", "orientation"} & inputs_of(stand).keys()
    if not problems and not (coordinates and coordinates <= given.keys()):
        problems += [
            f"state.{part} is missing: answers of this stand depend on it"
            for part, keys in POSES.items()
            if not given.keys() & set(keys) and depends_on(stand, list(found.answers), part)
        ]
    return problems + [
        f"state.wrench.{body.name} is missing: the stand has `wrench_input` there"
        for body in stand.bodies
        if body.wrench_input and body.name not in found.wrenches
    ]
