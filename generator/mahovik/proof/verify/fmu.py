"""An FMU as a program: lines of states in, lines of results out, each state set before initialization and read after.

A map, a file of TOML, says which of its variables is which number of the contract of `eval`:

    [state]                                # what the FMU is given
    V = "carrier.V[{i}]"                   # {i}: 1, 2, ...; {name}: each flywheel
    phi = "{name}.phi"
    phi_dot = ["wheel.w", { variable = "wheel2.w", factor = -1 }]
    [state.wrench]
    carrier = ["X", "Y", "Z", "K", "M", "N"]
    [forward]                              # what it answers: a table for each want
    V_dot = "carrier.V_dot[{i}]"

Of a held carrier u, u_dot, q may take the place of V, V_dot and the pose; {freedom}: the name of each freedom.
`factor`: SI units of one unit of the variable, with a sign. The FMU has a process of its own, which it may end:
`python -m mahovik.proof.verify.fmu FOLDER MAP STAND`.
"""

from __future__ import annotations

import os
import re
import sys
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

from mahovik.contract.evaluation import ANSWERS, MAY_BE_LEFT_OUT, STATE, Key, answers_of
from mahovik.core.stand import load
from mahovik.core.stand.files import readable_text
from mahovik.core.stand.hold import freedom_names, has_coordinates, numbered_freedoms, twists
from mahovik.core.stand.model import Stand, State
from mahovik.errors import DataError, MahovikError, StateError, UsageError
from mahovik.nearest import suggestion
from mahovik.proof.reference.coordinates import coordinates_at
from mahovik.proof.verify.draw import depends_on, freedom_rates, with_angles, with_quaternion
from mahovik.proof.verify.foreign import Program
from mahovik.proof.verify.states import evaluate_lines

WANTS = ("forward", "torque", "coupled", "mounts", "momentum")
"""Wants that an FMU may answer; of a held carrier also `reaction`."""

POSE = ("position", "quaternion")
SAID_BY: Mapping[str, tuple[str, ...]] = {
    "position": ("position",), "quaternion": ("quaternion", "angles"), "V": ("V", "u"), "V_dot": ("V_dot", "u_dot"),
    "phi": ("phi",), "phi_dot": ("phi_dot",), "phi_ddot": ("phi_ddot",), "tau": ("tau",),
}  # fmt: skip
"""What answers may depend on, and the keys of which one says it; those of coordinates say a pose as well."""

COORDINATES = ("q", "orientation")

SET = ("state", "state.wrench")
"""Tables of variables that are set; the others, one a want, are read."""


@dataclass(frozen=True)
class Place:
    """A variable of an FMU; `factor`: SI units of one of its units."""

    variable: str
    factor: float = 1.0


Map = Mapping[str, Mapping[str, tuple[Place, ...]]]
"""Variables by table and key."""

Names = Sequence[Mapping[str, str]]
"""What takes the place of {i}, {name} and {freedom} in a pattern, for each of the numbers of a key."""


def known_keys(stand: Stand) -> dict[str, dict[str, Names]]:
    """Tables that a map of a stand may have, and their keys."""
    hold, held = stand.hold, stand.hold is not None
    freedoms = [{"i": str(k), "freedom": name} for k, name in enumerate(freedom_names(hold) if hold else (), start=1)]
    numbered = [freedoms[k] for k in numbered_freedoms(hold)] if hold and has_coordinates(hold) else freedoms[:0]
    axes: dict[int | str, Names] = {count: [{"i": str(i + 1)} for i in range(count)] for count in (3, 4, 6)}
    axes |= {"N": [{"name": wheel.name} for wheel in stand.flywheels], "m": freedoms, "m or less": numbered}

    def numbers(key: Key) -> Names:
        places = product(*(axes[count] for count in key.shape or ()))
        return [{"i": "1"} | {word: text for part in place for word, text in part.items()} for place in places]

    keys = {key: STATE[key] for said in SAID_BY.values() for key in said} | {"q": ANSWERS["q"]}
    if hold and has_coordinates(hold) and len(numbered) < len(freedoms):
        keys["orientation"] = ANSWERS["orientation"]
    tables = {"state": keys, "state.wrench": {b.name: STATE["wrench"] for b in stand.bodies if b.wrench_input}}
    for want in (*WANTS, *(("reaction",) if held else ())):
        tables[want] = {name: ANSWERS[name] for name in answers_of(want, held)}
    named = {table: {name: numbers(key) for name, key in group.items()} for table, group in tables.items()}
    return {table: {name: names for name, names in group.items() if names} for table, group in named.items()}


