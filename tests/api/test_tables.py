"""Tables of n stands: the bits of stands that are read one by one, in every function, and errors by sample."""

from typing import Any

import numpy as np
import pytest

import mahovik
from api.models import model, stand
from mahovik import InputError, StandError, UsageError
from mahovik.core.toolchain.compiled import Real
from mahovik.out.api.stands import Stand
from mahovik.out.campaign.file import possible_tables

UNBALANCE = ("static", "static_at", "dynamic", "dynamic_at")


def leaves(value: Any, path: str = "") -> list[tuple[str, float]]:
    """Paths of the numbers of a stand's keys, with the numbers."""
    if isinstance(value, dict):
        pairs = value.items()
        return [leaf for key, entry in pairs for leaf in leaves(entry, f"{path}.{key}" if path else key)]
    if isinstance(value, list):
        named: list[tuple[Any, Any]] = [
            (entry.get("name", i) if isinstance(entry, dict) else i, entry) for i, entry in enumerate(value)
        ]
        return [leaf for key, entry in named for leaf in leaves(entry, f"{path}.{key}")]
    return [(path, float(value))] if not isinstance(value, str | bool) else []


def random_changes(of: Stand, rng: np.random.Generator, n: int, share: float = 1e-4) -> dict[str, Any]:
    """Some numbers of a stand, changed by little: masses, mountings, laws; and unbalances of all flywheels."""
    known = {part.name for group in (of.flywheels, of.instruments, of.points) for part in group}
    changes: dict[str, Any] = {}
    for path, x in leaves(of.to_dict()):
        parts = path.split(".")
        parts = parts[1:] if len(parts) > 1 and parts[1] in known else parts
        tensor = any(key in ("inertia", "added_mass") for key in parts)
        mute = {"schema", "motor", "encoder", "inverse_weight", "inverse_most", "task"} & set(parts)
        if x != 0 and not tensor and not mute and rng.random() < 0.4:
            changes[".".join(parts)] = x * (1 + share * rng.uniform(-1, 1, n))
    for wheel in of.flywheels:
        (_, y, z), (J12, J13) = wheel.center_of_mass, wheel.inertia[0][1:]
        now = (wheel.mass * np.hypot(y, z), np.arctan2(z, y), np.hypot(J12, J13), np.arctan2(-J13, -J12))
        for key, x in zip(UNBALANCE, now, strict=True):
            if rng.random() < 0.6:
                values = x * (1 + share * rng.uniform(-1, 1, n))
                if key == "static" and rng.random() < 0.3:
                    values[rng.random(n) < 0.5] = 0.0  # another way through the reader
                changes[f"{wheel.name}.unbalance.{key}"] = values
    return changes


@pytest.mark.parametrize("name", ["general", pytest.param("everything", marks=pytest.mark.slow)])
def test_every_function_has_the_bits_of_models_of_their_own(name: str) -> None:
    m, n, rng = model(name), 11, np.random.default_rng(1)
    of = Stand.of(stand(name))
    tables = m.tables(random_changes(of, rng, n))
    assert len(tables) == n
    count = len(m.flywheels)
    angles, speeds = rng.uniform(-3, 3, (n, count)), rng.normal(size=(n, count)) * 9
    x = m.states(n, V=rng.normal(size=(n, 6)), phi=angles, phi_dot=speeds)
    wheel, twist = rng.normal(size=(n, count)), rng.normal(size=(n, 6))
    calls: dict[str, dict[str, Any]] = {
        "forward": {"phi_ddot": wheel}, "coupled": {"tau": wheel}, "torque": {"V_dot": twist}, "matrices": {},
        "momentum": {}, "mounts": {"V_dot": twist, "phi_ddot": wheel}, "points": {"V_dot": twist},
        "inverse": {"V_dot": twist}, "step": {"dt": 1e-4, "tau": wheel}, "step_driven": {"dt": 1e-4, "phi_ddot": wheel},
        "forward_jacobian": {"phi_ddot": wheel},
    }  # fmt: skip
    for j in (0, 7, 10):
        single = mahovik.build(tables.stand(j))
        for function, inputs in calls.items():
            answers = getattr(m, function)(x, **inputs, tables=tables)
            one = {key: value[j] if isinstance(value, np.ndarray) else value for key, value in inputs.items()}
            expected = getattr(single, function)(x.array[j], **one)
            for key, value in dict(expected).items():
                assert value.tobytes() == np.ascontiguousarray(answers[key][j]).tobytes(), (function, key, j)


