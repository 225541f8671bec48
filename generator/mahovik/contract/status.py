"""Statuses that public functions return: name, value and meaning, the same numbers for every stand."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Status:
    """A status.

    value    negative: refused, outputs untouched; 0: good; positive: a bit, outputs valid
    meaning  comment in the header; `{rank}` and `{unreachable}` are thresholds, `{lengths}` depends on the stand
    refusal  the reason in an error message about one state; empty for a status that does not refuse a state
    """

    name: str
    value: int
    meaning: str
    refusal: str = ""


STATUSES = (
    Status("OK", 0, "success"),
    Status("NEAR_SINGULAR", 1, "least singular value below `near_singular` times the largest"),
    Status("DAMPED", 2, "damping was applied"),
    Status("LIMITED", 4, "a limit was reached; `limited` says by which flywheels"),
    Status("UNREACHABLE", 8, "wanted motion not reached: residual above {unreachable} of the demand"),
    Status("RANK_DEFICIENT", 16, "fewer than min(m, N) singular values above {rank} of the largest; m of the demand"),
    Status("COARSE", 32, "step too long: more than MAX_TURN_4 or MAX_TURN_2 turned in it"),
    Status("EXCESSIVE", 64, "more than a motor's torque or speed, or than `most`"),
    Status("NOT_FINITE", -1, "an input is NaN or infinite", "an input is NaN or infinite"),
    Status(
        "RANGE",
        -2,
        "out of range, {lengths}",
        "an input is outside its range, a leg has no length, or a depth is outside of stream_profile",
    ),
    Status(
        "NOT_POSITIVE_DEFINITE",
        -3,
        "no mass, no spin inertia, or a pivot failed",
        "the mass matrix is not positive definite",
    ),
    Status(
        "SINGULAR_ATTITUDE",
        -4,
        "attitude angles within 1e-6 of their singularity",
        "the attitude angles are at their singularity",
    ),
    Status("BAD_ARGUMENT", -5, "a null pointer, a count, an index, a step or an option"),
)

STATUS_VALUES = {status.name: status.value for status in STATUSES}
"""Values by name."""

BITS = tuple(status.name for status in STATUSES if status.value > 0)
"""Names of the positive statuses, which combine."""


def status_bits(value: int) -> tuple[str, ...]:
    """Names of the bits that are set in a status; none for one that is not positive."""
    return tuple(name for name in BITS if value > 0 and value & STATUS_VALUES[name])


def status_words(value: int) -> str:
    """A status in words: `OK`, `RANGE`, `NEAR_SINGULAR|LIMITED`; the number where it is no status."""
    if value > 0:
        return "|".join(status_bits(value)) or str(value)
    return next((status.name for status in STATUSES if status.value == value), str(value))


def refusal_reason(name: str, otherwise: str) -> str:
    """The reason of a refusal in words, or `otherwise` where the status has none."""
    return next(status for status in STATUSES if status.name == name).refusal or otherwise
