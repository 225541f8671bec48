"""FMUs of free and of held carriers in fmpy's hands move as `mahovik simulate` does."""

from __future__ import annotations

import ctypes
import math
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import fmpy
import numpy as np
import pytest
from fmpy.fmi1 import FMICallException

from export.fmu import fmus
from mahovik.core.lower.fmu_variables import Inputs, Kind
from mahovik.core.motion.regime import loads_regime
from mahovik.core.stand.hold import freedom_names, twist_of
from mahovik.core.stand.model import Stand, State, rest_state
from mahovik.core.stand.stand_file import loads
from mahovik.out.export.fmu import export_fmu
from mahovik.proof.verify.draw import with_pose
from mahovik.use.simulate.case import Case
from mahovik.use.simulate.held import allowed_start, home, rates
from mahovik.use.simulate.run import simulate
from toolchain.quick import quick
from verify.holds import PENDULUM

UNTIL, EVERY, DT = 0.1, 0.0125, 1e-3
SPEEDS, TORQUE, ACCELERATION, WRENCH = 40.0, 0.02, 30.0, (3.0, -2.0, 1.0, 0.2, 0.1, -0.3)


def start(stand: Stand, inputs: Inputs) -> tuple[State, dict[str, float]]:
    """A state in motion, and the same as start values and inputs of an FMU."""
    N = len(stand.flywheels)
    state = fmus.moving(stand, SPEEDS)
    values = {f"carrier.V[{i + 1}]": state.V[i] for i in range(6)}
    values |= {f"carrier.position[{i + 1}]": state.position[i] for i in range(3)}
    quaternion = state.quaternion or (1.0, 0.0, 0.0, 0.0)
    values |= {f"carrier.attitude[{i + 1}]": quaternion[i] for i in range(4)}
    for k, s in enumerate(stand.flywheels):
        values |= {f"{s.name}.phi": state.phi[k], f"{s.name}.phi_dot": state.phi_dot[k]}
        drive = (1.0 - 2.0 * (k % 2)) * (k + 1) / N
        symbol, size = ("tau", TORQUE) if inputs == "torque" else ("phi_ddot", ACCELERATION)
        values[f"{s.name}.{symbol}"] = size * drive
    for body in stand.bodies:
        if body.wrench_input:
            values |= {f"{body.name}.wrench[{i + 1}]": WRENCH[i] for i in range(6)}
    return state, values


def regime(stand: Stand, state: State, values: dict[str, float], inputs: Inputs) -> Any:
    """The same drives as a regime of `simulate`."""
    lines, wrenches = ["schema = 1"], []
    for k, s in enumerate(stand.flywheels):
        if inputs == "torque":
            law = f"torque = {values[f'{s.name}.tau']!r}"
        else:
            end = state.phi_dot[k] + values[f"{s.name}.phi_ddot"] * 10.0
            law = f"ramp = {{ from = {state.phi_dot[k]!r}, to = {end!r}, duration = 10.0 }}"
        lines.append(f"[flywheel.{s.name}]\n{law}")
    for body in stand.bodies:
        if body.wrench_input:
            wrenches.append(f"{body.name} = {list(WRENCH)}")
    if wrenches:
        lines += ["[wrench]", *wrenches]
    return loads_regime("\n".join(lines), stand, UNTIL)


