"""The second derivation against the literal reference, relative to the natural scale of every quantity."""

import numpy as np

from mahovik import reference
from mahovik.errors import StateError
from mahovik.second import WANTS
from mahovik.verify.compare import difference
from mahovik.verify.scales import scales

NOT_THERE = ("I0", "J0")  # of `generalized`: matrices of (11), that the second derivation does not form

# what verify asks of every backend; the largest seen is 2e-14, of the solve in `coupled`
AGREEMENT = 1e-12


def differences(evaluate, stand, state, wants=WANTS):
    """(want, quantity) -> largest difference over natural scale, of all wants that the state allows.

    `evaluate(state, want)`. Refusing what the reference evaluates is an infinite difference, and the other way round.
    """
    found = {}
    for want in wants:
        expected, values = (
            attempt(lambda s, w: reference.evaluate(stand, s, w), state, want),
            attempt(evaluate, state, want),
        )
        if expected is None and values is None:
            continue
        if expected is None or values is None:
            found[want, "refused"] = np.inf
            continue
        with np.errstate(all="ignore"):
            natural = scales(stand, state, reference.pieces(stand, state), want)
        for name, value in expected.items():
            if name not in NOT_THERE:
                off, _ = difference(values.get(name), value, natural[name])
                found[want, name] = np.inf if np.isnan(off) else off
    return found


def attempt(evaluate, state, want):
    """What evaluate gives; None where it refuses."""
    try:
        with np.errstate(all="ignore"):
            return evaluate(state, [want])
    except StateError:
        return None
