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

import re
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from mahovik.contract.evaluation import ANSWERS, STATE, Key, answers_of, needs_of
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


Map = Mapping[str, Mapping[str, tuple[Place, ...]]]
"""Variables by table and key: `state` and `state.wrench`, which are set, and a table for each want, which is read."""

SET = ("state", "state.wrench")
"""Tables of variables that are set."""

Names = Sequence[Mapping[str, str]]
"""What takes the place of {i}, {name} and {freedom} in a pattern, for each of the numbers of a key."""


def known_keys(stand: Stand) -> dict[str, dict[str, Names]]:
    """Tables that a map of a stand may have, and their keys."""
    keys = ("position", "quaternion", "angles", "V", "V_dot", "phi", "phi_dot", "phi_ddot", "tau")
    found = {"state": {key: _names(stand, STATE[key]) for key in keys}}
    found["state.wrench"] = {b.name: _names(stand, STATE["wrench"]) for b in stand.bodies if b.wrench_input}
    held = stand.hold is not None
    for want in (*WANTS, *(("reaction",) if held else ())):
        found[want] = {name: _names(stand, ANSWERS[name]) for name in answers_of(want, held)}
    if stand.hold is not None:
        freedoms = [{"i": str(k + 1), "freedom": name} for k, name in enumerate(freedom_names(stand.hold))]
        for table, key in (("state", "u"), ("state", "u_dot"), ("forward", "u_dot"), ("coupled", "u_dot")):
            found[table][key] = freedoms
        if has_coordinates(stand.hold):
            numbered = numbered_freedoms(stand.hold)
            found["state"]["q"] = [freedoms[k] for k in numbered]
            turns = len(numbered) < len(freedoms)
            found["state"]["orientation"] = _names(stand, STATE["quaternion"]) if turns else []
    return {table: {key: names for key, names in group.items() if names} for table, group in found.items()}


def _names(stand: Stand, key: Key) -> Names:
    """One of each number of a key, by flywheels and by its place."""
    shape = key.shape or ()
    wheels = [{"name": wheel.name} for wheel in stand.flywheels] if "N" in shape else [{}]
    places = [{"i": str(i + 1)} for count in shape if isinstance(count, int) for i in range(count)]
    return [{**wheel, **place} for wheel in wheels for place in places or [{"i": "1"}]]


def read_map(path: Path, stand: Stand) -> Map:
    """The map of a file. Raises DataError with a line for each fault."""
    try:
        raw = tomllib.loads(readable(path, "a map of variables").decode("utf-8"))
    except (UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise DataError([f"{path}: no TOML: {error}"]) from None
    except ValueError as error:
        raise DataError([str(error)]) from None
    known, problems = known_keys(stand), list[str]()
    state = raw.get("state", {})
    if isinstance(state, dict):
        wrenches = state.get("wrench", {})
        raw |= {"state": {key: state[key] for key in state if key != "wrench"}, "state.wrench": wrenches}
    found = {}
    for table, group in raw.items():
        if table not in known:
            problems.append(f'unknown key "{table}"{suggestion(table, [name for name in known if name != SET[1]])}')
        elif not isinstance(group, dict):
            problems.append(f"{table}: expected a table")
        else:
            found[table] = _group(group, known[table], table, problems)
    if problems := problems or _missing(stand, found, known):
        raise DataError([f"{path}: {problem}" for problem in problems])
    return found


def _group(
    table: Mapping[str, Any], known: Mapping[str, Names], where: str, problems: list[str]
) -> dict[str, tuple[Place, ...]]:
    """The variables of each key: by a pattern, or by a list."""
    found = {}
    for key, value in table.items():
        if key not in known:
            problems.append(f'{where}: unknown key "{key}"{suggestion(key, known) if known else ""}')
            continue
        texts = value if isinstance(value, list) else [value]
        if isinstance(value, str):
            texts = [_filled(value, names) for names in known[key]]
        places = [_place(text) for text in texts]
        problems += [
            f"{where}.{key}: found {text!r:.60}, expected the name of a variable or "
            '{ variable = "NAME", factor = NUMBER }, the factor not zero'
            for text, place in zip(texts, places, strict=True)
            if place is None
        ]
        if len(places) != len(known[key]):
            problems.append(f"{where}.{key}: {len(places)} variables, expected {len(known[key])}")
        found[key] = tuple(place for place in places if place is not None)
    return found


def _filled(pattern: str, names: Mapping[str, str]) -> str:
    return re.sub(r"{(\w+)}", lambda found: names.get(found[1], found[0]), pattern)


def _place(value: Any) -> Place | None:
    if isinstance(value, str):
        return Place(value)
    if isinstance(value, dict) and isinstance(value.get("variable"), str) and set(value) <= {"variable", "factor"}:
        factor = value.get("factor", 1.0)
        if isinstance(factor, int | float) and not isinstance(factor, bool) and factor:
            return Place(value["variable"], float(factor))
    return None


def _missing(stand: Stand, found: Map, known: Mapping[str, Mapping[str, Names]]) -> list[str]:
    """What a map lacks, in words."""
    hold, given = stand.hold, found.get("state", {}).keys()
    wants = [want for want in found if want not in SET]
    offered = ", ".join(name for name in known if name not in SET)
    problems = [] if wants else [f"no answers, expected a table for a want: {offered}"]

    def require(keys: Sequence[str], reason: str) -> None:
        for key in keys:
            other = TWISTS[key] if hold is not None and key in TWISTS else ""
            needed = bool(hold is None or hold.freedoms) if key in TWISTS else bool(stand.flywheels)
            if needed and not {key, other} & given:
                problems.append(f"state.{key}{f' or state.{other}' if other else ''} is missing: {reason}")

    require(("V", "phi", "phi_dot"), "every state has it")
    for want in wants:
        # of a held carrier the reaction is a want of its own, and u_dot and V_dot are one motion
        motion = {"u_dot", "V_dot"} if {"u_dot", "V_dot"} & found[want].keys() else set()
        spared = {"reaction", *motion} if hold is not None and want != "reaction" else set()
        problems += [f"{want}.{name} is missing" for name in known[want] if name not in {*found[want], *spared}]
        require(needs_of(want), f"{want} needs it as an input of the FMU")
    if {"quaternion", "angles"} <= given:
        problems.append("state: quaternion and angles, expected one of them")
    coordinates = {"q", "orientation"} & known["state"].keys()
    if not problems and not (coordinates and coordinates <= given):
        problems += [
            f"state.{part} is missing: answers of this stand depend on it"
            for part, keys in POSES.items()
            if not given & set(keys) and depends_on(stand, wants, part)
        ]
    wrenches = [body for body in known["state.wrench"] if body not in found.get("state.wrench", {})]
    return problems + [f"state.wrench.{body} is missing: the stand has `wrench_input` there" for body in wrenches]
