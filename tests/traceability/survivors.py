"""Why mutants are not noticed: those that change no result, and those that other checks have."""

from __future__ import annotations

REASONS: dict[tuple[str, str], str] = {
    (
        "external",
        "loop one turn short: for (int i = 0; i < 18",
    ): "no change: the last number is a flywheel's moment about "
    "another axis than its own, which nothing reads: `tests/lower/test_undefined.py` puts NaN there",
    ("orthogonalise", "loop one turn short: for (int sweep"): "the last sweep is a reserve: these matrices are "
    "orthogonal to rounding before it",
    ("translation_block", "and / or exchanged: if (!(A[0] > 0.0"): "a second fence: added masses that are not positive "
    "semidefinite have been refused by `check_added_mass` before",
    ("allocate", "number times 1.5: share[s] = 1.0"): "no change: all shares get the same factor, which cancels",
    ("allocate_3", "number times 1.5: share[s] = 1.0"): "no change: all shares get the same factor, which cancels",
    ("orthogonalise_3", "loop one turn short: for (int sweep"): "the last sweep is a reserve: these matrices are "
    "orthogonal to rounding before it",
    (
        "factor3",
        "number times 1.5: if (!(S[0] >= 2.2",
    ): "no change: no inertia of a stand is so near the smallest number",
    ("bounded_least_squares_3", "loop one turn short: for (int i"): "no change: each number is set again before it is "
    "read; compilers do not see that",
    ("largest_share_3", "choice exchanged: largest"): "no change but for rounding: the size by which a row is divided",
    (
        "demand_turning",
        "term dropped: B[0] = table->G[0]",
    ): "a gap: no stand of these tests has added mass and a task of "
    "turning alone; the slow tests of random tasks draw such stands",
    (
        "balance",
        "sign of a term: V[0] = x->V[0] - u[0]",
    ): "a gap: of this function EXCESSIVE alone is made, and a stream "
    "hardly ever decides it; `torque` has the same lines of its own, which are judged",
    (
        "inverse",
        "and / or exchanged: if (options->motor_viscous[s]",
    ): "a gap: the campaign does not notice it, though a test gives each wrong number of a motor by itself",
    (
        "torque_for_pointing",
        "comparison turned round: if (!(shares[0]",
    ): "a gap: torque_for refuses a wrong damping that it does not use, and no test gives it one",
    (
        "rotation_vector",
        "number times 1.5: if (square > 1.0e-30)",
    ): "no change but for rounding: near this size the series and the formula give the same",
}
"""Reasons by function and the beginning of the mutant's description."""


def reason(function: str, what: str) -> str:
    """The reason of a survivor; empty where none is known."""
    return next((why for (name, begin), why in REASONS.items() if name == function and what.startswith(begin)), "")