def test_units_and_values_for_all_samples() -> None:
    m, wheel = model("demo3"), "w1"
    grams = np.array([0.1, 0.3, 1.7])
    path = f"{wheel}.unbalance.static"
    with_units = m.tables({path: {"value": grams, "unit": "g mm"}, "carrier.mass": "13 kg"})
    expected = Stand.of(m.stand).replace({path: "0.3 g mm", "carrier.mass": 13})
    assert with_units.stand(1).flywheels == expected.flywheels
    x = m.state(phi_dot=100.0)
    one = mahovik.build(expected).forward(x)
    assert one.V_dot.tobytes() == m.forward(x, tables=with_units).V_dot[1].tobytes()


def refused(changes: Any, n: int | None = None, kind: type[Exception] = UsageError) -> str:
    with pytest.raises(kind) as refusal:
        model("demo3").tables(changes, n)
    text = str(refusal.value)
    assert "\n" not in text
    return text


def test_errors_say_which_path_and_which_sample() -> None:
    three = np.ones(3)
    assert 'did you mean "carrier"' in refused({"carier.mass": three})
    assert 'did you mean "mass"' in refused({"carrier.mas": three}, kind=StandError)
    assert "carrier.mass 3, gravity 2" in refused({"carrier.mass": three, "gravity": np.ones((2, 3))}, kind=InputError)
    assert "a length (m)" in refused({"w1.position.0": {"value": three, "unit": "kg"}}, kind=StandError)
    assert "no array" in refused({"carrier.mass": 3}, kind=InputError)
    assert "array of numbers" in refused({"carrier.mass": ["a", "b"]}, kind=InputError)
    masses = np.array([5.0, 5.0, -1.0, 5.0])
    assert "sample 2: carrier, mass" in refused({"carrier.mass": masses}, kind=StandError)
    assert "sample 2: carrier, mass" in refused({"carrier.mass": np.where(masses > 0, 5.0, np.nan)}, kind=StandError)
    inertia = np.tile([0.1, 0.1, 0.1], (4, 1))
    inertia[3, 0] = 0.3
    text = refused({"carrier.inertia": inertia, "carrier.center_of_mass": np.zeros((4, 3))}, kind=StandError)
    assert "sample 3" in text
    assert "triangle inequality" in text
    heavy = np.array([[0, 0, -9.81], [0, 0, 0.0]])
    assert "sample 0: is of another structure" in refused({"gravity": heavy})


def test_numbers_that_no_table_has_are_refused() -> None:
    m = model("demo3")
    with pytest.raises(UsageError, match="inverse_weight: acts in no function"):
        m.tables({"w1.inverse_weight": np.ones(2)})


def test_tables_of_another_model_and_of_another_number_are_refused() -> None:
    m, other = model("demo3"), model("general")
    tables = m.tables({"carrier.mass": np.array([5.0, 6.0])})
    with pytest.raises(InputError, match="tables of another model"):
        other.forward(other.state(), tables=tables)
    with pytest.raises(InputError, match="different numbers of states: 3 given, tables 2"):
        m.forward(m.states(3), tables=tables)
    with pytest.raises(InputError, match=r"expected what model\.tables makes"):
        m.forward(m.state(), tables=[1])  # type: ignore[arg-type]  # what a user may pass


def test_what_is_wrong_with_all_samples_is_no_reason() -> None:
    m = model("demo3")
    with pytest.raises(UsageError, match="did you mean"):
        possible_tables(m, {"carier.mass": np.ones(2)})
    with pytest.raises(InputError, match="different numbers of samples"):
        possible_tables(m, {"carrier.mass": np.ones(2), "w1.mass": np.ones(3)})


def test_another_structure_is_a_reason() -> None:
    m = model("general")
    assert any(m.stand.gravity)
    possible = possible_tables(m, {"gravity": np.array([m.stand.gravity, (0.0, 0.0, 0.0)])})
    assert possible.numbers.tolist() == [0]
    assert "another structure" in possible.reasons[1]


@pytest.mark.parametrize("real", ["double", "float"])
def test_each_of_many_samples_moves_as_its_own_stand(real: Real) -> None:
    """There are more samples than are simulated together, so that the later ones begin within the tables."""
    m, n = model("demo3", real), 272
    tables = m.tables({"carrier.mass": np.linspace(10.0, 14.0, n)})
    start = m.state(V=[0.1, 0, 0, 0, 0.2, 0], phi_dot=100.0)
    runs = m.simulate(2e-3, start=start, tables=tables)
    for j in (0, 255, 256, n - 1):
        single = mahovik.build(tables.stand(j), real=real).simulate(2e-3, start=start)
        assert single["V"].tobytes() == runs["V"][j].tobytes()
