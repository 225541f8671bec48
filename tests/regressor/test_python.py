"""`Model.regressor` and `mahovik.identifiable`: columns by name, and the combinations that mechanics knows."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import mahovik
from mahovik.core.stand.model import Stand
from mahovik.core.stand.random import EVERYTHING, random_stand
from mahovik.laws.damping.data import Damping
from mahovik.use.regressor.combinations import base


@pytest.fixture(scope="module")
def everything() -> Stand:
    """Two flywheels without laws but weight, added mass and the carrier's damping matrices; instruments, a stream."""
    stand = random_stand(np.random.default_rng(8), 2, EVERYTHING)
    damping = stand.carrier.law(Damping)
    assert damping is not None
    kept = (replace(damping, terms=()),)
    return replace(
        stand,
        laws=(),
        carrier=replace(stand.carrier, laws=kept),
        instruments=tuple(replace(p, laws=()) for p in stand.instruments),
        flywheels=tuple(replace(s, laws=()) for s in stand.flywheels),
    )


@pytest.mark.slow
def test_y_times_the_values_of_the_file_is_what_the_motion_takes(everything: Stand) -> None:
    """With drive torques of `torque` and the motion of `forward`, Y pi is zero in the carrier's rows, and tau."""
    rng = np.random.default_rng(2)
    model = mahovik.build(everything)
    attitude = rng.normal(size=(5, 4))
    attitude /= np.linalg.norm(attitude, axis=1)[:, None]
    V, phi, phi_dot = rng.normal(size=(5, 6)), rng.normal(size=(5, 2)), 30 * rng.normal(size=(5, 2))
    x, phi_ddot = model.states(5, attitude=attitude, V=V, phi=phi, phi_dot=phi_dot), rng.normal(size=(5, 2))
    V_dot = model.forward(x, phi_ddot).V_dot
    found = model.regressor(x, V_dot, phi_ddot)
    terms = found.Y * np.array([p.value for p in found.parameters])
    size = np.abs(terms).sum(axis=2)
    tau = model.torque(x, V_dot, phi_ddot).tau
    expected = np.concatenate([np.zeros((5, 6)), tau], axis=1)
    assert np.all(np.abs(terms.sum(axis=2) - expected) <= 1e-11 * size)
    assert np.abs(tau).min() > 1e-6
    assert found["Y", found.rows[6]].shape == (5, len(found.parameters))
    assert [p.unit for p in found.parameters[:5]] == ["kg", "kg m", "kg m", "kg m", "kg m2"]
    names = [p.name for p in found.parameters]
    assert len(set(names)) == len(names) == 10 * 3 + 21 + 36
    assert names == [p.name for p in model.parameters]


def test_a_free_carrier_shows_seven_numbers_of_each_flywheel() -> None:
    found = mahovik.identifiable(mahovik.example("demo3"))
    seven = ("first_moment.y", "first_moment.z", *(f"inertia.J{place}" for place in ("11", "22", "12", "13", "23")))
    expected = [f"{wheel}.{what}" for wheel in ("w1", "w2", "w3") for what in seven]
    assert [c.name for c in found if not c.name.startswith("carrier")] == expected
    assert found.rank == 10 + 7 * 3
    assert found["w1.inertia.J22"].others == pytest.approx({"w1.inertia.J33": -1.0}, abs=1e-9)
    mass = found["carrier.mass"]
    assert mass.others == pytest.approx({f"w{k}.mass": 1.0 for k in (1, 2, 3)}, abs=1e-9)
    assert mass.value == pytest.approx(16.0)
    assert str(mass) == "carrier.mass + w1.mass + w2.mass + w3.mass"


def test_a_still_carrier_shows_unbalance_and_products_only() -> None:
    """The force table sees what turns: first moments across the axis, J12, J13, and J11 by the acceleration."""
    found = mahovik.identifiable(mahovik.example("demo3"), rows=list("XYZKMN"), still=True)
    seen = ("first_moment.y", "first_moment.z", "inertia.J11", "inertia.J12", "inertia.J13")
    assert set(found.alone) >= {f"{wheel}.{what}" for wheel in ("w1", "w2", "w3") for what in seen}
    assert "w1.mass" in found.unseen
    assert "w1.inertia.J22" in found.unseen


def test_a_single_state_is_six_equations() -> None:
    """It shows no more than six combinations."""
    x = np.zeros(19)
    x[3], x[16:] = 1.0, 50.0
    found = mahovik.identifiable(mahovik.example("demo3"), x, rows=list("XYZKMN"))
    assert 0 < found.rank <= 6


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"rows": ["tau w9"]}, 'rows: no "tau w9", did you mean "tau w1"'),
        ({"known": ["w1.mas"]}, "w1.mass"),
        ({"rows": "XYZ"}, "names in a list"),
        ({"x": np.zeros(19), "still": True}, "leave one out"),
    ],
)
def test_what_is_wrong_is_said(options: dict[str, object], words: str) -> None:
    with pytest.raises(mahovik.InputError, match=words):
        mahovik.identifiable(mahovik.example("demo3"), **options)  # type: ignore[arg-type]


def test_known_parameters_free_the_others() -> None:
    known = [f"w{k}.mass" for k in (1, 2, 3)]
    found = mahovik.identifiable(mahovik.example("demo3"), known=known)
    assert "carrier.mass" in found.alone
    assert found.total == 37


def test_columns_that_are_sums_are_found() -> None:
    """A planted dependence comes back with its coefficients, and a zero column as unseen."""
    rng = np.random.default_rng(4)
    free = rng.normal(size=(40, 5)) * np.array([1e-4, 1.0, 30.0, 1e3, 1.0])
    mix = np.array([[2.0, 0.0], [0.0, -0.5], [1.0, 0.0], [0.0, 0.0], [0.0, 3.0]])
    found = base(np.column_stack([free, free @ mix, np.zeros(40)]))
    assert (found.independent, found.dependent, found.unseen) == ((0, 1, 2, 3, 4), (5, 6), (7,))
    assert found.coefficients == pytest.approx(mix, abs=1e-5)