def read_map(path: Path, stand: Stand) -> Map:
    """The map of a file. Raises DataError."""
    try:
        raw = tomllib.loads(readable_text(path, "a map of variables"))
    except tomllib.TOMLDecodeError as error:
        raise DataError([f"{path}: no TOML: {error}"]) from None
    except ValueError as error:
        raise DataError([str(error)]) from None
    if isinstance(raw.get("state"), dict) and "wrench" in raw["state"]:
        raw["state.wrench"] = raw["state"].pop("wrench")
    known = known_keys(stand)
    try:
        made = {table: _variables(table, group, known) for table, group in raw.items()}
    except ValueError as error:
        raise DataError([f"{path}: {error}"]) from None
    if problems := list(_missing(stand, made, known)):
        raise DataError([f"{path}: {problem}" for problem in problems])
    return made


def _variables(table: str, group: Any, known: Mapping[str, Mapping[str, Names]]) -> dict[str, tuple[Place, ...]]:
    """The variables of each key of a table: by a pattern, or by a list. Raises ValueError."""
    if table not in known:
        raise ValueError(f'unknown key "{table}"{suggestion(table, [name for name in known if name != SET[1]])}')
    if not isinstance(group, dict):
        raise ValueError(f"{table}: expected a table")
    places = {}
    for key, value in group.items():
        if key not in known[table]:
            raise ValueError(f'{table}: unknown key "{key}"{suggestion(key, known[table]) if known[table] else ""}')
        numbers = known[table][key]
        items = value if isinstance(value, list) else [value]
        if isinstance(value, str):
            items = [_filled(value, names) for names in numbers]
        places[key] = tuple(_place(f"{table}.{key}", item) for item in items)
        if len(items) != len(numbers):
            raise ValueError(f"{table}.{key}: {len(items)} variables, expected {len(numbers)}")
    return places


def _filled(pattern: str, names: Mapping[str, str]) -> str:
    return re.sub(r"{(\w+)}", lambda at: names.get(at[1], at[0]), pattern)


def _place(where: str, item: Any) -> Place:
    match item:
        case str():
            return Place(item)
        case {"variable": str(name), "factor": int() | float() as factor} if (
            len(item) == 2 and factor and factor is not True
        ):
            return Place(name, float(factor))
        case {"variable": str(name)} if len(item) == 1:
            return Place(name)
    expected = 'the name of a variable or { variable = "NAME", factor = NUMBER }, the factor not zero'
    raise ValueError(f"{where}: found {item!r:.60}, expected {expected}")


def _missing(stand: Stand, made: Map, known: Mapping[str, Mapping[str, Names]]) -> Iterator[str]:
    """What a map lacks, in words."""
    there, wants = made.get("state", {}).keys(), [want for want in made if want not in SET]
    if not wants:
        yield f"no answers, expected a table for a want: {', '.join(name for name in known if name not in SET)}"
    for want in wants:
        # of a held carrier the reaction is a want of its own, and u_dot and V_dot are one motion
        motion = {"u_dot", "V_dot"} if {"u_dot", "V_dot"} & made[want].keys() else set()
        spared = {*made[want], *motion, *(() if want == "reaction" else ("reaction",))}
        yield from (f"{want}.{name} is missing" for name in known[want] if name not in spared)
    coordinates = set(COORDINATES) & known["state"].keys()
    posed = POSE if coordinates and coordinates <= there else ()
    for part, keys in SAID_BY.items():
        if part not in posed and not there & set(keys) and depends_on(stand, wants, part):
            names = " or ".join(f"state.{key}" for key in keys if key in known["state"])
            yield f"{names} is missing: answers of this stand depend on it"
    for body in known["state.wrench"].keys() - made.get("state.wrench", {}).keys():
        yield f"state.wrench.{body} is missing: the stand has `wrench_input` there"


def fmu_program(fmu: Path, unpacked: Path, map_file: Path, stand: Stand, stand_file: str) -> Program:
    """A program that answers states by an FMU; `map_file` names its variables.

    It is unpacked into the folder `unpacked`, which must stay as long as the program runs. Raises DataError where a
    file cannot be used, UsageError where fmpy is missing.
    """
    variables = read_map(map_file, stand)
    try:
        from fmpy import extract, read_model_description
    except ImportError:
        raise UsageError(f'fmu {fmu}: needs fmpy; `pip install "mahovik[fmi]"`') from None
    if not fmu.is_file():
        raise DataError([f"{fmu}: no such file"])
    try:
        description = read_model_description(extract(fmu, unpacked), validate=False)
    except Exception as error:  # fmpy raises what zip, XML and schema raise
        reason = str(error).splitlines()[0] if str(error) else type(error).__name__
        raise DataError([f"{fmu}: no FMU: {reason}"]) from None
    if description.fmiVersion not in ("2.0", "3.0"):
        raise DataError([f"{fmu}: FMI {description.fmiVersion}, expected 2.0 or 3.0"])
    known = {variable.name: variable for variable in description.modelVariables}
    places = [(table, place.variable) for table, group in variables.items() for ps in group.values() for place in ps]
    faults = [f'{fmu}: "{name}" {fault}' for table, name in places if (fault := _fault(name, known, table in SET))]
    if faults:
        raise DataError(list(dict.fromkeys(faults)))
    words = (sys.executable, "-m", __name__, str(unpacked), str(map_file), stand_file)
    held = stand.hold is not None
    left_out = (*MAY_BE_LEFT_OUT, "reaction") if held else MAY_BE_LEFT_OUT
    return Program(str(fmu), words, tuple(want for want in variables if want not in SET), left_out, on_hold=held)


