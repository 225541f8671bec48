"""`eval` by the kept C: the bits of the C that the harness compiles, and the same refusals."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, cast

import numpy as np
import pytest

from api.models import stand
from mahovik.contract.functions import WANTS
from mahovik.core.stand.random_state import random_state, random_wrenches
from mahovik.errors import StateError
from mahovik.out.api.compiled import Real
from mahovik.out.api.evaluator import KeptBackend
from mahovik.proof.verify.c_backend import CBackend
from toolchain.quick import quick

CASES = (("everything", "double"), ("general", "double"), ("everything", "float"), ("rigid", "double"))


def outcome(backend: Any, state: Any, want: str) -> Any:
    """Result of a want, every number as Python prints it; or the words of a refusal."""
    try:
        return repr(plain(backend.evaluate(state, [want])))
    except StateError as error:
        return f"refused: {error}"


def plain(value: Any) -> Any:
    if isinstance(value, dict):
        return {name: plain(each) for name, each in sorted(value.items())}
    if isinstance(value, list | tuple | np.ndarray):
        return [plain(each) for each in value]
    return value


@pytest.mark.parametrize(("name", "real"), quick(1, CASES))
def test_bits_are_those_of_the_harness(name: str, real: str) -> None:
    of, rng = stand(name), np.random.default_rng(19)
    kept, judged = KeptBackend(of, cast(Real, real)), CBackend(of, real)
    states = [random_state(of, rng) for _ in range(6)]
    states.append(replace(states[0], V=(float("nan"), 0.0, 0.0, 0.0, 0.0, 0.0)))
    states.append(replace(states[1], angles=None, quaternion=(0.5, 0.0, 0.0, 0.0)))
    states.append(replace(states[2], wrench=random_wrenches(rng, [body.name for body in of.bodies])))
    seen = set()
    for state in states:
        for want in WANTS:
            found = outcome(kept, state, want)
            assert found == outcome(judged, state, want), want
            seen.add(found.startswith("refused"))
    assert seen == {True, False}
