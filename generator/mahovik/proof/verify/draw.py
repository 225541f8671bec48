"""The states of a verification, the same for the same seed; poses and twists that a hold allows; keys of a state that
answers depend on.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator
from dataclasses import replace
from types import MappingProxyType
from typing import Any, cast

import numpy as np

from mahovik.contract.laws import parts
from mahovik.contract.limits import PERTURBATION
from mahovik.contract.quantities import limits_of
from mahovik.core.lower.limits import THRESHOLDS
from mahovik.core.stand.hold import TWIST_NAMES, has_coordinates, twist_of, twists, words
from mahovik.core.stand.model import Hold, Quaternion, Sequence, Stand, State, Vec3
from mahovik.core.stand.random import EXTREMES, extreme_state, random_state
from mahovik.errors import UsageError, whole_number
from mahovik.proof import reference
from mahovik.proof.reference.algebra import AXES, Array, attitude, carrier_rotation
from mahovik.proof.reference.algebra import quaternion_of as quaternion
from mahovik.proof.reference.coordinates import coordinates_at, pose_of
from mahovik.proof.reference.inverse import least_pivot, normal_matrix, scaled_demand
from mahovik.proof.reference.pieces import CarrierReference
from mahovik.proof.verify.scales import Scales
from mahovik.proof.verify.states import HELD_KEYS, INPUTS, actuators_of

# -- of a hold ---------------------------------------------------------------------------------------------------------

ALLOWED = 1e-6
"""m, rad; m/s, rad/s: what is given may be off what the hold allows by as much as figures of six digits are."""


def blocked_twist(hold: Hold, V: Array) -> str:
    """Why twists V (6, or n x 6) are not S u, in words; "" where they are, to six digits."""
    V, S = np.atleast_2d(V), twists(hold)
    off = V - freedom_rates(hold, V) @ S.T
    bad = np.flatnonzero(np.abs(off).max(axis=1) > ALLOWED * np.maximum(1.0, np.abs(V).max(axis=1)))
    if not len(bad):
        return ""
    return f"V: moves along {worst(off[bad[0]])}, which [hold] blocks; expected S u of {freedoms(hold)}"


def freedom_rates(hold: Hold, V: Array) -> Array:
    """u (n, m) of twists V = S u (n, 6); of other twists the nearest."""
    return np.asarray(V @ np.linalg.pinv(twists(hold)).T)


def worst(off: Array) -> str:
    """The name of the largest component of a twist (6)."""
    return TWIST_NAMES[int(np.argmax(np.abs(off)))]


def freedoms(hold: Hold) -> str:
    """The freedoms in words, within a sentence."""
    result = words(hold).partition(";")[0].partition(", ")[2]
    return f"the freedoms ({result})" if hold.freedoms else "no freedom, as it is clamped,"


def home_attitude(stand: Stand) -> Quaternion:
    """Attitude of the home pose of a held carrier, w first."""
    hold = stand.hold
    assert hold is not None
    return quaternion_of(attitude(stand.angles, *hold.angles))


def quaternion_of(C: Array) -> Quaternion:
    """Unit quaternion, w first, of a rotation C (3x3); its largest component is positive."""
    w, x, y, z = quaternion(C).tolist()
    sign = math.copysign(1.0, max((w, x, y, z), key=abs))
    return sign * w, sign * x, sign * y, sign * z


def with_quaternion(stand: Stand, state: State) -> State:
    """The state with its attitude as a unit quaternion, w first."""
    if state.quaternion is not None:
        return state
    return replace(state, angles=None, quaternion=quaternion_of(carrier_rotation(stand, state)))


def with_angles(stand: Stand, state: State) -> State:
    """The state with its attitude as psi, theta, phi of the stand's sequence."""
    from scipy.spatial.transform import Rotation

    if state.angles is not None:
        return state
    angles = Rotation.from_matrix(carrier_rotation(stand, state)).as_euler(turns_of(stand.angles)).tolist()
    return replace(state, quaternion=None, angles=cast(Vec3, tuple(angles)))


def turns_of(sequence: Sequence) -> str:
    """Axes about which psi, theta, phi turn, each in the frame that the one before has turned, as SciPy names them."""
    return "".join("XYZ"[axis] for axis in AXES[sequence])


