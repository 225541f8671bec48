"""The wrenches of a stand's laws, of many samples at once, with slopes: the functions of its program on arrays."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from functools import cached_property, lru_cache
from types import SimpleNamespace
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.contract.laws import BODY_LAWS, parts
from mahovik.core import routines
from mahovik.core.lower import checks, coordinates, prepare
from mahovik.core.lower.law import ATTITUDE, OWN_TWIST, BodyProgram
from mahovik.core.lower.layout import Layout
from mahovik.core.lower.library import Library
from mahovik.core.lower.values import laws_of, parameters_of
from mahovik.core.lower.wrenches import add_laws, damp
from mahovik.core.program.columns import Array, Arrays, Columns, Trace
from mahovik.core.program.function import Program
from mahovik.core.program.interpret import Interpreter, plain
from mahovik.core.program.kernel import Reals, result
from mahovik.core.program.tangent import Tangents
from mahovik.core.program.types import DOUBLE
from mahovik.core.stand.model import Stand, Structure
from mahovik.core.stand.structure import structure
from mahovik.errors import StateError

POSE = {"position": 3, "attitude": 4, "V": 6, "C": 9}
"""Inputs of the laws between E0 and the carrier: place of O1, quaternion, twist, rotation matrix row by row."""

UNIT = np.eye(6).tolist()


@lru_cache(maxsize=16)
def law_functions(stand_structure: Structure) -> tuple[Library, Interpreter, Columns]:
    """The functions of the laws alone; `damped` adds up those of a body by its twist, `tied` those of the carrier."""
    layout = Layout(stand_structure, DOUBLE)
    lib = Library(layout)
    for routine in (routines.sincos, routines.square_root, routines.atan2):
        lib.add(routine(DOUBLE))
    lib.add(checks.within(lib))
    lib.add(coordinates.rotation())
    lib.add(coordinates.rotate_back)
    lib.add(coordinates.quaternion(lib))
    prepare.add_frame_of_axes(lib)
    add_laws(lib)
    wrench: Any = result("", 6, unit="N, N m")
    refuses = any(law.refuses for law in layout.law_tables)

    @lib.kernel()
    def damped(table: Any = lib.table, damper: Any = lib.damper, V: Reals = OWN_TWIST, P: Reals = wrench) -> None:
        """Wrench of the laws of a body by its own twist."""
        P[:] = [0] * 6
        damp(lib, table, damper, V, P)

    @lib.kernel(statuses=("OK", "RANGE") if refuses else ())
    def tied(table: Any = lib.table, x: Any = lib.x, C: Any = ATTITUDE, F: Any = wrench) -> Any:
        """Wrench of the laws between E0 and the carrier."""
        F[:] = [0] * 6
        for law in layout.law_tables:
            law.act(lib, table, x, C, F)

    tangents, inputs = Tangents(lib), {"position": "x.position", "attitude": "x.attitude", "V": "x.V", "C": "C"}
    if layout.damped and "V" in lib.taken("damped"):
        tangents.change("damped", {"V": ["V"]})
    if layout.law_tables:
        tangents.change("tied", {d: [path] for d, path in inputs.items() if path.split(".")[0] in lib.taken("tied")})
    program = Program(stand_structure.name, DOUBLE, (), (), lib.functions)
    return lib, Interpreter(program), Columns(program)


def law_arrays(stand: Stand) -> LawArrays:
    """The laws of a stand, made once for its numbers. Raises StandError where one is out of range."""
    stand_structure = structure(stand)
    lib, interpreter, _ = law_functions(stand_structure)
    table = laws_of(stand, lib.layout, interpreter)
    for k, one in enumerate(parameters_of(stand, lib.layout)["instrument"] if stand.instruments else ()):
        axes = interpreter.run("frame_of_axes", {"axis": one["axis"], "zero": one["zero"]})[1]["R"]
        table.sensor[k].axes = axes
    return _at_numbers(stand_structure, json.dumps(plain(table)))


@lru_cache(maxsize=64)
def _at_numbers(stand_structure: Structure, numbers: str) -> LawArrays:
    return LawArrays(stand_structure, json.loads(numbers))


class LawArrays:
    """The laws of a stand, at the numbers of its table."""

    def __init__(self, stand_structure: Structure, numbers: dict[str, Any]) -> None:
        self._lib, interpreter, self._columns = law_functions(stand_structure)
        layout, self.names = self._lib.layout, {f.name for f in self._lib.functions}
        self.table = table = interpreter.fill_storage(layout.table, numbers)
        dampers = ({0: table.damper} if layout.carrier_damped else {}) | {
            body.index: table.frame[k].damper for k, body in enumerate(layout.local_bodies) if layout.local_damped
        }
        acted_on = {i for law in parts("program", BodyProgram, BODY_LAWS) for i in law.bodies(layout.structure)}
        self.bodies = tuple(
            TwistLaws(self, dampers[i]) if i in acted_on else None for i in range(len(stand_structure.bodies))
        )
        """The laws of each body by its own twist; None where it has none."""

    def arrays(
        self, name: str, trace: Trace, changes: Sequence[Mapping[str, Any]], inputs: Mapping[str, Any]
    ) -> Arrays:
        """A function of the program, once for each of `changes` of its inputs; results of all by component."""
        columns, refused = [], self._columns.refused
        refused.clear()
        for change in changes:
            columns.append([0.0] * 6)
            named = {"table": self.table, **inputs, **change} | dict.fromkeys(("P", "F", "d_P", "d_F"), columns[-1])
            self._columns.call(name, *(named[argument] for argument in self._lib.taken(name)))
        results = [x for row in zip(*columns, strict=True) for x in row]
        return Arrays(trace, results, refused, mean=len(changes) > 1)

    # -- laws between E0 and the carrier -----------------------------------------------------------------------------

    @property
    def ties(self) -> bool:
        """Are there laws between E0 and the carrier?"""
        return bool(self._lib.layout.law_tables)

    def tied(self, O1: Array, C: Array, V: Array) -> Array:
        """Their wrench (M, 6) on the carrier about O1 in E1, at places O1 (M, 3), C (M, 3, 3), V (M, 6). StateError."""
        return self._at(self._tied, O1, C, V)

    def tied_slopes(self, O1: Array, C: Array, V: Array) -> Array:
        """Its derivatives (M, 6, 12) by a small pose (translation, rotation vector on E1) and by V.

        At a kink the mean of both sides. Raises StateError.
        """
        return self._at(self._tied_slopes, O1, C, V).reshape(-1, 6, 12)

    def _at(self, arrays: Arrays, O1: Array, C: Array, V: Array) -> Array:
        q = quaternions(C) if arrays.takes(range(3, 7)) else np.zeros((len(V), 4))
        wrenches, refused = arrays(np.concatenate([O1, q, V, C.reshape(-1, 9)], axis=1).T)
        if refused:
            words = [law.invalid for law in self._lib.layout.law_tables if law.refuses]
            raise StateError(f"{' or '.join(words)} on the way")
        return wrenches

    @cached_property
    def _tied(self) -> Arrays:
        trace, pose = _pose()
        return self.arrays("tied", trace, [{}], pose)

    @cached_property
    def _tied_slopes(self) -> Arrays:
        trace, pose = _pose()
        C, w, v = np.array(pose["C"]).reshape(3, 3), pose["attitude"][0], np.array(pose["attitude"][1:])
        changes = [{"d_position": C[:, k].tolist()} for k in range(3)]
        for e in np.eye(3):
            turned = np.cross(np.eye(3), -e)  # rows e x e_i: those of <e>^T
            attitude = [-0.5 * (v @ e), *(0.5 * (e * w + np.cross(v, e)))]
            changes.append({"d_C": (C @ turned.T).ravel().tolist(), "d_attitude": attitude})
        changes += [{"d_V": e} for e in UNIT]
        none = {f"d_{name}": [0.0] * size for name, size in POSE.items()}
        name = next(f.name for f in self._lib.functions if f.name.startswith("tied_by"))
        return self.arrays(name, trace, [none | change for change in changes], pose)


class TwistLaws:
    """The laws of one body by its own twist v (M, 6) relative to the fluid, in the body's frame."""

    def __init__(self, laws: LawArrays, damper: Any) -> None:
        self._laws, self.damper = laws, damper

    def wrench(self, v: Array) -> Array:
        """P (M, 6; N, N m)."""
        return self._wrench(v.T)[0]

    def rate(self, v: Array) -> Array:
        """dP/dv (M, 6, 6); |v| has the slope 0 at v = 0."""
        if "damped_by_V" not in self._laws.names:  # of laws that read no speed
            return np.zeros((len(v), 6, 6))
        return self._rate(v.T)[0].reshape(-1, 6, 6)

    @cached_property
    def _wrench(self) -> Arrays:
        return self._arrays("damped", [{}])

    @cached_property
    def _rate(self) -> Arrays:
        return self._arrays("damped_by_V", [{"d_V": e} for e in UNIT])

    def _arrays(self, name: str, changes: Sequence[Mapping[str, Any]]) -> Arrays:
        trace = Trace()
        return self._laws.arrays(name, trace, changes, {"damper": self.damper, "V": trace.inputs(6)})


def _pose() -> tuple[Trace, dict[str, Any]]:
    """Inputs of the laws between E0 and the carrier by their names."""
    trace = Trace()
    inputs = {name: trace.inputs(size) for name, size in POSE.items()}
    return trace, inputs | {"x": SimpleNamespace(**inputs)}


def quaternions(C: Array) -> Array:
    """Quaternions (M, 4), w first, of rotations C (M, 3, 3)."""
    return np.roll(Rotation.from_matrix(C).as_quat(), 1, axis=1)