def pairs(stand: Stand, inputs: Inputs) -> dict[str, str]:
    """Columns of `simulate` by names of variables."""
    columns = {f"carrier.position[{i + 1}]": f"{a} [m]" for i, a in enumerate("xyz")}
    columns |= {f"carrier.attitude[{i + 1}]": f"q{a}" for i, a in enumerate("wxyz")}
    columns |= {f"carrier.V[{i + 1}]": f"v_{a} [m/s]" for i, a in enumerate("xyz")}
    columns |= {f"carrier.V[{i + 4}]": f"omega_{a} [rad/s]" for i, a in enumerate("xyz")}
    columns |= {f"carrier.V_dot[{i + 1}]": f"v_dot_{a} [m/s2]" for i, a in enumerate("xyz")}
    columns |= {f"carrier.V_dot[{i + 4}]": f"omega_dot_{a} [rad/s2]" for i, a in enumerate("xyz")}
    letters = zip("XYZKMN", ("N",) * 3 + ("N m",) * 3, strict=True)
    loads = [f"mount_{a} {{}} [{u}]" for a, u in letters]
    for s in stand.flywheels:
        columns |= {f"{s.name}.phi": f"phi {s.name} [rad]", f"{s.name}.phi_dot": f"phi_dot {s.name} [rad/s]"}
        other = ("phi_ddot", "rad/s2") if inputs == "torque" else ("tau", "N m")
        columns[f"{s.name}.{other[0]}"] = f"{other[0]} {s.name} [{other[1]}]"
        columns |= {f"{s.name}.mount_wrench[{i + 1}]": loads[i].format(s.name) for i in range(6)}
    for name in (*(p.name for p in stand.instruments), *(p.name for p in stand.points)):
        columns |= {f"{name}.reading.specific_force[{i + 1}]": f"force_{a} {name} [m/s2]" for i, a in enumerate("xyz")}
        columns |= {f"{name}.reading.twist[{i + 4}]": f"gyro_{a} {name} [rad/s]" for i, a in enumerate("xyz")}
    return columns


def moved(name: str, inputs: Inputs, **more: Any) -> tuple[Any, Any, dict[str, str]]:
    """The same motion by fmpy and by `simulate`, and which columns belong together."""
    stand = fmus.stand(name)
    state, values = start(stand, inputs)
    columns = pairs(stand, inputs)
    kind = more.pop("kind", "cs")
    backend = more.pop("backend", "c")
    by_fmpy = fmpy.simulate_fmu(
        fmus.path(name, kind, inputs), stop_time=UNTIL, output_interval=EVERY, output=list(columns),
        start_values=values | ({"dt": DT} if kind == "cs" else {}), **more,
    )  # fmt: skip
    case = Case(stand, regime(stand, state, values, inputs), state, UNTIL, EVERY, DT)
    return by_fmpy, simulate(case, backend, mounts=True), columns


def compare(by_fmpy: Any, by_us: Any, columns: dict[str, str], tolerance: float) -> None:
    """Each column to `tolerance` of its largest number, or of 1 where that is less: sums of larger ones cancel."""
    times = by_us["t [s]"]
    assert len(by_fmpy) == len(times)
    assert np.abs(by_fmpy["time"] - times).max() < 1e-12
    for name, column in columns.items():
        expected = by_us[column]
        scale = max(1.0, float(np.abs(expected).max()))
        assert np.abs(by_fmpy[name] - expected).max() < tolerance * scale, name


@pytest.mark.parametrize(
    ("name", "inputs"),
    quick(
        1,
        [
            ("driven", "torque"),
            ("bench8", "acceleration"),
            ("auv6", "torque"),
            ("rigid", "torque"),
        ],
    ),
)
def test_co_simulation_is_simulate(name: str, inputs: Inputs) -> None:
    """The integrator inside is that of `simulate`, and so are its steps."""
    compare(*moved(name, inputs), 1e-9)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "inputs"),
    [("driven", "torque"), ("auv6", "acceleration"), ("rigid", "torque")],
)
def test_model_exchange_is_the_reference(name: str, inputs: Inputs) -> None:
    """CVode on the rates of the FMU agrees with SciPy on the literal reference; they share the stand alone."""
    compare(*moved(name, inputs, kind="me", backend="scipy", solver="CVode", relative_tolerance=1e-11), 2e-6)


@pytest.mark.slow
def test_the_quaternion_is_drawn_to_unit_length() -> None:
    """Model exchange: d|q|^2/dt = 2 |q|^2 (1 - |q|^2), whatever omega is; so an integrator cannot lose it."""
    with fmus.instance("driven", "me", "torque") as one:
        one.put({"carrier.V[4]": 3.0, "carrier.V[6]": -2.0})
        one.begin()
        one.fmu.enterContinuousTimeMode()
        count = 13 + 2 * len(fmus.stand("driven").flywheels)
        states, rates = (np.zeros(count) for _ in range(2))
        pointers = [x.ctypes.data_as(ctypes.POINTER(ctypes.c_double)) for x in (states, rates)]
        one.fmu.getContinuousStates(pointers[0], count)
        for length in (1.0, 1.01, 0.99):
            states[3:7] *= length / np.linalg.norm(states[3:7])
            one.fmu.setContinuousStates(pointers[0], count)
            one.fmu.getDerivatives(pointers[1], count)
            square = length**2
            assert states[3:7] @ rates[3:7] == pytest.approx(square * (1 - square), abs=1e-14)
            assert np.abs(rates[3:7]).max() > 0.1


