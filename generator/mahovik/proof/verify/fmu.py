"""An FMU as a program: lines of states in, lines of results out, each state set before initialization and read after.

Started in a process of its own, which an FMU may end: `python -m mahovik.proof.verify.fmu FOLDER MAP STAND`.
"""

from __future__ import annotations

import json
import math
import os
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any
from zipfile import ZipFile

import numpy as np

from mahovik.contract.evaluation import ANSWERS, MAY_BE_LEFT_OUT
from mahovik.core.stand import read
from mahovik.core.stand.hold import twists
from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.core.stand.units import show
from mahovik.errors import DataError, MahovikError, UsageError
from mahovik.nearest import suggestion
from mahovik.proof.reference.coordinates import coordinates_at
from mahovik.proof.verify.fmu_map import SET, Map, Place, read_map
from mahovik.proof.verify.foreign import Program
from mahovik.proof.verify.held import freedom_rates, with_angles, with_quaternion
from mahovik.proof.verify.states import Request, read_line

KINDS = (("ModelExchange", "modelExchange"), ("CoSimulation", "coSimulation"))
"""Kinds of FMU, the preferred one first, with their names in a description."""

MOST_FILES, MOST_BYTES, MOST_DESCRIPTION = 10_000, 1 << 30, 1 << 26
"""Files of an FMU, their bytes and those of its modelDescription.xml: more is not unpacked."""


def fmu_program(fmu: Path, unpacked: Path, map_file: Path, stand: Stand, stand_file: str) -> Program:
    """A program that answers states by an FMU; `map_file` names its variables.

    It is unpacked into the folder `unpacked`, which must stay as long as the program runs. Raises DataError where a
    file cannot be used, UsageError where fmpy is missing.
    """
    found = read_map(map_file, stand)
    _check_variables(fmu, _unpack(fmu, unpacked), found)
    words = (sys.executable, "-m", __name__, str(unpacked), str(map_file), stand_file)
    held = stand.hold is not None
    left_out = (*MAY_BE_LEFT_OUT, "reaction") if held else MAY_BE_LEFT_OUT
    wants = tuple(want for want in found if want not in SET)
    return Program(str(fmu), words, wants, left_out, on_hold=held)


def _unpack(fmu: Path, folder: Path) -> Any:
    """Unpack an FMU; return its description. Raises DataError, also where it is too large; UsageError without fmpy."""
    try:
        from fmpy import read_model_description
    except ImportError:
        raise UsageError(f'--fmu {fmu}: needs fmpy; `pip install "mahovik[fmi]"`') from None
    if not fmu.is_file():
        raise DataError([f"{fmu}: no such file"])
    try:
        with ZipFile(fmu) as archive:
            _require_harmless(archive)
            archive.extractall(folder)
        found = read_model_description(str(folder), validate=False)
    except Exception as error:  # fmpy raises what zip, XML and schema raise
        reason = str(error).splitlines()[0] if str(error) else type(error).__name__
        raise DataError([f"{fmu}: no FMU: {reason}"]) from None
    if found.fmiVersion not in ("2.0", "3.0"):
        raise DataError([f"{fmu}: FMI {found.fmiVersion}, expected 2.0 or 3.0"])
    return found


def _require_harmless(archive: ZipFile) -> None:
    """Raise ValueError for an archive that would fill the disk, or write outside its folder."""
    sizes = {each.filename: each.file_size for each in archive.infolist()}
    for what, count, most in (
        ("files", len(archive.infolist()), MOST_FILES),
        ("bytes of modelDescription.xml", sizes.get("modelDescription.xml", 0), MOST_DESCRIPTION),
        ("bytes", sum(each.file_size for each in archive.infolist()), MOST_BYTES),
    ):
        if count > most:
            raise ValueError(f"{count} {what}, expected at most {most}")
    for name in sizes:
        if name.startswith("/") or set("\\:") & set(name) or ".." in name.split("/"):
            raise ValueError(f"a file named {show(name)}, expected names inside of it")


def _check_variables(fmu: Path, description: Any, found: Map) -> None:
    """Raises DataError: a variable is not there, no number, or cannot be set."""
    known = {variable.name: variable for variable in description.modelVariables}
    problems: dict[str, None] = {}  # each once
    for table, group in found.items():
        for name in (place.variable for places in group.values() for place in places):
            if name not in known:
                problems[f'{fmu}: no variable "{name}"{suggestion(name, known)}'] = None
            elif known[name].type not in ("Real", "Float64") or getattr(known[name], "dimensions", None):
                problems[f'{fmu}: "{name}" is no real scalar'] = None
            elif table in SET and not _settable(known[name]):
                problems[f'{fmu}: "{name}" cannot be set: it is calculated'] = None
    if problems:
        raise DataError(list(problems))


