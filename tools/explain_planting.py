"""Programs with a known fault, made without the dictionary's own code: for tools/explain_campaign.py.

Two ways: the literal reference on a stand with other numbers, and edits of what it is asked and answers.
explain_rewriting.py and explain_deriving.py have two more.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any, cast

import numpy as np

from mahovik.core.stand.model import Body, Flywheel, LawData, MountingAngles, Stand
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.laws.buoyancy.data import Buoyancy
from mahovik.laws.damping.data import Damping
from mahovik.laws.fading.data import FadingDamping
from mahovik.laws.friction.data import Frictions, frictions_of
from mahovik.laws.leg.data import Legs, legs_of
from mahovik.laws.stop.data import Stops, stops_of
from mahovik.laws.suspension.data import Suspension
from mahovik.proof import reference
from mahovik.proof.verify.backends import Backend
from mahovik.proof.verify.states import Request

Answers = Callable[[Request], Mapping[str, Any]]


@dataclass(frozen=True)
class Plant:
    """A program with a fault: which of the dictionary, how it was made, and its answers."""

    fault: str
    kind: str
    answers: Answers


def answers_of(backend: Backend) -> Answers:
    """Answer of a backend to a request; empty if it refuses."""

    def answer(request: Request) -> Mapping[str, Any]:
        try:
            return backend.evaluate(request.state, request.want)
        except (StateError, np.linalg.LinAlgError, ArithmeticError):
            return {}

    return answer


def literal(stand: Stand) -> Answers:
    """The literal reference of a stand; the pieces of a state are kept for all that is wanted of it."""
    last: dict[str, Any] = {}

    def answer(request: Request) -> Mapping[str, Any]:
        try:
            if last.get("state") is not request.state:
                last.update(state=request.state, at=reference.pieces(stand, request.state))
            return reference.evaluate(stand, request.state, request.want, last["at"])
        except (StateError, np.linalg.LinAlgError, ArithmeticError):
            return {}

    return answer


# ---- a stand with other numbers ----


def bodies(change: Callable[[Any], Any], fixed: bool = True, wheels: bool = True) -> Callable[[Stand], Stand]:
    """A change of every body of a stand, or of some."""

    def change_bodies(s: Stand) -> Stand:
        return replace(
            s,
            carrier=change(s.carrier) if fixed else s.carrier,
            instruments=tuple(map(change, s.instruments)) if fixed else s.instruments,
            flywheels=tuple(map(change, s.flywheels)) if wheels else s.flywheels,
        )

    return change_bodies


def products_reversed(body: Body) -> Body:
    J = body.inertia
    return replace(
        body,
        inertia=tuple(tuple(J[i][j] if i == j else -J[i][j] for j in range(3)) for i in range(3)),  # type: ignore[arg-type]
    )


def acting(kind: type[LawData], **changes: Any) -> Callable[[Body], Body]:
    return lambda body: body.with_laws(*(replace(law, **changes) for law in body.laws if isinstance(law, kind)))


def floating_at_mass_center(body: Body) -> Body:
    return acting(Buoyancy, center=body.center_of_mass)(body)


def from_zero(s: Flywheel) -> Flywheel:
    return replace(s, mounting=replace(s.mounting, zero=0.0)) if isinstance(s.mounting, MountingAngles) else s


def hung(**parts: Any) -> Callable[[Stand], Stand]:
    return lambda s: s.with_laws(replace(law, **parts)) if (law := s.law(Suspension)) else s


def legs(**parts: Any) -> Callable[[Stand], Stand]:
    return lambda s: s.with_laws(Legs(tuple(replace(leg, **parts) for leg in legs_of(s))))


def frictions(**parts: Any) -> Callable[[Stand], Stand]:
    return lambda s: (
        s.with_laws(Frictions(tuple(replace(each, **parts) for each in found))) if (found := frictions_of(s)) else s
    )


def stops(**parts: Any) -> Callable[[Stand], Stand]:
    return lambda s: (
        s.with_laws(Stops(tuple(replace(each, **parts) for each in found))) if (found := stops_of(s)) else s
    )


def negative(a: tuple[float, ...] | None) -> Any:
    return tuple(-x for x in a) if a is not None else None


ZERO3, ZERO66 = (0.0,) * 3, ((0.0,) * 6,) * 6

STANDS: dict[str, Callable[[Stand], Stand]] = {
    "products of inertia, sign": bodies(products_reversed),
    "products of inertia, sign, flywheels": bodies(products_reversed, fixed=False),
    "products of inertia, sign, carrier": bodies(products_reversed, wheels=False),
    "parallel axis theorem missing": bodies(lambda b: replace(b, inertia_about="origin")),
    "inertia about the wrong point": bodies(lambda b: replace(b, inertia_about="center_of_mass")),
    "carrier's centre of mass, sign": bodies(
        lambda b: replace(b, center_of_mass=negative(b.center_of_mass)), wheels=False
    ),
    "gravity, sign": lambda s: replace(s, gravity=negative(s.gravity)),
    "gravity ignored": lambda s: replace(s, gravity=ZERO3),
    "stream, sign": lambda s: replace(s, stream=negative(s.stream)),
    "stream ignored": lambda s: replace(s, stream=None),
    "buoyancy missing": bodies(lambda b: b.without_laws(Buoyancy)),
    "buoyancy at O1": bodies(acting(Buoyancy, center=ZERO3)),
    "buoyancy at the centre of mass": bodies(floating_at_mass_center),
    "linear damping missing": bodies(acting(Damping, linear=None)),
    "quadratic damping missing": bodies(acting(Damping, quadratic=None)),
    "damping terms missing": bodies(acting(Damping, terms=())),
    "added mass missing": bodies(lambda b: replace(b, added_mass=None), wheels=False),
    "added mass of instruments missing": lambda s: replace(
        s, instruments=tuple(replace(p, added_mass=None) for p in s.instruments)
    ),
    "mount ignored": bodies(lambda s: replace(s, mount="carrier"), fixed=False),
    "flywheel position ignored": bodies(lambda s: replace(s, position=ZERO3), fixed=False),
    "flywheel position, sign": bodies(lambda s: replace(s, position=negative(s.position)), fixed=False),
    "phi0 ignored": bodies(from_zero, fixed=False),
    "suspension damping missing": hung(damping=ZERO66),
    "suspension stiffness missing": hung(stiffness=ZERO66),
    "equilibrium attitude ignored": hung(angles=ZERO3),
    "equilibrium position ignored": hung(position=ZERO3),
    "fading damping missing": bodies(lambda b: b.without_laws(FadingDamping)),
    "fading damping does not fade": bodies(acting(FadingDamping, rate=0.0)),
    "legs missing": lambda s: s.without_laws(Legs),
    "leg damping missing": legs(damping=0.0),
    "friction missing": lambda s: s.without_laws(Frictions),
    "Coulomb friction missing": frictions(coulomb=0.0, breakaway=0.0, stribeck_speed=None),
    "stops missing": lambda s: s.without_laws(Stops),
    "stop damping missing": stops(damping=0.0),
    "unstretched length ignored": legs(length=0.0),
    "sequence, ship": lambda s: replace(s, angles="ship"),
    "sequence, aircraft": lambda s: replace(s, angles="aircraft"),
    "sequence, Euler": lambda s: replace(s, angles="euler"),
}


# ---- what is asked, and what is answered ----


def wheels(key: str, change: Callable[[float], float]) -> Callable[[State], State]:
    return lambda x: replace(x, **cast(Any, {key: tuple(change(each) for each in getattr(x, key))}))


def conjugate(x: State) -> State:
    return x if x.quaternion is None else replace(x, quaternion=(x.quaternion[0], *negative(x.quaternion[1:])))


def scalar_last(x: State) -> State:
    return x if x.quaternion is None else replace(x, quaternion=(x.quaternion[3], *x.quaternion[:3]))


ASKED: dict[str, Callable[[State], State]] = {
    "phase, sign": wheels("phi", lambda phi: -phi),
    "phase ignored": wheels("phi", lambda phi: 0.0),
    "phase in degrees": wheels("phi", math.radians),
    "zero of the phase, half a turn": wheels("phi", lambda phi: phi + math.pi),
    "phi', sign": wheels("phi_dot", lambda rate: -rate),
    "phi' in rpm": wheels("phi_dot", lambda rate: rate * 2 * math.pi / 60),
    "phi' ignored": wheels("phi_dot", lambda rate: 0.0),
    "phi'' not used": wheels("phi_ddot", lambda rate: 0.0),
    "phi'', sign": wheels("phi_ddot", lambda rate: -rate),
    "quaternion conjugated": conjugate,
    "quaternion, scalar last": scalar_last,
    "quaternion ignored": lambda x: replace(x, quaternion=None),
    "attitude angles in degrees": lambda x: (
        x if x.angles is None else replace(x, angles=tuple(map(math.radians, x.angles)))  # type: ignore[arg-type]
    ),
    "run-time wrench ignored": lambda x: replace(x, wrench={}),
    "run-time wrench, sign": lambda x: replace(x, wrench={k: negative(P) for k, P in x.wrench.items()}),
    "omega in degrees": lambda x: replace(x, V=(*x.V[:3], *map(math.radians, x.V[3:]))),  # type: ignore[arg-type]
    "V with angular part first": lambda x: replace(x, V=(*x.V[3:], *x.V[:3])),
    "position ignored": lambda x: replace(x, position=ZERO3),
}

ANSWERED: dict[str, Callable[[Request, dict[str, Any]], dict[str, Any]]] = {
    "V* as the acceleration of O1": lambda request, found: (
        found | {"V_dot": found["V_dot"] + np.append(np.cross(request.state.V[3:], request.state.V[:3]), ZERO3)}
    ),
    "V* with angular part first": lambda _, found: found | {"V_dot": [*found["V_dot"][3:], *found["V_dot"][:3]]},
    "energy not halved": lambda _, found: found | {"energy": 2 * found["energy"]},
    "mount wrench, sign": lambda _, found: found | {"mount_wrench": -np.array(found["mount_wrench"])},
    "K* missing": lambda _, found: found | {"M": found["M"] - found["K_dot"], "K_dot": np.zeros((6, 6))},
    "torque, sign": lambda _, found: found | {"tau": -found["tau"]},
    "D missing": lambda _, found: found | {"D": np.zeros((6, 6))},
}
"""Faults put into one answer only, which holds the first word of its key below."""

ANSWER_HAS = {
    "V* as the acceleration of O1": "V_dot",
    "V* with angular part first": "V_dot",
    "energy not halved": "energy",
    "mount wrench, sign": "mount_wrench",
    "K* missing": "K_dot",
    "torque, sign": "tau",
    "D missing": "D",
}


def plant_in_answers(stand: Stand) -> Iterator[Plant]:
    """The literal reference, told a changed state or with changed answers."""
    right = literal(stand)

    def with_state(change: Callable[[State], State]) -> Answers:
        changed: dict[int, State] = {}

        def answer(request: Request) -> Mapping[str, Any]:
            state = changed.setdefault(id(request.state), change(request.state))
            return right(replace(request, state=state))

        return answer

    def with_answers(name: str, change: Callable[[Request, dict[str, Any]], dict[str, Any]]) -> Answers:
        def answer(request: Request) -> Mapping[str, Any]:
            found = dict(right(request))
            return change(request, found) if ANSWER_HAS[name] in found else found

        return answer

    for name, change in ASKED.items():
        yield Plant(name, "states edited", with_state(change))
    for name, edit in ANSWERED.items():
        yield Plant(name, "answers edited", with_answers(name, edit))


def plant_in_numbers(stand: Stand) -> Iterator[Plant]:
    """The literal reference on a stand with other numbers."""
    for name, change in STANDS.items():
        yield Plant(name, "stand edited", literal(change(stand)))