# ---- held carriers ----

FRICTION = "[[hold.friction]]\nviscous = 0.02\ncoulomb = 0.05\nbreakaway = 0.1\nstribeck_speed = 0.2\n"
STOPS = "".join(
    f'[[hold.stop]]\nat = {at}\nside = "{side}"\nstiffness = 50\ndamping = 20\n'
    for at, side in ((0.15, "above"), (-0.1, "below"))
)
HOLDS: dict[str, tuple[str, str, tuple[float, ...]]] = {
    "pendulum": ('freedoms = ["pitch"]', FRICTION + STOPS, (2.0,)),
    "plane": ('freedoms = ["yaw", "x", "y"]', "", (2.0, 0.3, -0.2)),
    "ball joint": ('freedoms = ["roll", "pitch", "yaw"]', "", (1.0, 2.0, -0.5)),
    "clamped": ("freedoms = []", "", ()),
    "shaker": ("slide = [0, 1, 1]", FRICTION + STOPS, (0.5,)),
    "hinge": ("axis = [0, 1, 1]", "", (25.0,)),
    "basis": ("basis = [[1, 0, 0, 0, 0, 0], [0, 0, 0.1, 0, 0, 1]]", "", (0.1, 0.2)),
}
"""Freedoms of the hold, what resists, speeds at the start."""


def held_case(name: str) -> tuple[Stand, State]:
    """A pendulum with another hold, in motion in its home pose."""
    freedoms, resistance, u = HOLDS[name]
    text = PENDULUM.replace('freedoms = ["pitch"]', freedoms) + resistance
    stand = loads(text if name not in ("clamped", "shaker", "basis") else text.replace("pivot = [0, 0, -0.2]\n", ""))
    assert stand.hold is not None
    state = replace(rest_state(stand), u=u, V=twist_of(stand.hold, u), phi_dot=(40.0,))
    return stand, allowed_start(stand, with_pose(stand, state, {"u", "phi_dot"}))


def written(stand: Stand, start: State, folder: Path, kind: Kind = "cs", **more: Any) -> str:
    """File of an FMU that starts in a state."""
    file = folder / "held.fmu"
    file.write_bytes(export_fmu(stand, kind, dt=DT, start=start, **more).content)
    return str(file)


@pytest.mark.parametrize(
    ("name", "kind", "inputs"),
    quick(
        1,
        [
            ("pendulum", "cs", "torque"),
            ("shaker", "cs", "torque"),
            ("plane", "cs", "acceleration"),
            ("ball joint", "me", "torque"),
            ("clamped", "cs", "torque"),
        ],
    ),
)
def test_a_held_carrier_moves_as_simulate_does(name: str, kind: Kind, inputs: Inputs, tmp_path: Path) -> None:
    """Friction, stops, coordinates and the reaction of the hold are compared."""
    stand, state = held_case(name)
    assert stand.hold is not None
    torque = inputs == "torque"
    law = "torque = 0.02" if torque else "ramp = { from = 40.0, to = 340.0, duration = 10.0 }"
    expected = simulate(
        Case(stand, loads_regime(f"schema = 1\n[flywheel.w1]\n{law}", stand, UNTIL), state, UNTIL, EVERY, DT),
        mounts=True,
    )
    columns = pairs(stand, inputs)
    columns |= {
        f"hold.reaction[{i + 1}]": f"hold.reaction.{a} [{'N' if i < 3 else 'N m'}]" for i, a in enumerate("xyzkmn")
    }
    columns |= {
        f"q.{label.split()[1]}": label for label in expected.columns if label.startswith("q ") and name != "shaker"
    }
    letters = [label for label in expected.columns if label.startswith("orientation_")]
    columns |= {f"q.orientation[{i + 1}]": label for i, label in enumerate(letters)}
    speeds = {f"u.{label}" if name != "shaker" else "u[1]": k for k, label in enumerate(freedom_names(stand.hold))}
    by_fmpy = fmpy.simulate_fmu(
        written(stand, state, tmp_path, kind, inputs=inputs),
        validate=True,
        stop_time=UNTIL,
        output_interval=EVERY,
        start_values={"w1.tau": 0.02} if torque else {"w1.phi_ddot": 30.0},
        relative_tolerance=1e-9,
        output=[*columns, *speeds],
    )
    compare(by_fmpy, expected, columns, 1e-9 if kind == "cs" else 1e-5)  # one method; CVODE beside Runge-Kutta
    twists = np.stack([by_fmpy[f"carrier.V[{i + 1}]"] for i in range(6)], axis=1)
    u = np.array([rates(stand.hold, V) for V in twists])
    for variable, k in speeds.items():
        assert by_fmpy[variable] == pytest.approx(u[:, k], abs=1e-9)


