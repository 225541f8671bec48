"""Audited models of Basilisk against Basilisk itself: the formulas were read rightly."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from audits import basilisk
from audits.audit import Array
from audits.catalogue import AUDITS
from mahovik.core.stand.state import State, rest_state

pytest.importorskip("Basilisk")


def states(name: str) -> list[State]:
    rng = np.random.default_rng(7)
    rest = rest_state(AUDITS[name].stand)
    found = []
    for _ in range(10):
        q = rng.normal(size=4)
        v = tuple(rng.normal(size=6).tolist())
        phi, speed, tau = (float(x) for x in rng.normal(size=3) * (3.0, 20.0, 0.1))
        turn = tuple((q / np.linalg.norm(q)).tolist())
        found.append(replace(rest, quaternion=turn, V=v, phi=(phi,), phi_dot=(speed,), tau=(tau,)))
    return found


@pytest.mark.parametrize(
    ("name", "model"),
    [
        ("basilisk_coupled", "JitterFullyCoupled"),
        ("basilisk_asymmetric", "JitterFullyCoupled"),
        ("basilisk_simple", "JitterSimple"),
        ("basilisk_simple_unbalanced", "JitterSimple"),
    ],
)
def test_the_reaction_wheel(name: str, model: Any) -> None:
    from mahovik.proof.verify.judges.basilisk_judge import BasiliskJudge

    audit = AUDITS[name]
    judge = BasiliskJudge(audit.stand, model, asymmetric=True)
    for state in states(name):
        expected, found = judge.evaluate(state), audit.answer(state, "coupled")
        for quantity in ("V_dot", "phi_ddot"):
            size = np.abs(expected[quantity]).max()
            np.testing.assert_allclose(found[quantity], expected[quantity], rtol=1e-10, atol=1e-11 * size)


def test_the_spinning_body() -> None:
    from Basilisk.simulation import spacecraft, spinningBodyOneDOFStateEffector, svIntegrators

    def column(numbers: Any) -> list[list[float]]:
        return [[float(x)] for x in np.asarray(numbers).ravel()]

    body = spinningBodyOneDOFStateEffector.SpinningBodyOneDOFStateEffector()
    body.mass = basilisk.ROTOR_MASS
    body.IPntSc_S = basilisk.ROTOR_INERTIA.tolist()
    body.dcm_S0B = basilisk.AXES.T.tolist()
    body.r_ScS_S = column(basilisk.ROTOR_CENTER)
    body.r_SB_B = column(basilisk.PLACE)
    body.sHat_S = column([1.0, 0.0, 0.0])
    body.k = body.c = 0.0
    craft = spacecraft.Spacecraft()
    craft.hub.mHub = basilisk.HUB
    craft.hub.r_BcB_B = column(basilisk.HUB_CENTER)
    craft.hub.IHubPntBc_B = basilisk.HUB_INERTIA.tolist()
    craft.addStateEffector(body)
    integrator = svIntegrators.svIntegratorRK4(craft)
    craft.setIntegrator(integrator)
    body.Reset(0)
    craft.Reset(0)

    def put(name: str, numbers: Any) -> None:
        craft.dynManager.getStateObject(name).setState(column(numbers))

    def rate(name: str) -> Array:
        return np.array(craft.dynManager.getStateObject(name).getStateDeriv(), dtype=np.float64).ravel()

    for state in states("basilisk_spinning_body"):
        v, w = np.split(np.array(state.V), 2)
        put("hubSigma", np.zeros(3))
        put("hubVelocity", v)
        put("hubOmega", w)
        put(body.nameOfThetaState, state.phi)
        put(body.nameOfThetaDotState, state.phi_dot)
        craft.equationsOfMotion(0.0, 1.0)
        found = AUDITS["basilisk_spinning_body"].answer(replace(state, tau=(0.0,)), "coupled")
        expected = np.concatenate([rate("hubVelocity") - np.cross(w, v), rate("hubOmega")])
        np.testing.assert_allclose(found["V_dot"], expected, rtol=1e-10, atol=1e-11 * np.abs(expected).max())
        np.testing.assert_allclose(found["phi_ddot"], rate(body.nameOfThetaDotState), rtol=1e-10)
