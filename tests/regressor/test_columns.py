"""Columns of the C against the literal reference, their sum against the equations, and planted faults."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import TypeVar

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from mahovik.contract.limits import LIMITS
from mahovik.core.emit.generate import generate_all
from mahovik.core.stand.model import Body, Stand, State
from mahovik.core.stand.random import EVERYTHING, random_stand
from mahovik.laws.damping.law import Damping
from mahovik.proof.reference.algebra import vector
from mahovik.proof.reference.evaluate import answer_regressor, pieces
from mahovik.proof.reference.motion import reaction, torque
from mahovik.proof.reference.pieces import bodies_of, mass_matrix, spatial_inertia
from mahovik.proof.second import Second
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.compare import Case, ordinary
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.functions.table import checks_of
from mahovik.proof.verify.scales import Scales
from strategies import stands as some_stands
from strategies import states
from toolchain.quick import quick

AnyBody = TypeVar("AnyBody", bound=Body)


def case_of(stand: Stand, folder: Path, real: str = "double", named: str = "regressor") -> Case:
    """The C of a stand with a chosen function, in a folder."""
    for file, content in generate_all(stand, real, only=(named,)).files.items():
        (folder / file).write_text(content, encoding="ascii", newline="\n")
    backend = CBackend(stand, real, folder)
    drawn = ordinary(draw(stand, 3, 20, real), 4)
    return Case(stand, backend, drawn, LIMITS[real], Second(stand), Scales(stand, real), 3)


def failures(rows: list[Check]) -> dict[str, float]:
    return {row.quantity: row.value for row in rows if row.failed}


@pytest.fixture(scope="module")
def everything() -> Stand:
    """A stand with every law, instruments, added mass, a stream and three flywheels."""
    return random_stand(np.random.default_rng(5), 3, EVERYTHING)


@pytest.mark.parametrize("real", quick(1, ["double", "float"]))
def test_columns_are_those_of_the_reference(everything: Stand, tmp_path: Path, real: str) -> None:
    rows = checks_of(case_of(everything, tmp_path, real), "regressor")
    assert {row.quantity for row in rows} == {
        "Y_carrier", "Y_flywheel", "Y_drive", "Y_added_mass", "Y_linear", "Y_quadratic"
    }  # fmt: skip
    assert failures(rows) == {}


def parameters(stand: Stand) -> Iterator[tuple[str, np.ndarray]]:
    """Parameters by the names of the groups: all that is fixed in E1 for the carrier, damping of the carrier."""

    def ten(Theta: np.ndarray) -> list[float]:
        J = Theta[3:, 3:]
        moments = [J[0, 0], J[1, 1], J[2, 2], J[0, 1], J[0, 2], J[1, 2]]
        return [Theta[0, 0], Theta[5, 1], Theta[3, 2], Theta[4, 0], *moments]

    fixed = bodies_of(replace(stand, flywheels=()))
    yield "Y_carrier", np.array(ten(mass_matrix(fixed)))
    yield "Y_flywheel", np.array([ten(spatial_inertia(s)) for s in stand.flywheels])
    yield "Y_added_mass", fixed.Lambda.sum(axis=0)[np.triu_indices(6)]
    damping = stand.carrier.law(Damping)
    for name in ("linear", "quadratic"):
        matrix = getattr(damping, name, None)
        yield f"Y_{name}", np.zeros((6, 6)) if matrix is None else np.array(matrix)


def with_columns_alone(stand: Stand) -> Stand:
    """The stand with those laws only that have columns: weight, and the damping matrices of the carrier."""

    def bare(body: AnyBody) -> AnyBody:
        return replace(body, laws=(), wrench_input=False)

    damping = stand.carrier.law(Damping)
    kept = () if damping is None else (replace(damping, terms=()),)
    return replace(
        stand,
        laws=(),
        carrier=replace(bare(stand.carrier), laws=kept),
        instruments=tuple(map(bare, stand.instruments)),
        flywheels=tuple(map(bare, stand.flywheels)),
    )


@settings(max_examples=25, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(st.data())
def test_columns_times_parameters_are_the_equations(data: st.DataObject) -> None:
    """Y pi is K V* + M V + I phi'' + J phi' - F and tau, of the literal reference, for any stand and state."""
    stand = with_columns_alone(data.draw(some_stands(max_flywheels=3)))
    state: State = replace(data.draw(states(stand)), wrench={})
    at = pieces(stand, state)
    Y, pi = answer_regressor(at, stand, state), dict(parameters(stand))
    motion = vector(state.V_dot), vector(state.phi_ddot)
    expected = np.concatenate([reaction(at, *motion), torque(at, *motion)])
    terms = [Y["Y_carrier"] * pi["Y_carrier"]]
    if stand.flywheels:
        terms += list(Y["Y_flywheel"] * pi["Y_flywheel"][:, None, :])
        drive = Y["Y_drive"] * pi["Y_flywheel"]
        assert np.all(np.abs(drive.sum(axis=1) - expected[6:]) <= 1e-9 * (np.abs(drive).sum(axis=1) + 1e-12))
    if "Y_added_mass" in Y:
        terms.append(Y["Y_added_mass"] * pi["Y_added_mass"])
    terms += [pi["Y_linear"] * Y["Y_linear"], pi["Y_quadratic"] * Y["Y_quadratic"]]
    wrench = sum(term.sum(axis=1) for term in terms)
    size = sum(np.abs(term).sum(axis=1) for term in terms)
    assert np.all(np.abs(wrench - expected[:6]) <= 1e-9 * (size.max() + 1e-12))
