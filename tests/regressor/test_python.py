"""`Model.regressor` and `mahovik.identifiable`: columns by name, and the combinations that mechanics knows."""

from __future__ import annotations

import numpy as np
import pytest

import mahovik


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