@pytest.mark.slow
def test_an_angle_counts_its_turns_also_within_a_communication_step(tmp_path: Path) -> None:
    """25 rad/s is two turns in half a second."""
    stand, state = held_case("hinge")
    regime = loads_regime("schema = 1\n[flywheel.w1]\ntorque = 0.02", stand, 1.0)
    fine = simulate(Case(stand, regime, state, 1.0, 0.01, DT))
    by_fmpy = fmpy.simulate_fmu(
        written(stand, state, tmp_path),
        stop_time=1.0, output_interval=0.5, start_values={"w1.tau": 0.02}, output=["q[1]", "u[1]"],
    )  # fmt: skip
    assert by_fmpy["q[1]"] == pytest.approx(fine["q 1 [rad]"][[0, 50, 100]], abs=1e-8)
    assert by_fmpy["u[1]"] == pytest.approx(fine["q_dot 1 [rad/s]"][[0, 50, 100]], abs=1e-8)
    assert abs(by_fmpy["q[1]"][-1]) > 2 * math.pi


@pytest.mark.parametrize(
    ("name", "units"),
    quick(
        2,
        [
            ("pendulum", {
                "q.pitch": "rad", "u.pitch": "rad/s", "friction[1].viscous": "N.m.s/rad",
                "friction[1].coulomb": "N.m", "turn_stop[2].stiffness": "N.m/rad",
            }),
            ("shaker", {
                "q[1]": "m", "u[1]": "m/s", "friction[1].viscous": "N.s/m", "friction[1].stribeck_speed": "m/s",
            }),
            ("plane", {"q.yaw": "rad", "q.x": "m", "u.yaw": "rad/s", "u.y": "m/s"}),
            ("ball joint", {"u.roll": "rad/s"}),
        ],
    ),
)  # fmt: skip
def test_numbers_of_a_freedom_have_its_units(name: str, units: dict[str, str], tmp_path: Path) -> None:
    stand, _ = held_case(name)
    file = written(stand, home(stand), tmp_path, binary=False)
    described = fmpy.read_model_description(file, validate=True).modelVariables
    declared = {v.name: v.unit or (v.declaredType.unit if v.declaredType else None) for v in described}
    assert {variable: declared[variable] for variable in units} == units
    assert not any(variable.startswith(("S[", "pivot", "sliding", "home_")) for variable in declared)


@pytest.mark.parametrize(
    ("name", "start", "message"),
    quick(
        1,
        [
            ("pendulum", {"carrier.V[1]": 1.0}, r"carrier.V: found [0-9.]+ m/s along x, which the hold blocks"),
            ("pendulum", {"carrier.position[3]": 0.1}, r"off by 0.1 m along z, which the hold blocks"),
            ("shaker", {"carrier.attitude[1]": 0.8, "carrier.attitude[2]": 0.6}, r"off by 1.2 rad along roll"),
            ("clamped", {"carrier.V[6]": 1.0}, r"carrier.V: found 1 rad/s along yaw"),
            ("basis", {"carrier.V[2]": 1.0}, r"carrier.V: found 1 m/s along y"),
        ],
    ),
)
def test_a_start_that_the_hold_blocks_is_refused(
    name: str, start: dict[str, float], message: str, tmp_path: Path
) -> None:
    stand, _ = held_case(name)
    log: list[str] = []
    with pytest.raises(FMICallException):
        fmpy.simulate_fmu(
            written(stand, home(stand), tmp_path),
            stop_time=0.01,
            start_values=start,
            logger=lambda *line: log.append(line[-1].decode()),
        )
    assert any(re.search(message, line) for line in log), log