def _settable(variable: Any) -> bool:
    free = variable.causality in ("input", "parameter") or variable.start is not None
    return variable.variability != "constant" and free


class FmuProgram:
    """An FMU that answers requests."""

    def __init__(self, folder: Path, found: Map, stand: Stand) -> None:
        """`folder`: of the unpacked FMU."""
        from fmpy import read_model_description

        self._stand, self._map, self._folder = stand, found, str(folder)
        self._description = read_model_description(self._folder, validate=False)
        self._variables = {v.name: v for v in self._description.modelVariables}
        self._kind = next(kind for kind, name in KINDS if getattr(self._description, name) is not None)
        self._second = self._description.fmiVersion == "2.0"
        self._instance: Any = None

    def answer(self, request: Request) -> dict[str, Any]:
        """Quantities of the one want of a request."""
        (want,) = request.want
        if want not in self._map:
            return {"error": f"{want}: not in the map"}
        instance = self._fresh()
        values = self._values(request.state)
        inputs = {k: x for k, x in values.items() if self._variables[k].causality == "input"}
        self._set(instance, {k: x for k, x in values.items() if k not in inputs})
        if self._second:
            instance.setupExperiment(startTime=0.0)
            instance.enterInitializationMode()
        else:
            instance.enterInitializationMode(startTime=0.0)
        self._set(instance, inputs)
        instance.exitInitializationMode()
        found: dict[str, Any] = {}
        for name, places in self._map[want].items():
            shape = ANSWERS[name].shape_of(len(self._stand.flywheels), len(request.state.u))
            found[name] = np.reshape(self._get(instance, places), shape or ()).tolist()
        return self._whole(found)

    def _whole(self, answer: dict[str, Any]) -> dict[str, Any]:
        """The answer of a held carrier with u_dot and V_dot, where it has one of them."""
        hold = self._stand.hold
        if hold is not None and "u_dot" in answer:
            answer.setdefault("V_dot", (twists(hold) @ np.array(answer["u_dot"])).tolist())
        elif hold is not None and "V_dot" in answer:
            answer["u_dot"] = freedom_rates(hold, np.array([answer["V_dot"]]))[0].tolist()
        return answer

    def _fresh(self) -> Any:
        """An instance that nothing was set in yet."""
        from fmpy.simulation import instantiate_fmu

        if self._instance is not None:
            try:
                self._instance.reset()
                return self._instance
            except Exception:  # it cannot be reset: take a new one
                self._instance.freeInstance()
        self._instance = instantiate_fmu(self._folder, self._description, self._kind)
        return self._instance

    def _values(self, state: State) -> dict[str, float]:
        """Values of the variables that are set, by name."""
        pairs: list[tuple[tuple[Place, ...], Sequence[float]]] = []
        for key, places in self._map.get("state", {}).items():
            if key in ("q", "orientation"):
                pairs.append((places, getattr(coordinates_at(self._stand, state), key).tolist()))
            else:
                turn = {"quaternion": with_quaternion, "angles": with_angles}.get(key, lambda _, same: same)
                pairs.append((places, getattr(turn(self._stand, state), key)))
        for name, places in self._map.get("state.wrench", {}).items():
            pairs.append((places, state.wrench.get(name, (0.0,) * 6)))
        return {
            place.variable: float(x) / place.factor
            for places, numbers in pairs
            for place, x in zip(places, numbers, strict=True)
        }

    def _set(self, instance: Any, values: Mapping[str, float]) -> None:
        if values:
            put = instance.setReal if self._second else instance.setFloat64
            put([self._variables[name].valueReference for name in values], list(values.values()))

    def _get(self, instance: Any, places: Sequence[Place]) -> list[float]:
        get = instance.getReal if self._second else instance.getFloat64
        values = get([self._variables[place.variable].valueReference for place in places])
        return [float(x) * place.factor for x, place in zip(values, places, strict=True)]


def main(folder: str, map_file: str, stand_file: str) -> None:
    """Answer the lines of standard input."""
    output = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)  # what the FMU prints is no answer
    stand = read.load(stand_file)
    program = FmuProgram(Path(folder), read_map(Path(map_file), stand), stand)
    for line in sys.stdin:
        if not line.strip():
            continue
        request = read_line(stand, line)
        try:
            result = program.answer(request)
        except Exception as error:  # fmpy raises its own errors of calls, and those of ctypes
            result = {"error": f"the FMU refused the state: {error}"}
        if not all(
            math.isfinite(x) for value in result.values() if not isinstance(value, str) for x in np.ravel(value)
        ):
            result = {"error": "the FMU answers numbers that are not finite"}
        print(json.dumps({"id": request.id, **result}), file=output, flush=True)


if __name__ == "__main__":
    try:
        main(*sys.argv[1:])
    except MahovikError as refusal:
        sys.exit(str(refusal))