def with_pose(stand: Stand, state: State, keys: Collection[str]) -> State:
    """The state of a held carrier, whose keys are `given`: a missing attitude is that of the home pose, a missing
    position the one where the hold has the carrier.
    """
    hold = stand.hold
    assert hold is not None
    at_home = replace(state, angles=None, quaternion=home_attitude(stand))
    if not {"angles", "quaternion"} & set(keys):
        state = at_home
    if "position" in keys:
        return state
    turned = carrier_rotation(stand, at_home) - carrier_rotation(stand, state)
    place = np.array(hold.position) + turned @ np.array(hold.pivot)
    return replace(state, position=cast(Vec3, tuple(place.tolist())))


def at_coordinates(stand: Stand, state: State, q: Array, orientation: Array | None) -> State:
    """The state with the pose of coordinates q (m, rad) from the home pose, and the quaternion of three turns.

    Raises StateError: the freedoms have no coordinates.
    """
    hold = stand.hold
    assert hold is not None
    still = np.zeros(len(hold.freedoms))
    held_pose = pose_of(hold, stand.angles, q, orientation, still, still)
    place = cast(Vec3, tuple(held_pose.position.tolist()))
    return replace(state, position=place, angles=None, quaternion=quaternion_of(held_pose.C))


def onto_hold(stand: Stand, state: State) -> State:
    """The state with the pose that the hold allows and whose coordinates are those of the state; of a clamped carrier
    the home pose. As it is where the carrier is free, or its freedoms have no coordinates.
    """
    hold = stand.hold
    if hold is None:
        return state
    if not hold.freedoms:
        return with_pose(stand, state, ())
    if not has_coordinates(hold):
        return state
    coordinates = coordinates_at(stand, state)
    return at_coordinates(stand, state, coordinates.q, coordinates.orientation)


# -- keys that answers depend on ---------------------------------------------------------------------------------------

KEYS = {"V": ("V", "u"), "V_dot": ("V_dot", "u_dot")}
"""Keys of a state that differ together."""

MOVES = {"position": "slide", "quaternion": "turn"}
"""What moves a held carrier where a part of its pose differs."""

SAME = 1e-12
"""Relative difference that is rounding."""


def depends_on(stand: Stand, wants: Collection[str], key: str) -> bool:
    """Whether an answer differs between two values of a key of a state, beyond rounding; of V also those of u.

    Of a held carrier the attitude differs only where something turns, the position where something slides: otherwise
    they follow from the rest of the pose.
    """
    for want in wants:
        first, second = (reference.evaluate(stand, state, (want,)) for state in _states(stand, key))
        for name, value in first.items():
            a, b = np.asarray(value), np.asarray(second[name])
            if not np.allclose(a, b, rtol=SAME, atol=SAME * float(np.abs(a).max(initial=0.0))):
                return True
    return False


def _states(stand: Stand, key: str) -> tuple[State, State]:
    """Two states that differ in this key."""
    from mahovik.core.stand.random import random_state

    first, second = (with_quaternion(stand, random_state(stand, np.random.default_rng(seed))) for seed in (1, 2))
    freedoms = () if stand.hold is None else stand.hold.freedoms
    kinds = {freedom.kind for freedom in freedoms}
    if stand.hold is not None and key in MOVES and not kinds & {MOVES[key], "twist"}:
        return first, first  # it follows from the rest of the pose
    return first, replace(first, **{name: getattr(second, name) for name in KEYS.get(key, (key,))})


# -- drawn states ------------------------------------------------------------------------------------------------------

TURNED = 8.0
"""Least distance from a half turn, rad, over the change by which scales are measured: no neighbour is beyond it, where
a law turns back in the other sense."""

LEAST_EXPONENT = {"double": -310, "float": -43}
"""Least decimal exponent of a number in a state; below 1e-308, in float 1e-38, numbers are subnormal."""

REDRAWN = 3
"""How often a state is drawn anew where rounding decides a word of its answer."""


def draw(stand: Stand, seed: int, count: int, real: str = "double") -> list[tuple[str, State]]:
    """`count` states with their names, `KIND NUMBER`: two ordinary, one extreme, and so on.

    For float every number is one of float, but for the quaternion: it has unit length in double.
    """
    check_drawing(seed, count, real)
    rng = np.random.default_rng(seed)
    kinds = zip(range(count), _state_kinds(), strict=False)
    return [(f"{kind} {number}", _draw_one(stand, rng, kind, real)) for number, kind in kinds]


