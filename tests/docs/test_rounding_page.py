"""docs/results/rounding.md: the tolerances of `verify` stand well above its figures."""

from __future__ import annotations

from typing import Any

import pytest
import rounding_campaign as written

from mahovik.contract.functions import wants_of, wants_of_carrier
from mahovik.proof.verify.bounds import BOUNDS
from mahovik.proof.verify.rounding.measure import MARGIN, ULPS
from mahovik.stands import names

REALS = ("double", "float")
FOUND = written.CAMPAIGN.figures()
Row = dict[str, Any]


def tables(real: str) -> list[list[Row]]:
    """Rows of the example stands, stand by stand, of random ones."""
    return [FOUND[real][key] for key in ("examples", "stands", "random")]


def key(row: Row) -> tuple[str, str]:
    return row["want"], row["quantity"]


@pytest.mark.parametrize("real", REALS)
def test_tolerances_follow_from_the_measured_errors(real: str) -> None:
    """Three times what C and judge may differ by, of the example stands and of the random ones."""
    examples, _, random = tables(real)
    for row in (*examples, *random):
        apart = row["of scale"] + row["judges of scale"]
        assert BOUNDS[real].of(*key(row)) >= MARGIN * apart, row
        assert row["accepted"] == BOUNDS[real].of(*key(row)), row


@pytest.mark.parametrize("real", REALS)
def test_errors_are_within_what_is_promised(real: str) -> None:
    """The two measures agree: ulp, and error over scale."""
    limit, bits = ULPS[real] or 50.0, {"double": 52, "float": 23}[real]
    for row in (*tables(real)[0], *tables(real)[2]):
        assert row["ulp"] <= limit
        assert row["of scale"] <= row["ulp"] * 2.0**-bits * 1.1
        assert row["function alone"] <= limit


@pytest.mark.parametrize("real", REALS)
def test_forward_is_right_to_fifty_ulp_on_every_example_stand(real: str) -> None:
    forward = next(row for row in tables(real)[1] if key(row) == ("forward", "V_dot"))
    assert list(forward) == ["want", "quantity", *names(), written.RANDOM]
    assert all(0.0 < forward[name] <= 50.0 for name in (*names(), written.RANDOM))


@pytest.mark.parametrize("real", REALS)
def test_nothing_is_left_out(real: str) -> None:
    """Every quantity of free carriers, as the example stands are, that has an enclosure, in both tables."""
    examples, stands, random = tables(real)
    assert {want for want, _ in map(key, examples)} == set(wants_of("rigorous")) & set(wants_of_carrier(held=False))
    assert list(map(key, examples)) == list(map(key, random))
    assert {want for want, _ in map(key, stands)} == set(written.SHORT)


def test_the_worst_of_stands_is_the_largest_of_each() -> None:
    first, second = written.Worst(1.0, 5.0, judges=2.0, own=(1.0, 9.0)), written.Worst(2.0, 3.0, own=(3.0,))
    total = written.join_worst([{("torque", "tau"): first}, {("torque", "tau"): second, ("forward", "V_dot"): first}])
    assert list(total) == [("forward", "V_dot"), ("torque", "tau")]
    assert total["torque", "tau"] == written.Worst(2.0, 5.0, 2.0, 0.0, 0.0, (1.0, 9.0, 3.0))
    assert total["torque", "tau"].relative == 3.0
    assert total["forward", "V_dot"] == first
