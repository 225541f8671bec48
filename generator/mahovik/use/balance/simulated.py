"""Vibration before and after correction by the full equations (8): the first order on the torus of all phases.

The stand has the unbalance that was found, -w in each plane, in place of that of its file; then the corrections too, as
point masses at the radii of their pieces. Where any correction can be made they are at the flywheel's radius of
gyration, rounded to four digits and a tenth of a degree: exact ones would leave a motion of rounding alone.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from mahovik.core.stand.inertia import inertia_about_origin
from mahovik.core.stand.model import Flywheel, Stand
from mahovik.proof.reference import evaluate, pieces
from mahovik.proof.reference.motion import points
from mahovik.use.balance.by_model import WheelBalance, amplitudes
from mahovik.use.balance.first_order import FirstOrder
from mahovik.use.balance.polar import Array, Complex, read_polar, write_polar
from mahovik.use.study.rest import rest
from mahovik.use.vibration.balance import balance as steady_motion

ORDER = 2
"""Largest sum of orders of the harmonic balance."""

Mass = tuple[float, Array]
"""kg, and its place (3) in the axes of the flywheel, m."""


def simulate_balance(stand: Stand, wheels: Sequence[WheelBalance], found: Sequence[FirstOrder]) -> list[WheelBalance]:
    """The wheels with `simulated`, each at the fastest of its recordings. Raises CheckError: no steady motion."""
    before, after = (_stand(stand, wheels, corrected) for corrected in (False, True))
    seen: dict[int, tuple[Complex, Complex]] = {}
    names = [each.name for each in stand.flywheels]
    result = []
    for wheel in wheels:
        first = max(wheel.firsts, key=lambda each: abs(each.speed))
        if first.recording not in seen:
            asked = found[first.recording]
            seen[first.recording] = (first_orders(before, asked), first_orders(after, asked))
        s = names.index(wheel.name)
        sizes = amplitudes(first.channels, *(X[:, s] for X in seen[first.recording]))
        result.append(replace(wheel, simulated=sizes))
    return result


def first_orders(stand: Stand, asked: FirstOrder) -> Complex:
    """First orders (K, N) in the channels and at the speeds of a recording. Raises CheckError."""
    turning = np.flatnonzero(asked.speeds)
    if stand.hold is not None:
        return _of_table(stand, asked)
    motion = steady_motion(stand, asked.speeds.tolist(), order=ORDER)
    columns = 1 + 4 * len(turning)
    theta = np.random.default_rng(0).uniform(0.0, 2.0 * np.pi, (3 * columns, len(turning)))
    _, rates = motion.states(theta)
    rows = []
    for each, rate in zip(theta, rates, strict=True):
        seen = points(pieces(stand, motion.state(each)), stand, rate[6:])
        rows.append([_value(seen[c.name], c.quantity, "xyz".index(c.component)) for c in asked.channels])
    return _fit(stand, asked, theta, np.array(rows))


def _of_table(stand: Stand, asked: FirstOrder) -> Complex:
    """First orders in the channels of a clamped carrier, whose reaction the literal (8) gives at every phase."""
    turning, still = np.flatnonzero(asked.speeds), rest(stand).state
    theta = np.random.default_rng(0).uniform(0.0, 2.0 * np.pi, (3 * (1 + 4 * len(turning)), len(turning)))
    rows = []
    for each in theta:
        phi = np.zeros(len(stand.flywheels))
        phi[turning] = each
        state = replace(still, phi=tuple(phi.tolist()), phi_dot=tuple(asked.speeds.tolist()))
        found = evaluate(stand, state, ["reaction"])["reaction"]
        rows.append([found["xyzkmn".index(c.component)] if c.quantity == "reaction" else 0.0 for c in asked.channels])
    return _fit(stand, asked, theta, np.array(rows))


def _fit(stand: Stand, asked: FirstOrder, theta: Array, rows: Array) -> Complex:
    """First orders (K, N) of readings (M, K) at phases (M) of the flywheels that turn."""
    turning = np.flatnonzero(asked.speeds)
    harmonics = [f(order * theta[:, k]) for k in range(len(turning)) for order in (1, 2) for f in (np.cos, np.sin)]
    coefficients = np.linalg.lstsq(np.column_stack([np.ones(len(theta)), *harmonics]), rows, rcond=None)[0]
    X = np.zeros((len(asked.channels), len(stand.flywheels)), dtype=np.complex128)
    X[:, turning] = (coefficients[1::4] - 1j * coefficients[2::4]).T
    return X


def _value(point: dict[str, Array], quantity: str, component: int) -> float:
    return float(point["specific_force"][component] if quantity == "acceleration" else point["twist"][3 + component])


def _stand(stand: Stand, wheels: Sequence[WheelBalance], corrected: bool) -> Stand:
    by_name = {each.name: each for each in wheels}
    return replace(stand, flywheels=tuple(_flywheel(f, by_name.get(f.name), corrected) for f in stand.flywheels))


def _flywheel(flywheel: Flywheel, wheel: WheelBalance | None, corrected: bool) -> Flywheel:
    """The flywheel with the unbalance found, or with none where it does not turn; corrected: and its corrections."""
    mass, J = flywheel.mass, inertia_about_origin(flywheel)
    moment = mass * np.array([flywheel.center_of_mass[0], 0.0, 0.0])
    J[0, 1:] = J[1:, 0] = 0.0
    if wheel is not None:
        for x, w in zip(wheel.positions, wheel.w.tolist(), strict=True):
            u = -np.array([w.real, w.imag])
            moment[1:] += u
            J[0, 1:] -= x * u
            J[1:, 0] -= x * u
        for m, place in masses(wheel, math.sqrt(J[0, 0] / mass)) if corrected else ():
            mass, moment = mass + m, moment + m * place
            J = J + m * (place @ place * np.eye(3) - np.outer(place, place))
    a, b, c = (moment / mass).tolist()
    (p, q, r), (s, t, u_), (v, k, n) = J.tolist()
    inertia = ((p, q, r), (s, t, u_), (v, k, n))
    return replace(flywheel, mass=mass, center_of_mass=(a, b, c), inertia=inertia, inertia_about="origin")


def masses(wheel: WheelBalance, radius: float) -> list[Mass]:
    """Corrections as point masses, negative for holes; those of free planes at a radius (m)."""
    found = []
    made = () if wheel.made is None else wheel.made.placed
    for each in made:
        turn = math.radians(each.piece.degrees)
        place = each.piece.radius * np.array([0.0, math.cos(turn), math.sin(turn)])
        place[0] = wheel.positions[each.plane]
        found.append((math.copysign(each.count * each.piece.amount, each.piece.value), place))
    planes = {each.plane for each in made}
    for k, (x, w) in enumerate(zip(wheel.positions, wheel.applied.tolist(), strict=True)):
        if w and (wheel.made is None or k not in planes):
            rounded = read_polar(write_polar(w)) or w
            turn = rounded / abs(rounded)
            found.append((abs(rounded) / radius, np.array([x, radius * turn.real, radius * turn.imag])))
    return found
