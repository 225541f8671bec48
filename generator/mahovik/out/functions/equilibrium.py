"""`rest`: the static equilibrium of a stand."""

from __future__ import annotations

import contextlib
import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from mahovik.core.stand.model import Stand as CoreStand
from mahovik.core.stand.state import State
from mahovik.errors import CheckError
from mahovik.out.api.fields import Array
from mahovik.out.api.stands import Stand
from mahovik.out.functions.given import Number, StandGiven, by_flywheel
from mahovik.out.functions.notices import warn
from mahovik.out.functions.table import Column, Table
from mahovik.proof.reference.rotation import carrier_rotation
from mahovik.use.simulate.held import home
from mahovik.use.study.rest import Rest as CoreRest
from mahovik.use.study.rest import rest as find_rest

if TYPE_CHECKING:
    from mahovik.out.report.plot.panel import Panel

POSE = ("x", "y", "z", "rx", "ry", "rz")


class Rest(Table):
    """The static equilibrium: a row per free direction, a twist in E1 (m, rad per rad or m). `state` is the pose.

    `V_dot` (6): remaining acceleration; `unstable`: the stand would leave the pose.
    """

    def __init__(self, stand: Stand, result: CoreRest) -> None:
        self.stand, self.result = stand, result

    @property
    def columns(self) -> tuple[Column, ...]:
        free = np.array(self.result.free).reshape(-1, 6)
        units = ("m", "m", "m", "rad", "rad", "rad")
        return tuple(Column(name, unit, free[:, i]) for i, (name, unit) in enumerate(zip(POSE, units, strict=True)))

    @property
    def state(self) -> State:
        """The state at rest, which `simulate` and `linearize` take."""
        return self.result.state

    @property
    def position(self) -> Array:
        """O1 in E0 (3), m."""
        return np.array(self.result.state.position)

    @property
    def attitude(self) -> Array:
        """Unit quaternion of the carrier, w first."""
        return np.array(self.result.state.quaternion or (1.0, 0.0, 0.0, 0.0))

    @property
    def V_dot(self) -> Array:
        """Remaining acceleration (6), m/s2, rad/s2."""
        return np.array(self.result.V_dot)

    @property
    def unstable(self) -> bool:
        """Whether the stand would leave this pose."""
        return self.result.unstable

    def _panels(self) -> Sequence[Panel]:
        """Centres of mass of the bodies at rest, joined with O1: seen along y of E0, and against x."""
        from mahovik.core.stand.summary import summarize
        from mahovik.out.report.plot.panel import Line, Panel

        w, x, y, z = self.attitude
        C = np.array(
            [
                [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
            ]
        )
        bodies = summarize(self.stand, None).bodies
        far = 1.1 * max(math.hypot(*body.center_of_mass) for body in bodies) or 0.1
        found = []
        for i, name in enumerate("xy"):
            lines = []
            for k, body in enumerate(bodies):
                ends = np.stack([self.position, self.position + C @ body.center_of_mass])
                lines.append(Line(body.name, ends[:, i], ends[:, 2], k))
            quantity, span = "z in E0, m, from O1 to the centres of mass", self.position[i] + np.array([-far, far])
            across = (float(span[0]), float(span[1]))
            found.append(Panel(quantity, tuple(lines), abscissa=f"{name} in E0, m", beside=i == 1, span=across))
        return found

    def to_dict(self) -> dict[str, Any]:
        """All of it, as `mahovik rest --json` prints it."""
        from mahovik.proof.verify.states import state_object

        return {
            "name": self.stand.name,
            "state": state_object(self.state),
            "V_dot": self.result.V_dot,
            "free": [list(direction) for direction in self.result.free],
            "unstable": self.unstable,
        }

    def __repr__(self) -> str:
        x, y, z = (f"{round(value, 9) + 0.0:.6g}" for value in self.position)
        return f"<Rest of {self.stand.name}: O1 at ({x}, {y}, {z}) m; {len(self)} free directions>"


TURNED = math.radians(5.0)
"""Angle of the rest pose from the home pose above which what starts from it says so."""


def rest_to_start(stand: CoreStand, phi: Sequence[float] | None = None) -> State:
    """The state at rest from which a function starts. Warns of a pose that is turned. Raises CheckError."""
    found = find_rest(stand, phi).state
    warn_of_turn(stand, found)
    return found


def warn_of_turn(stand: CoreStand, found: State | None = None) -> None:
    """Warn where the rest pose is far from upright, that of E0, or from the home pose of a hold.

    found  the state at rest; None: it is searched, and where there is none nothing is said
    """
    if found is None:
        with contextlib.suppress(CheckError):
            rest_to_start(stand)
        return
    C = carrier_rotation(stand, home(stand)).T @ carrier_rotation(stand, found)
    turn = 2.0 * math.asin(min(1.0, math.sqrt(max(0.0, 3.0 - float(np.trace(C)))) / 2.0))
    if turn > TURNED:
        of = "E0" if stand.hold is None else "the home pose"
        warn(f"starts from rest, where the stand is turned by {math.degrees(turn):.3g} deg from {of}: see mahovik rest")


def rest(stand: StandGiven, phases: Mapping[str, Number] | Sequence[Number] | None = None) -> Rest:
    """Find the static equilibrium, with flywheels at rest at `phases` (rad, or texts with a unit; default 0).

    Raises StandError, UsageError; CheckError: there is no equilibrium.
    """
    own = Stand.of(stand)
    return Rest(own, find_rest(own, by_flywheel("phases", phases, own)))
