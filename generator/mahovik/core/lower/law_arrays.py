"""The wrenches of a stand's laws, of many samples at once, with slopes: the functions of its program on arrays."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
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
from mahovik.core.program.columns import Array, Columns
from mahovik.core.program.function import Program
from mahovik.core.program.interpret import Interpreter
from mahovik.core.program.kernel import Reals, result
from mahovik.core.program.tangent import Tangents
from mahovik.core.program.types import DOUBLE
from mahovik.core.stand.model import Stand, Structure
from mahovik.core.stand.structure import structure
from mahovik.errors import StateError

UNIT = np.eye(6)


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


class LawArrays:
    """The laws of a stand. Raises StandError where one is out of range."""

    def __init__(self, stand: Stand) -> None:
        self._lib, interpreter, self._columns = law_functions(structure(stand))
        layout, self.names = self._lib.layout, {f.name for f in self._lib.functions}
        self.table = table = laws_of(stand, layout, interpreter)
        for k, one in enumerate(parameters_of(stand, layout)["instrument"] if stand.instruments else ()):
            axes = interpreter.run("frame_of_axes", {"axis": one["axis"], "zero": one["zero"]})[1]["R"]
            table.sensor[k].axes = axes
        dampers = ({0: table.damper} if layout.carrier_damped else {}) | {
            body.index: table.frame[k].damper for k, body in enumerate(layout.local_bodies) if layout.local_damped
        }
        acted_on = {i for law in parts("program", BodyProgram, BODY_LAWS) for i in law.bodies(layout.structure)}
        self.bodies = tuple(
            TwistLaws(self, dampers[i]) if i in acted_on else None for i in range(len(layout.structure.bodies))
        )
        """The laws of each body by its own twist; None where it has none."""

    def run(self, name: str, shape: tuple[int, ...], inputs: Mapping[str, Any], turned: bool = False) -> Array:
        """What a function of the program gives (*shape, 6). Raises StateError where it refuses a sample."""
        result, columns = [0.0] * 6, self._columns
        columns.begin(turned)
        named = {"table": self.table, **inputs} | dict.fromkeys(("P", "F", "d_P", "d_F"), result)
        columns.call(name, *(named[argument] for argument in self._lib.taken(name)))
        if any(map(np.any, columns.refused)):
            words = [law.invalid for law in self._lib.layout.law_tables if law.refuses]
            raise StateError(f"{' or '.join(words)} on the way")
        return np.stack([np.broadcast_to(x, shape) for x in result], axis=-1)

    def slopes(self, name: str, shape: tuple[int, int], inputs: Mapping[str, Any]) -> Array:
        """Derivatives (M, 6, n) that a function gives for n directions of M samples, a shape (n, M).

        At a kink the mean of both sides.
        """
        result = self.run(name, shape, inputs)
        if any(map(np.any, self._columns.ties)):
            result = 0.5 * (result + self.run(name, shape, inputs, turned=True))
        return result.transpose(1, 2, 0)

    # -- laws between E0 and the carrier -----------------------------------------------------------------------------

    @property
    def ties(self) -> bool:
        """Are there laws between E0 and the carrier?"""
        return bool(self._lib.layout.law_tables)

    def tied(self, O1: Array, C: Array, V: Array) -> Array:
        """Their wrench (M, 6) on the carrier about O1 in E1, at places O1 (M, 3), C (M, 3, 3), V (M, 6). StateError."""
        return self.run("tied", (len(V),), _pose(O1, quaternions(C), C, V))

    def tied_slopes(self, O1: Array, C: Array, V: Array) -> Array:
        """Its derivatives (M, 6, 12) by a small pose (translation, rotation vector on E1) and by V. StateError."""
        q, M = quaternions(C), len(V)
        d_O1, d_q, d_C, d_V = np.zeros((12, M, 3)), np.zeros((12, M, 4)), np.zeros((12, M, 3, 3)), np.zeros((12, M, 6))
        d_O1[:3], d_V[6:] = C.transpose(2, 0, 1), UNIT[:, None]
        for k, e in enumerate(np.eye(3), 3):
            d_C[k] = C @ np.cross(np.eye(3), -e).T  # rows e x e_i: those of <e>^T
            d_q[k, :, 0], d_q[k, :, 1:] = -0.5 * (q[:, 1:] @ e), 0.5 * (e * q[:, :1] + np.cross(q[:, 1:], e))
        changes = {f"d_{name}": x for name, x in _pose(d_O1, d_q, d_C, d_V).items()}
        name = next(f.name for f in self._lib.functions if f.name.startswith("tied_by"))
        return self.slopes(name, (12, M), _pose(O1, q, C, V) | changes)


class TwistLaws:
    """The laws of one body by its own twist v (M, 6) relative to the fluid, in the body's frame."""

    def __init__(self, laws: LawArrays, damper: Any) -> None:
        self._laws, self.damper = laws, damper

    def wrench(self, v: Array) -> Array:
        """P (M, 6; N, N m)."""
        return self._laws.run("damped", (len(v),), {"damper": self.damper, "V": [*v.T]})

    def rate(self, v: Array) -> Array:
        """dP/dv (M, 6, 6); |v| has the slope 0 at v = 0."""
        if "damped_by_V" not in self._laws.names:  # of laws that read no speed
            return np.zeros((len(v), 6, 6))
        changes = {"damper": self.damper, "V": [*v.T], "d_V": [*UNIT[:, :, None]]}
        return self._laws.slopes("damped_by_V", (6, len(v)), changes)


def _pose(O1: Array, q: Array, C: Array, V: Array) -> dict[str, Any]:
    """Inputs of the laws between E0 and the carrier by their names; the last axes of arrays are components."""
    numbers = {"position": O1, "attitude": q, "V": V, "C": C.reshape(*V.shape[:-1], 9)}
    inputs: dict[str, Any] = {name: [*np.moveaxis(x, -1, 0)] for name, x in numbers.items()}
    return inputs | {"x": SimpleNamespace(**inputs)}


def quaternions(C: Array) -> Array:
    """Quaternions (M, 4), w first, of rotations C (M, 3, 3)."""
    return np.roll(Rotation.from_matrix(C).as_quat(), 1, axis=1)