def _draw_one(stand: Stand, rng: np.random.Generator, kind: str, real: str) -> State:
    """A state that is near no branch, as the element type has it."""
    state = _draw_state(stand, rng, kind, real)
    while _near_a_branch(stand, state, TURNED * PERTURBATION[real]):
        state = _draw_state(stand, rng, "random", real)
    return round_to_float(stand, state) if real == "float" else state


def check_drawing(seed: int, count: int, real: str) -> None:
    """Raises UsageError: no states can be drawn so."""
    whole_number("states", count)
    whole_number("seed", seed, 0)
    if real not in PERTURBATION:
        raise UsageError(f"real: unknown {real!r}, expected one of {', '.join(PERTURBATION)}")


def draw_decided(stand: Stand, scales: Scales, seed: int, count: int, real: str = "double") -> list[tuple[str, State]]:
    """The states of `draw`; one where rounding decides a word of `inverse`, or whether `inverse_fast` refuses, is drawn
    anew, up to REDRAWN times.
    """
    rng, result = np.random.default_rng((seed, 1)), []
    for name, state in draw(stand, seed, count, real):
        chosen = state
        for _ in range(REDRAWN):
            if _is_decided(scales, chosen, real):
                break
            chosen = _draw_one(stand, rng, "random", real)
        result.append((name, chosen))
    return result


def _is_decided(scales: Scales, state: State, real: str) -> bool:
    """Whether rounding decides no word of `inverse` at a state, nor whether `inverse_fast` refuses, without weights."""
    measured = scales.want(state, "inverse")
    if measured is None or measured.undecided or not state.phi:
        return measured is None or not measured.undecided
    with np.errstate(all="ignore"):
        grams = (
            normal_matrix(scaled_demand(at, np.array(state.V_dot)), np.ones(len(state.phi)), 0.0)
            for _, _, at in scales.neighbours(state)
        )
        return len({least_pivot(gram) > THRESHOLDS[real].gram_pivot for gram in grams}) == 1


def _state_kinds() -> Iterator[str]:
    yield "rest"
    extremes = [kind for kind in EXTREMES if kind != "rest"]
    number = 0
    while True:
        yield from ("random", "random")
        yield extremes[number % len(extremes)]
        number += 1


def _draw_state(stand: Stand, rng: np.random.Generator, kind: str, real: str) -> State:
    if kind in EXTREMES:
        return extreme_state(stand, rng, kind, limits_of("phi", real)[0], LEAST_EXPONENT[real])
    return random_state(stand, rng)


def with_drawn_actuators(stand: Stand, state: State, rng: np.random.Generator) -> State:
    """The state with deflections and speeds of their usual size; itself where the stand has neither."""
    known = actuators_of(stand)
    if not known:
        return state
    sizes = rng.uniform(0.3, 1.0, len(known)) * rng.choice([-1.0, 1.0], len(known))
    settings = {name: float(size * actuator.usual) for (name, actuator), size in zip(known.items(), sizes, strict=True)}
    return replace(state, actuators=MappingProxyType(settings))


def round_to_float(stand: Stand, state: State) -> State:
    """The state with every number but the quaternion rounded to the nearest float, V, V_dot of a held carrier by u."""
    rounded: dict[str, Any] = {}
    for key in (*INPUTS, *HELD_KEYS):
        value = getattr(state, key)
        rounded[key] = None if value is None else _floats(value)
    if stand.hold is not None:
        rounded |= {twist: twist_of(stand.hold, rounded[key]) for key, twist in HELD_KEYS.items()}
    return replace(state, **rounded, wrench=MappingProxyType({name: _floats(w) for name, w in state.wrench.items()}))


def _floats(numbers: Any) -> Any:
    return tuple(np.array(numbers, dtype=np.float32).astype(np.float64).tolist())


def _near_a_branch(stand: Stand, state: State, cut: float) -> bool:
    """Whether some law is nearer than `cut` (rad) to a state with two right answers."""
    margins = (law.margin for law in parts("reference", CarrierReference))
    return any(margin(stand, state) < cut for margin in margins if margin is not None)
