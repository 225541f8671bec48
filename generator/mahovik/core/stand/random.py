"""Random general stands and states, ordinary and extreme, from a seeded generator: verification, campaigns and tests.

Every body is a cloud of point masses, so every inertia is physical and nothing is symmetric by accident.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from itertools import cycle
from operator import mul
from types import MappingProxyType
from typing import Any, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

from mahovik.contract.laws import LAWS
from mahovik.contract.quantities import BOUNDS, QUANTITIES, limits_of
from mahovik.core.stand.coordinates import dependent_rows, places_of
from mahovik.core.stand.declare import Draw, Size, rows
from mahovik.core.stand.fields import Mat3
from mahovik.core.stand.hold import twist_of, twists
from mahovik.core.stand.laws import body_laws, carrier_laws
from mahovik.core.stand.model import (
    COMPONENTS,
    Carrier,
    Encoder,
    Flywheel,
    Instrument,
    MountingAngles,
    MountingAxes,
    Point,
    Quaternion,
    Sequence,
    Stand,
    State,
    Task,
    TaskRow,
    Vec3,
    Vec6,
    rest_state,
)
from mahovik.core.stand.motor import Motor

__all__ = ["BARE", "EVERYTHING", "EXTREMES", "SEQUENCES", "Features", "extreme_state", "random_stand", "random_state"]

Array = NDArray[np.float64]
AnyBody = TypeVar("AnyBody", Carrier, Instrument, Flywheel)

SEQUENCES: tuple[Sequence, ...] = ("ship", "aircraft", "euler")


@dataclass(frozen=True)
class Features:
    """Features of a random stand. None: drawn.

    fluid           added mass, and the laws of bodies (on flywheels as well)
    wrench_inputs   some bodies take a run-time wrench
    laws            how many of each law of `laws/`, by its folder; where there can be one only, 1 or more gives it
    tasks           how many, each of one to six rows
    flow            the other laws of fluid as well: strips, fins, propellers, damping that fades
    """

    angles: Sequence | None = None
    instruments: int | None = None
    gravity: bool | None = None
    stream: bool | None = None
    fluid: bool | None = None
    points: int | None = None
    wrench_inputs: bool | None = None
    motors: bool | None = None
    laws: Mapping[str, int] = field(default_factory=dict)
    tasks: int | None = None
    flow: bool = False


EVERYTHING = Features(None, 2, True, True, True, 2, True, True, dict.fromkeys(LAWS, 2), 2)
"""Every kind of wrench and body at once; the attitude sequence is drawn."""
BARE = Features(None, 0, False, False, False, 0, False, False, dict.fromkeys(LAWS, 0), 0)
"""Carrier and flywheels in free space."""


def random_stand(
    rng: np.random.Generator, flywheels: int, features: Features = Features(), name: str = "random"
) -> Stand:
    """A general stand with `flywheels` flywheels. The same generator state gives the same stand."""
    draw = _Bodies(rng)
    angles = features.angles or SEQUENCES[int(rng.integers(3))]
    fluid = draw.flag(features.fluid)
    inputs = draw.flag(features.wrench_inputs)
    motors = draw.flag(features.motors)
    names = [f"i{k + 1}" for k in range(draw.count(features.instruments, 2))]
    mounts = ["carrier", *names]
    carrier = Carrier(
        **draw.body("carrier", 12.0, 0.25, fluid, inputs), added_mass=draw.definite6(6.0) if fluid else None
    )
    instruments = tuple(
        Instrument(
            **draw.body(flywheel, 2.0, 0.08, fluid, inputs),
            added_mass=draw.definite6(0.8) if fluid and rng.random() < 0.5 else None,
            position=draw.vec3(0.25),
            angles=draw.vec3(1.0),
        )
        for flywheel in names
    )
    wheels = tuple(
        Flywheel(
            **draw.body(f"w{k + 1}", 0.9, 0.05, fluid and rng.random() < 0.4, inputs),
            mount=mounts[int(rng.integers(len(mounts)))],
            position=draw.vec3(0.25),
            mounting=draw.mounting(),
            motor=draw.motor() if motors else None,
            encoder=Encoder(int(rng.choice([-4096, 1024])), 7.0, 5e-5) if motors else None,
        )
        for k in range(flywheels)
    )
    gravity = draw.vec3(6.0) if draw.flag(features.gravity) else (0.0, 0.0, 0.0)
    stream = draw.vec3(0.8) if draw.flag(features.stream) else None
    laws = [law.random_of(draw, features.laws.get(law.key), mounts) for law in carrier_laws()]
    points = tuple(
        Point(f"p{k + 1}", mounts[int(rng.integers(len(mounts)))], draw.vec3(0.2), draw.vec3(1.0))
        for k in range(draw.count(features.points, 2))
    )
    stand = Stand(
        name=name,
        angles=angles,
        gravity=gravity,
        stream=stream,
        carrier=carrier,
        instruments=instruments,
        flywheels=wheels,
        points=points,
        # by a generator of their own: what else is drawn stays as it is without tasks
        tasks=_tasks(rng.spawn(1)[0], features.tasks, instruments, points) if flywheels else (),
        laws=tuple(law for law in laws if law is not None),
    )
    return _with_flow(stand, Draw(rng.spawn(1)[0])) if features.flow else stand


def _with_flow(stand: Stand, draw: Draw) -> Stand:
    """The stand with laws of the fluid that came later, by a generator of its own: other draws stay as they are.

    What steers comes after the fins and propellers that it names.
    """
    return _with_drawn(_with_drawn(stand, draw, steers=False), draw, steers=True)


def _with_drawn(stand: Stand, draw: Draw, steers: bool) -> Stand:
    """The stand with the laws of bodies that are drawn after all bodies, or with those that steer."""

    def add_laws(body: AnyBody) -> AnyBody:
        laws = [law.random_on(draw, body) for law in body_laws() if law.steers is steers]
        return body.with_laws(*(law for law in laws if law is not None))

    return replace(
        stand,
        carrier=add_laws(stand.carrier),
        instruments=tuple(map(add_laws, stand.instruments)),
        flywheels=tuple(map(add_laws, stand.flywheels)),
    )


def _tasks(
    rng: np.random.Generator, count: int | None, instruments: tuple[Instrument, ...], points: tuple[Point, ...]
) -> tuple[Task, ...]:
    """Tasks of random independent rows, of O1 and of instruments and points."""
    places = places_of(instruments, points)
    frames = ["", *places]
    tasks = []
    for k in range(Draw(rng).count(count, 1)):
        task = Task(f"t{k + 1}", ())
        most = int(rng.integers(1, 7))
        while len(task.rows) < most:
            row = TaskRow(frames[int(rng.integers(len(frames)))], COMPONENTS[int(rng.integers(6))])
            longer = Task(task.name, (*task.rows, row))
            if dependent_rows(longer, places) is None:
                task = longer
        tasks.append(task)
    return tuple(tasks)


class _Bodies(Draw):
    """Bodies and what belongs to one."""

    def body(self, name: str, mass: float, size: float, fluid: bool, inputs: bool) -> dict[str, Any]:
        """Fields of any body: eight point masses, `mass` kg in all, off the origin by a third of their `size`, m."""
        rng = self.rng
        parts = rng.uniform(0.5, 1.5, 8) * mass / 8
        at = rng.normal(size=(8, 3)) * size + rng.normal(size=3) * size / 3
        total = float(parts.sum())
        center = parts @ at / total
        about_center = bool(rng.random() < 0.5)
        arms = at - center if about_center else at
        J = np.einsum("k,kij->ij", parts, np.einsum("ki,ki->k", arms, arms)[:, None, None] * np.eye(3))
        J = J - np.einsum("k,ki,kj->ij", parts, arms, arms)
        J = (J + J.T) / 2
        extent = Size(total, size, mass)
        return {
            "name": name,
            "mass": total,
            "center_of_mass": (float(center[0]), float(center[1]), float(center[2])),
            "inertia": cast(Mat3, rows(J)),
            "inertia_about": "center_of_mass" if about_center else "origin",
            "laws": tuple(law for kind in body_laws() if fluid and (law := kind.random_with(self, extent)) is not None),
            "wrench_input": inputs and bool(rng.random() < 0.6),
        }

    def mounting(self) -> MountingAngles | MountingAxes:
        if self.rng.random() < 0.6:
            psi, theta, zero = self.rng.uniform(-math.pi, math.pi, 3)
            return MountingAngles(float(psi), float(theta), float(zero))
        return MountingAxes(self.vec3(1.0), self.vec3(3.0))

    def motor(self) -> Motor:
        rng = self.rng
        return Motor(float(rng.uniform(0.05, 0.5)), float(rng.uniform(300, 900)), 0.03, 0.5, 24.0, 1e-5, 5e-4, 0.1)


MAX_PHASE = BOUNDS["MAX_PHASE"].value  # rad

EXTREMES = (
    "rest",
    "quarter_phases",
    "huge_phases",
    "fast",
    "half_turn",
    "near_singular",
    "tiny",
    "limits",
)
"""Kinds of extreme state: all zero; phases at multiples of pi/2; phases to the accepted limit; flywheels and
carrier very fast; attitudes with quaternion w = 0; attitude angles near, not at, their singularity; subnormal and
tiny numbers; every input near the accepted range at once."""


def random_state(
    stand: Stand, rng: np.random.Generator, extreme: bool = False, phase_limit: float = MAX_PHASE
) -> State:
    """A random state with inputs; run-time wrenches on the bodies that take one (`wrench_input`).

    `extreme`: of a kind drawn from EXTREMES. `phase_limit`: largest |phi| of huge phases (float builds take 1e3).
    """
    if extreme:
        return extreme_state(stand, rng, EXTREMES[int(rng.integers(len(EXTREMES)))], phase_limit)
    N = len(stand.flywheels)
    angles, quaternion = _attitude(stand, rng)
    state = State(
        position=cast(Vec3, _normal("position", rng, 3)),
        angles=angles,
        quaternion=quaternion,
        V=cast(Vec6, _normal("V", rng, 6)),
        phi=_tuple(rng.uniform(-math.pi, math.pi, N)),
        phi_dot=_normal("phi_dot", rng, N),
        phi_ddot=_normal("phi_ddot", rng, N),
        V_dot=cast(Vec6, _normal("V_dot", rng, 6)),
        tau=_normal("tau", rng, N),
        wrench=random_wrenches(rng, [body.name for body in stand.bodies if body.wrench_input]),
    )
    return along_freedoms(stand, state, rng)


def along_freedoms(stand: Stand, state: State, rng: np.random.Generator) -> State:
    """The state with u, u_dot of a held carrier by its V, V_dot, and with V = S u, within the ranges of V and V_dot.

    With a profile of the stream at a depth that it has, drawn by `rng`.
    """
    state = within_profile(stand, state, rng)
    if stand.hold is None:
        return state
    S = twists(stand.hold).T.tolist()
    changes: dict[str, Any] = {}
    for key, symbol in (("u", "V"), ("u_dot", "V_dot")):
        wanted = getattr(state, symbol)
        rates = [sum(map(mul, column, wanted)) / sum(map(mul, column, column)) for column in S]
        moved = twist_of(stand.hold, rates)
        excess = max(abs(x) / most for x, most in zip(moved, cycle(limits_of(symbol)), strict=False))
        if excess > 1.0:
            rates = [x / excess * (1.0 - 1e-9) for x in rates]
        changes |= {key: tuple(rates), symbol: twist_of(stand.hold, rates)}
    return replace(state, **changes)


def within_profile(stand: Stand, state: State, rng: np.random.Generator) -> State:
    """The state, moved up or down into a layer of the profile of the stream; as it is without one.

    A third of the states is in the lowest layer, since the shear there is felt nowhere else in the C; for the others
    all layers are as likely. A third is near a station, though not within 1e-3 of the layer, which float can tell
    apart, nor within 1e-2 of it at the ends of the profile, which a motion from there should not leave.
    """
    if stand.profile is None:
        return state
    layers = len(stand.profile.depth) - 1
    layer = layers - 1 if rng.random() < 1.0 / 3.0 else int(rng.integers(layers))
    share = rng.uniform(0.01, 0.99)
    if rng.random() < 1.0 / 3.0:
        share = 10.0 ** rng.uniform(-3.0, -2.0)
        share = share if rng.random() < 0.5 else 1.0 - share
        share = min(max(share, 0.01 if layer == 0 else 0.0), 0.99 if layer == layers - 1 else 1.0)
    return in_layer(stand, state, layer, float(share))


def in_layer(stand: Stand, state: State, layer: int, share: float) -> State:
    """The state, moved up or down to where `share` of a layer of the profile is above it."""
    if stand.profile is None:
        return state
    length = math.hypot(*stand.profile.down)
    down = [x / length for x in stand.profile.down]
    top, bottom = stand.profile.depth[layer : layer + 2]
    depth, wanted = sum(map(mul, down, state.position)), top + share * (bottom - top)
    x, y, z = (p + (wanted - depth) * d for p, d in zip(state.position, down, strict=True))
    if max(abs(x), abs(y), abs(z)) > BOUNDS["MAX_POSITION"].value:
        x, y, z = (wanted * d for d in down)
    return replace(state, position=(x, y, z))


def random_wrenches(rng: np.random.Generator, bodies: Iterable[str]) -> MappingProxyType[str, Vec6]:
    """Run-time wrenches of ordinary magnitude on bodies by name."""
    return MappingProxyType({name: cast(Vec6, _normal("wrench", rng, 6)) for name in bodies})


def _normal(symbol: str, rng: np.random.Generator, count: int) -> tuple[float, ...]:
    """Normal numbers of the spread that the contract gives to a quantity."""
    spread = QUANTITIES[symbol].deviation
    return _tuple(rng.normal(size=count) * (np.repeat(spread, 3) if len(spread) == 2 else spread))


def extreme_state(
    stand: Stand,
    rng: np.random.Generator,
    kind: str,
    phase_limit: float = MAX_PHASE,
    least_exponent: float = -310,
) -> State:
    """An extreme state of one of the kinds EXTREMES names; what the kind does not concern is ordinary.

    `least_exponent`: decimal, of tiny numbers; subnormal ones are among them.
    """
    if kind not in EXTREMES:
        raise ValueError(f"no extreme state of kind {kind!r}")
    state = rest_state(stand) if kind == "rest" else random_state(stand, rng)
    N, changes = len(stand.flywheels), dict[str, Any]()
    if kind == "quarter_phases":
        changes["phi"] = _tuple(rng.integers(-8, 9, N) * (math.pi / 2))
    elif kind == "huge_phases":
        changes["phi"] = _tuple(rng.uniform(0.5, 1.0, N) * rng.choice([-1.0, 1.0], N) * phase_limit)
    elif kind == "fast":
        speeds = rng.uniform(0.3, 1.0, N) * rng.choice([-1.0, 1.0], N) * BOUNDS["MAX_SPEED"].value
        turning = rng.normal(size=6) * [30, 30, 30, 300, 300, 300]
        changes = {"V": _tuple(turning), "phi_dot": _tuple(speeds)}
    elif kind == "half_turn":
        axis = rng.normal(size=3) if rng.random() < 0.5 else np.eye(3)[int(rng.integers(3))]
        x, y, z = axis / np.linalg.norm(axis)
        changes = {"angles": None, "quaternion": (0.0, float(x), float(y), float(z))}
    elif kind == "near_singular":
        off = 10.0 ** rng.uniform(-5, -2) * rng.choice([-1.0, 1.0])  # the limit is 1e-6
        singular = rng.choice([0.0, math.pi]) if stand.angles == "euler" else rng.choice([-0.5, 0.5]) * math.pi
        psi, phi = rng.uniform(-3, 3, 2)
        changes = {"angles": (float(psi), float(singular + off), float(phi)), "quaternion": None}
    elif kind == "tiny":
        scale = 10.0 ** rng.uniform(least_exponent, least_exponent / 31)
        changes = {name: _tuple(np.array(getattr(state, name)) * scale) for name in ("position", "V", "phi", "phi_dot")}
    elif kind == "limits":
        sign = rng.choice([-1.0, 1.0], 6)
        changes = {
            "position": _tuple(rng.choice([-1.0, 1.0], 3) * limits_of("position")),
            "V": _tuple(sign * limits_of("V")),
            "phi": _tuple(rng.choice([-1.0, 1.0], N) * phase_limit),
            "V_dot": _tuple(sign * limits_of("V_dot")),
        }
        for name in ("phi_dot", "phi_ddot", "tau"):
            changes[name] = _tuple(rng.choice([-1.0, 1.0], N) * limits_of(name))
    return along_freedoms(stand, replace(state, **changes), rng)


def _attitude(stand: Stand, rng: np.random.Generator) -> tuple[Vec3 | None, Quaternion | None]:
    """Angles well off their singularity, or a quaternion of any attitude."""
    if rng.random() < 0.5:
        psi, phi = rng.uniform(-math.pi, math.pi, 2)
        theta = rng.uniform(-1.2, 1.2)
        if stand.angles == "euler":
            theta = (theta + 0.5 * math.pi) * rng.choice([-1.0, 1.0])
        return (float(psi), float(theta), float(phi)), None
    q = rng.normal(size=4)
    q /= np.linalg.norm(q)
    return None, cast(Quaternion, _tuple(q))


def _tuple(values: NDArray[Any]) -> tuple[float, ...]:
    return tuple(float(x) for x in values)
