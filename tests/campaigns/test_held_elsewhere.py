"""Samples that are held at other places: their own stands one by one, at rest, over programmes, in identification."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import mahovik
from campaigns.computing import computation, tables_of
from campaigns.files import write
from campaigns.test_held_programmes import RUN, SWING, write_files
from cli.test_eval_held import TEXT
from identify.test_excite_held import STICK
from mahovik.core.motion.programme import load_programme
from mahovik.core.stand.read import loads
from mahovik.errors import CampaignError, UsageError
from mahovik.out.api.stands import Stand
from mahovik.out.campaign.campaign import Campaign
from mahovik.out.campaign.holds import Holds
from mahovik.use.plan.residual.held_kinematics import held_pose
from mahovik.use.simulate.held import home
from plan.held_stands import stand, wheel
from plan.test_held import PENDULUM, POSES

PLACES: dict[str, Any] = {
    "hold.pivot": np.array([[0.0, 0.0, -0.2], [0.02, 0.0, -0.15], [0.0, 0.1, 0.25]]),
    "hold.position": np.array([[0.0, 0.0, 0.0], [1.0, -2.0, 0.5], [0.1, 0.0, 0.0]]),
    "hold.angles": np.array([[0.0, 0.0, 0.0], [0.0, 0.1, 0.0], [0.3, -0.2, 0.1]]),
}


@pytest.mark.parametrize("hold", [POSES[0], *(pytest.param(each, marks=pytest.mark.slow) for each in POSES[1:-1])])
def test_a_state_is_as_far_from_the_home_pose_of_each_sample(hold: str) -> None:
    """Coordinates and speeds of its freedoms stay, there and back, in every sample."""
    own = Stand.of(stand(f"{hold}\nposition = [1, 2, 3]\nangles = [0.3, -0.2, 0.1]", wheel(1, [1, 0, 0])))
    assert own.hold is not None
    m = len(own.hold.freedoms)
    changes = {path: values for path, values in PLACES.items() if path != "hold.pivot" or "pivot" in hold}
    tables = mahovik.build(own).tables(changes)
    holds = Holds.of(own, tables)
    assert holds is not None
    rng = np.random.default_rng(3)
    q, u = rng.uniform(-1.0, 1.0, (1, m)), rng.normal(size=m)

    def state(each: Stand) -> Any:
        assert each.hold is not None
        C, O1 = held_pose(each, q)
        return O1[0], C[0], mahovik.build(each).state(u=u).V

    O1, C, V = state(own)
    start = np.concatenate([O1, _quaternion(C), V])
    found = holds.states(np.repeat(start[:, None], 3, axis=1))
    for j in range(3):
        O1_j, C_j, V_j = state(tables.stand(j))
        assert np.abs(found[:3, j] - O1_j).max() < 1e-13
        assert abs(found[3:7, j] @ _quaternion(C_j)) == pytest.approx(1.0, abs=1e-14)
        assert np.abs(found[7:, j] - V_j).max() < 1e-13
    position, attitude = holds.nominal_poses(found[:3], found[3:7])
    assert np.abs(position - O1[:, None]).max() < 1e-13
    assert np.abs(np.abs(start[3:7] @ attitude) - 1.0).max() < 1e-14
    assert np.abs(holds.nominal_twists(found[7:]) - V[:, None]).max() < 1e-13


def _quaternion(C: Any) -> Any:
    from scipy.spatial.transform import Rotation

    return Rotation.from_matrix(C).as_quat()[[3, 0, 1, 2]]


@pytest.mark.slow
def test_tables_are_those_of_the_stands_one_by_one() -> None:
    """Bit for bit: twists of the freedoms, pivot, home pose, and the wrenches of friction and stops."""
    more = "[[hold.friction]]\nviscous = 0.01\n"
    more += "".join(f"[[hold.stop]]\nat = {at}\nstiffness = 10\n" for at in (1, -1))
    own = Stand.of(loads(TEXT + more))
    laws = mahovik.build(own).tables(PLACES)
    for j in range(3):
        alone = mahovik.build(laws.stand(j)).tables({}, 1).laws()
        for name, value in laws.laws().items():
            assert _part(value, j) == _part(alone[name], 0), name


def _part(value: Any, j: int) -> Any:
    if isinstance(value, dict):
        return {key: _part(each, j) for key, each in value.items()}
    return [_part(each, j) for each in value] if isinstance(value, list) else value[..., j].tolist()


@pytest.mark.slow
def test_samples_with_other_pivots_are_their_own_stands() -> None:
    own = Stand.of(loads(TEXT))
    regime = {"default": {"speed": 100}}
    run = {"regime": regime, "until": 0.1, "dt": 1e-3, "every": 5e-3, "start": {"angles": [0.0, 0.4, 0.0], "u": [0.3]}}
    wanted = {
        "force": {"end": "force", "of": "hold", "axis": "x"},
        "tip": {"end": "velocity", "at": "tip", "axis": "x"},
    }
    computed = computation(own, run, wanted)
    changes = PLACES | {"hold.angles": np.array([[0.0, 0.0, 0.0], [0.0, 0.1, 0.0], [0.0, -0.2, 0.0]])}
    found, reasons = computed.values(tables_of(computed, changes))
    assert not any(reasons)
    for j in range(3):
        one = own.replace({path: values[j].tolist() for path, values in changes.items()})
        start = {"angles": [0.0, 0.4 + float(changes["hold.angles"][j, 1]), 0.0], "u": [0.3]}
        seen = mahovik.simulate(one, 0.1, regime=regime, start=start, dt=1e-3, every=5e-3)
        assert found["force"][j] == pytest.approx(seen["hold.reaction.x"][-1], rel=1e-9)
    assert len(set(found["tip"].tolist())) == 3


def test_samples_with_other_pivots_begin_at_their_own_rest() -> None:
    """The pivot of a pendulum off its axis: it hangs there with its weight on the pivot, and does not move."""
    hanging = TEXT.replace("pivot = [0, 0, -0.2]", "pivot = [0, 0, 0.2]")
    own = Stand.of(loads(hanging))
    computed = computation(
        own,
        {"regime": {"default": {"hold": True}}, "until": 0.05, "start": "rest"},
        {
            "force": {"peak": "force", "of": "hold"}, "rate": {"peak": "rate", "at": "tip"},
            "moment": {"peak": "moment", "of": "hold", "axis": "y"},
        },
    )  # fmt: skip
    pivots = np.array([[0.0, 0.0, 0.2], [0.01, 0.0, 0.2], [0.08, 0.0, 0.2]])
    found, reasons = computed.values(tables_of(computed, {"hold.pivot": pivots}))
    assert not any(reasons)
    assert found["force"] == pytest.approx(np.full(3, 2.5 * 9.81), rel=1e-9)
    assert np.all(found["rate"] < 1e-9) and np.all(found["moment"] < 1e-9)  # about O1, the centre of mass


@pytest.mark.slow
def test_the_error_of_a_programme_counts_from_the_own_home_pose(tmp_path: Path) -> None:
    """Another place in E0 changes nothing, another pivot what the equation of the pendulum says."""
    write_files(tmp_path, PENDULUM, SWING)
    computed = computation(
        Stand.of(PENDULUM), {**RUN, "periods": 1, "dt": 1e-3}, {"e": {"peak": "error", "axis": "pitch"}},
        folder=tmp_path,
    )  # fmt: skip
    changes = {
        "hold.position": np.array([[0.0, 0, 0], [3.0, -1, 2], [0, 0, 0]]),
        "hold.pivot": np.array([[0.0, 0, 0.12], [0, 0, 0.12], [0, 0, 0.13]]),
    }
    found, reasons = computed.values(tables_of(computed, changes))
    assert not any(reasons)
    assert found["e"][0] < 1e-6 and found["e"][1] < 1e-6
    programme, pivot = load_programme(tmp_path / "p.json"), 0.13

    def rates(time: float, y: Any) -> Any:  # J theta'' + m g l sin theta = -J_w phi''
        phi_ddot = programme.at(np.array([time])).phi_ddot[0, 0]
        return [y[1], -(2.5 * 9.81 * pivot * np.sin(y[0]) + 0.01 * phi_ddot) / (0.04 + 2.5 * pivot**2)]

    t = np.linspace(0.0, 1.0, 1001)
    y = solve_ivp(rates, (0.0, 1.0), [0.3 + programme.bias[0], 0.0], t_eval=t, rtol=1e-9, atol=1e-12).y[0]
    expected = np.abs(y - 0.3 * np.cos(2 * np.pi * t) - programme.bias[0]).max()
    assert found["e"][2] == pytest.approx(expected, rel=1e-4) and expected > 1e-4


@pytest.mark.slow
def test_the_pivot_of_a_pendulum_is_told_by_its_swing(tmp_path: Path) -> None:
    """A gyro tells how far the pivot is from the centre of mass, and how much friction it has."""
    true = Stand.from_dict(STICK | {"hold": STICK["hold"] | {"pivot": [0.004, 0, 0.01]}})
    start = {"angles": [0, 0.5, 0], "u": [0.2]}
    run = mahovik.simulate(
        true, 3.0, regime={"default": {"hold": True}}, start=start, every=0.01, backend="scipy"
    )  # the literal reference
    rng = np.random.default_rng(2)
    rates = run["gyro_y gyro"] + 0.005 * rng.normal(size=len(run))
    rows = np.column_stack([run["t"], rates, run["phi wheel"]])
    file = tmp_path / "swing.csv"
    np.savetxt(file, rows, delimiter=",", header="time [s],gyro.rate.y [rad/s],wheel.phase [rad]", comments="")
    guess = true.replace({"hold.pivot": [0.004, 0.0, -0.005], "hold.friction.0.viscous": 0.006})
    found = mahovik.identify(guess, file, ["hold.pivot[2]", "hold.friction[0].viscous"])
    pivot, friction = found.parameters.values()
    assert (pivot.path, pivot.unit) == ("hold.pivot[2]", "m")
    assert abs(pivot.value - 0.01) < 4.0 * pivot.standard_error < 0.01
    assert abs(friction.value - 0.004) < 4.0 * friction.standard_error < 4e-4


@pytest.mark.parametrize("path", ["hold.freedoms", "hold.axis"])
def test_how_the_carrier_can_move_is_the_same_in_all_samples(path: str) -> None:
    own = stand("axis = [1, 1, 0]", wheel(1, [1, 0, 0]))
    with pytest.raises(UsageError, match=f"{path}: decides how the carrier can move"):
        mahovik.build(own).tables({path: np.ones((2, 3))})


def test_states_of_a_file_are_of_one_place(tmp_path: Path) -> None:
    (tmp_path / "p.toml").write_text(TEXT, encoding="utf-8")
    (tmp_path / "s.jsonl").write_text('{"u": [1]}\n', encoding="utf-8")
    body = (
        '[vary]\n"hold.pivot[2]" = { tolerance = "1 mm" }\n[over]\nstates = "s.jsonl"\n'
        '[[quantity]]\nname = "f"\nwhat = "peak force"\nat = "hold"\n'
    )
    with pytest.raises(CampaignError, match="the states of a file are of one place") as refused:
        Campaign.load(write(tmp_path, body, stand="p.toml", samples=4))
    assert "\n" not in str(refused.value)


def test_the_home_pose_is_where_a_sample_begins_without_a_start() -> None:
    own = Stand.of(loads(TEXT))
    tables = mahovik.build(own).tables(PLACES)
    holds = Holds.of(own, tables)
    at_home = home(own)
    assert holds is not None
    start = np.array([*at_home.position, *(at_home.quaternion or ()), *at_home.V])
    found = holds.states(np.repeat(start[:, None], 3, axis=1))
    assert np.allclose(found[:3], PLACES["hold.position"].T, atol=1e-15)
    assert Holds.of(own, mahovik.build(own).tables({"carrier.mass": np.ones(2)})) is None
