"""Tables of samples of which some can be no stand: the others get theirs, and each refusal is that of a stand file."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from api.models import model
from mahovik import InputError, StandError, UsageError
from mahovik.out.api.possible import possible_tables
from mahovik.out.api.stands import Stand


@pytest.mark.slow
@settings(max_examples=5, deadline=None)
@given(seed=st.integers(0, 10**6), spread=st.sampled_from([1e-3, 0.3, 1.0, 5.0]))
def test_exactly_the_samples_that_no_stand_file_may_have_are_left_out(seed: int, spread: float) -> None:
    m, n, rng = model("demo3"), 6, np.random.default_rng(seed)
    of, wheel = Stand.of(m.stand), m.flywheels[0]
    changes = {
        "carrier.mass": of.carrier.mass * (1 + spread * rng.normal(size=n)),
        f"{wheel}.mass": of.flywheels[0].mass * (1 + spread * rng.normal(size=n)),
        f"{wheel}.unbalance.static": 1e-6 * (1 + spread * rng.normal(size=n)),
    }
    found = possible_tables(m, changes)
    assert sorted([*found.numbers, *found.reasons]) == list(range(n))
    for j in range(n):
        try:
            own = of.replace({path: column[j] for path, column in changes.items()})
        except StandError as error:
            assert found.reasons[j] in str(error), j
        else:
            (place,) = np.flatnonzero(found.numbers == j)
            assert found.tables.stand(int(place)) == own
    alone = m.tables({path: column[found.numbers] for path, column in changes.items()})
    assert found.tables.block("table").tobytes() == alone.block("table").tobytes()


def test_samples_that_are_all_impossible_leave_empty_tables() -> None:
    found = possible_tables(model("demo3"), {"carrier.mass": np.array([-1.0, -2.0])})
    assert len(found.tables) == 0
    assert found.reasons == {0: "carrier, mass: -1 kg is negative", 1: "carrier, mass: -2 kg is negative"}


def test_what_is_wrong_with_all_samples_is_no_reason() -> None:
    m = model("demo3")
    with pytest.raises(UsageError, match="did you mean"):
        possible_tables(m, {"carier.mass": np.ones(2)})
    with pytest.raises(InputError, match="different numbers of samples"):
        possible_tables(m, {"carrier.mass": np.ones(2), "w1.mass": np.ones(3)})


def test_another_structure_is_a_reason() -> None:
    m = model("general")
    assert any(m.stand.gravity)
    found = possible_tables(m, {"gravity": np.array([m.stand.gravity, (0.0, 0.0, 0.0)])})
    assert found.numbers.tolist() == [0]
    assert "another structure" in found.reasons[1]
