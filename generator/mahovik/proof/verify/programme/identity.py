"""Identity of a programme: identities of its stand, names of flywheels and motion, period."""

from __future__ import annotations

from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand
from mahovik.proof.verify.programme.finding import Finding, judged


def stand_finding(stand: Stand, programme: Programme) -> Finding:
    """How many of name, structure, physics and flywheels are another stand's."""
    own = identities(stand)
    pairs = {
        "name": (programme.stand, stand.name),
        "structure": (programme.structure, own.structure),
        "physics": (programme.physics, own.physics),
        "flywheels": (", ".join(programme.flywheels), ", ".join(s.name for s in stand.flywheels)),
    }
    other = [f"{key} is {theirs}, of the stand {ours}" for key, (theirs, ours) in pairs.items() if theirs != ours]
    words = "programme of another stand: " + "; ".join(other) if other else f"{own.structure} {own.physics}"
    return judged("stand", len(other), 0, words)


def same_flywheels(stand: Stand, programme: Programme) -> bool:
    """Whether the programme can be tried on the stand at all."""
    return programme.flywheels == tuple(s.name for s in stand.flywheels)


def motion_finding(motion: RequiredMotion, programme: Programme) -> Finding:
    """How many of the motion's name, kind and period (duration) are another motion's."""
    kind = {True: "periodic", False: "finite"}
    other = []
    if programme.motion != motion.name:
        other.append(f"name is {programme.motion}, of the motion {motion.name}")
    if programme.periodic != motion.periodic:
        other.append(f"it is {kind[programme.periodic]}, the motion {kind[motion.periodic]}")
    elif abs(programme.span - motion.span) > 1e-12 * motion.span:
        word = "period" if motion.periodic else "duration"
        other.append(f"{word} is {programme.span:.12g} s, of the motion {motion.span:.12g} s")
    words = "programme of another motion: " + "; ".join(other) if other else motion.name
    return judged("motion", len(other), 0, words)
