"""`inverse_fast` of held carriers: closed formula of a hinge, answers of `inverse`, refusals, fewer operations."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from math import cos, sin
from typing import Any, cast

import numpy as np
import pytest

from export.held_servos import ARM, MASS, SPIN, WHOLE, pendulum
from mahovik.contract.status import STATUS_VALUES
from mahovik.core.emit.generate import Generated, generate_all
from mahovik.core.program.cost import cost
from mahovik.core.stand.model import MountingAxes, Stand
from mahovik.core.stand.state import rest_state
from mahovik.proof.second import Second
from mahovik.proof.verify.bounds import DOUBLE
from mahovik.proof.verify.c_backend import InterpreterBackend
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.functions.allocation import fast_rows
from mahovik.proof.verify.functions.case import Case
from toolchain.quick import quick
from verify.test_held_c import DRY, stand_of, state_of


def answer(own: InterpreterBackend, stand: Stand, state: Any, function: str, **options: Any) -> tuple[int, np.ndarray]:
    """Status without EXCESSIVE, and phi''."""
    given = own.arguments(state)
    status, found = own.call(function, {**given, "options": {**given["options"], **options}})
    phi_ddot = found.get("out", found).get("phi_ddot", np.full(len(stand.flywheels), np.nan))
    return status & ~STATUS_VALUES["EXCESSIVE"] if status > 0 else status, np.array(phi_ddot)


def test_a_wheel_on_a_hinge_by_the_closed_formula() -> None:
    """WHOLE theta'' + SPIN phi'' = -MASS g ARM sin theta."""
    stand, theta, wanted = pendulum(), 0.7, 3.0
    state = replace(
        rest_state(stand), quaternion=(cos(theta / 2), 0.0, sin(theta / 2), 0.0), u=(0.4,), V=(0, 0, 0, 0, 0.4, 0),
        u_dot=(wanted,), V_dot=(0, 0, 0, 0, wanted, 0), phi_dot=(90.0,),
    )  # fmt: skip
    status, found = answer(InterpreterBackend(generate_all(stand)), stand, state, "inverse_fast")
    assert status == 0
    expected = -(WHOLE * wanted + MASS * 9.81 * ARM * sin(theta)) / SPIN
    assert found == pytest.approx([expected], rel=1e-14)


@pytest.mark.parametrize(
    ("name", "flywheels"), quick(2, [("ball joint", 5), ("ball joint", 2), ("hinge", 3), ("all but one", 7)])
)
def test_it_is_the_answer_of_inverse_with_weights_and_of_given_sines_bit_for_bit(name: str, flywheels: int) -> None:
    """With fewer flywheels than freedoms the least residual, in the norm of (S^T K S)^-1, else the least phi''."""
    stand = replace(stand_of(name, 12, DRY, flywheels), phase_input="sincos")
    own = InterpreterBackend(generate_all(stand))
    weight = [float(w) for w in np.linspace(1.0, 4.0, flywheels)]
    for seed in range(2):
        state = replace(state_of(stand, seed), wrench={})
        _, expected = answer(own, stand, state, "inverse", weight=weight)
        status, found = answer(own, stand, state, "inverse_fast", weight=weight)
        assert status == 0
        assert np.abs(found - expected).max() <= 1e-9 * np.abs(expected).max()
        same_status, same = answer(own, stand, state, "inverse_fast_at", weight=weight)
        assert (same_status, same.tolist()) == (status, found.tolist())


def test_a_freedom_that_no_flywheel_drives_is_refused_without_damping() -> None:
    """A balanced wheel across the hinge has no moment along it."""
    hinge = pendulum()
    wheel = replace(hinge.flywheels[0], mounting=MountingAxes((1.0, 0.0, 0.0), (0.0, 0.0, 1.0)))
    stand = replace(hinge, flywheels=(wheel,))
    own, state = InterpreterBackend(generate_all(stand)), replace(rest_state(stand), V_dot=(0, 0, 0, 0, 1.0, 0))
    assert answer(own, stand, state, "inverse_fast")[0] == STATUS_VALUES["NOT_POSITIVE_DEFINITE"]


class Doctored(InterpreterBackend):
    """The program, but one wheel is given a little more."""

    def __init__(self, made: Generated, share: float) -> None:
        super().__init__(made)
        self.generated, self.share = made, share

    def call(self, function: str, inputs: Mapping[str, Any]) -> tuple[int, dict[str, Any]]:
        """The answer, the first number of it changed."""
        status, found = super().call(function, inputs)
        if "phi_ddot" in found:
            found["phi_ddot"] = [found["phi_ddot"][0] * (1 + self.share), *found["phi_ddot"][1:]]
        return status, found


@pytest.mark.parametrize(("share", "verdict"), [(0.0, "ok"), (1e-8, "FAILED")])
def test_its_judge_passes_it_and_sees_a_small_error(share: float, verdict: str) -> None:
    stand = stand_of("ball joint", 4, DRY, 4)
    own = Doctored(generate_all(stand), share)
    some = [each for each in draw(stand, 1, 8, wrenches=False) if each[0].startswith("random")]
    case = Case(stand, cast(Any, own), some, DOUBLE, Second(stand), 1)
    rows = {row.quantity: row.verdict for row in fast_rows(case, "inverse_fast")}
    assert rows.pop("status") == "ok"
    named = ("phi_ddot, with weights", "phi_ddot, with damping", "residual of its equations")
    assert rows == dict.fromkeys(named, verdict)


def test_it_takes_fewer_operations_than_inverse_and_than_that_of_the_free_stand() -> None:
    held = stand_of("hinge", 3, DRY, 3)
    counts = {}
    for name, stand in (("held", held), ("free", replace(held, hold=None))):
        every = generate_all(stand).program.functions
        taken = {f.name: cost(f, every).total for f in every if f.name in ("inverse", "inverse_fast")}
        counts[name] = taken
    assert counts["held"]["inverse_fast"] < counts["held"]["inverse"]
    assert counts["held"]["inverse_fast"] < 0.8 * counts["free"]["inverse_fast"]