def _fault(name: str, known: Mapping[str, Any], is_set: bool) -> str:
    """Why a variable of an FMU cannot be read, or set, in words; "" where it can."""
    from fmpy.simulation import settable_in_initialization_mode, settable_in_instantiated

    if name not in known:
        return f"is no variable{suggestion(name, known)}"
    variable = known[name]
    if variable.type not in ("Real", "Float64") or getattr(variable, "dimensions", None):
        return "is no real scalar"
    settable = settable_in_instantiated(variable) or settable_in_initialization_mode(variable)
    return "cannot be set: it is calculated" if is_set and not settable else ""


class FmuBackend:
    """An FMU, unpacked in a folder, as a backend of one want at a time."""

    name = "fmu"

    def __init__(self, folder: Path, variables: Map, stand: Stand) -> None:
        from fmpy import read_model_description

        self._stand, self._map, self._folder = stand, variables, str(folder)
        self._description = read_model_description(self._folder, validate=False)

    def evaluate(self, state: State, want: Sequence[str]) -> dict[str, Any]:
        """See Backend."""
        from fmpy.simulation import instantiate_fmu, simulate_fmu

        (answered,) = want
        if answered not in self._map:
            raise StateError(f"{answered}: not in the map")
        names = [place.variable for places in self._map[answered].values() for place in places]
        kind = "CoSimulation" if self._description.modelExchange is None else "ModelExchange"
        instance = instantiate_fmu(self._folder, self._description, kind)
        try:
            row = simulate_fmu(
                self._folder, validate=False, model_description=self._description, fmi_type=kind, fmu_instance=instance,
                start_values=self._values(state), output=list(dict.fromkeys(names)), solver="Euler",
                start_time=0.0, stop_time=0.0, set_stop_time=False, step_size=1.0, output_interval=1.0,
            )[0]  # fmt: skip
        except Exception as error:  # fmpy raises its own errors of calls, and those of ctypes
            raise StateError(f"the FMU refused the state: {error}") from None
        finally:
            instance.freeInstance()
        answer = {}
        for name, places in self._map[answered].items():
            shape = ANSWERS[name].shape_of(len(self._stand.flywheels), len(state.u))
            answer[name] = np.reshape([row[place.variable] * place.factor for place in places], shape or ()).tolist()
        return self._whole(answer)

    def _whole(self, answer: dict[str, Any]) -> dict[str, Any]:
        """The answer of a held carrier with u_dot and V_dot, where it has one of them."""
        hold = self._stand.hold
        if hold is not None and "u_dot" in answer:
            answer.setdefault("V_dot", (twists(hold) @ np.array(answer["u_dot"])).tolist())
        elif hold is not None and "V_dot" in answer:
            answer["u_dot"] = freedom_rates(hold, np.array([answer["V_dot"]]))[0].tolist()
        return answer

    def _values(self, state: State) -> dict[str, float]:
        """Values of the variables that are set, by name."""
        turned = {"quaternion": with_quaternion, "angles": with_angles}
        pairs = [(places, state.wrench.get(body, (0.0,) * 6)) for body, places in self._map.get(SET[1], {}).items()]
        for key, places in self._map.get("state", {}).items():
            source = coordinates_at(self._stand, state) if key in COORDINATES else state
            pairs.append((places, getattr(turned[key](self._stand, state) if key in turned else source, key)))
        zipped = [pair for places, numbers in pairs for pair in zip(places, numbers, strict=True)]
        return {place.variable: float(x) / place.factor for place, x in zipped}


def main(folder: str, map_file: str, stand_file: str) -> None:
    """Answer the lines of standard input."""
    output = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)  # what the FMU prints is no answer
    stand = load(stand_file)
    backend = FmuBackend(Path(folder), read_map(Path(map_file), stand), stand)
    for line, _ in evaluate_lines(stand, backend, sys.stdin.buffer):
        print(line, file=output, flush=True)


if __name__ == "__main__":
    try:
        main(*sys.argv[1:])
    except MahovikError as refusal:
        sys.exit(str(refusal))
