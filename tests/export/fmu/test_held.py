"""FMUs of held carriers in fmpy's hands move as `mahovik simulate` does, with the reaction of the hold."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from scipy.spatial.transform import Rotation

from cli.run import run
from cli.test_eval_held import TEXT
from export.fmu.test_simulation import DT, EVERY, UNTIL, pairs
from mahovik.core.lower.fmu.variables import Inputs, Kind
from mahovik.core.motion import loads_regime
from mahovik.core.stand.hold import freedom_names, twist_of
from mahovik.core.stand.model import Stand
from mahovik.core.stand.read import loads
from mahovik.core.stand.state import State, rest_state
from mahovik.out.export.fmu import export_fmu
from mahovik.use.simulate import Case, simulate
from mahovik.use.simulate.held import complete_start, home, rates

HOLDS = {
    "pendulum": ('["pitch"]', (2.0,)),
    "plane": ('["yaw", "x", "y"]', (2.0, 0.3, -0.2)),
    "ball joint": ('["roll", "pitch", "yaw"]', (1.0, 2.0, -0.5)),
    "clamped": ("[]", ()),
}
OTHERS = {
    "shaker": TEXT.replace('freedoms = ["pitch"]', "slide = [0, 1, 1]").replace("pivot = [0, 0, -0.2]\n", ""),
    "hinge": TEXT.replace('freedoms = ["pitch"]', "axis = [0, 1, 1]"),
    "basis": TEXT.replace('freedoms = ["pitch"]', "basis = [[1, 0, 0, 0, 0, 0], [0, 0, 0.1, 0, 0, 1]]").replace(
        "pivot = [0, 0, -0.2]\n", ""
    ),
}
FORMS: tuple[tuple[str, str, Kind, Inputs], ...] = (
    ("pendulum", "2.0", "cs", "torque"),
    ("plane", "3.0", "cs", "acceleration"),
    ("ball joint", "2.0", "me", "torque"),
    ("clamped", "3.0", "cs", "torque"),
)


def moving(name: str) -> tuple[Stand, State]:
    ways, u = HOLDS[name]
    text = TEXT.replace('["pitch"]', ways)
    stand = loads(text if ways != "[]" else text.replace("pivot = [0, 0, -0.2]\n", ""))
    assert stand.hold is not None
    state = replace(rest_state(stand), u=u, V=twist_of(stand.hold, u), phi_dot=(40.0,))
    return stand, complete_start(stand, state, {"u", "phi_dot"})


@pytest.mark.slow
@pytest.mark.parametrize(("name", "version", "kind", "inputs"), FORMS)
def test_it_moves_as_simulate_does(name: str, version: str, kind: Kind, inputs: Inputs, tmp_path: Path) -> None:
    stand, state = moving(name)
    assert stand.hold is not None
    torque = inputs == "torque"
    law = "torque = 0.02" if torque else "ramp = { from = 40.0, to = 340.0, duration = 10.0 }"
    regime = loads_regime(f"schema = 1\n[flywheel.w1]\n{law}", stand, UNTIL)
    expected = simulate(Case(stand, regime, state, UNTIL, EVERY, DT), mounts=True)
    file = tmp_path / "held.fmu"
    file.write_bytes(export_fmu(stand, version, kind, inputs, dt=DT, start=state).content)
    columns = pairs(stand, inputs)
    columns |= {
        f"hold.reaction[{i + 1}]": f"hold.reaction.{a} [{'N' if i < 3 else 'N m'}]" for i, a in enumerate("xyzkmn")
    }
    coordinates = coordinate_pairs(stand, expected.names)
    assert bool(coordinates) == (name != "clamped")
    columns |= coordinates
    found = fmpy.simulate_fmu(
        str(file),
        validate=True,
        stop_time=UNTIL,
        output_interval=EVERY,
        start_values={"w1.tau": 0.02} if torque else {"w1.phi_ddot": 30.0},
        relative_tolerance=1e-9,
        output=[*columns, *(f"u.{each}" for each in freedom_names(stand.hold))],
    )
    assert np.allclose(found["time"], expected["t [s]"])
    for variable, column in columns.items():
        scale = max(1.0, float(np.abs(expected[column]).max()))
        most = 1e-9 if kind == "cs" else 1e-5  # of one method; of CVODE beside Runge-Kutta
        assert found[variable] == pytest.approx(expected[column], abs=most * scale), variable
    u = np.array([rates(stand.hold, V) for V in np.stack([found[f"carrier.V[{i + 1}]"] for i in range(6)], axis=1)])
    for k, freedom in enumerate(freedom_names(stand.hold)):
        assert found[f"u.{freedom}"] == pytest.approx(u[:, k], abs=1e-9)


def coordinate_pairs(stand: Stand, names: tuple[str, ...]) -> dict[str, str]:
    """Columns of `simulate` by names of variables: coordinates of the freedoms, which q and orientation name."""
    found = {f"q.{each.split()[1]}": each for each in names if each.startswith("q ")}
    letters = [each for each in names if each.startswith("orientation_")]
    return found | {f"q.orientation[{i + 1}]": each for i, each in enumerate(letters)}


def written(stand: Stand, state: State, folder: Path, kind: Kind = "cs") -> str:
    """The path of an FMU."""
    file = folder / "held.fmu"
    file.write_bytes(export_fmu(stand, "3.0", kind, "torque", dt=DT, start=state).content)
    return str(file)


@pytest.mark.slow
def test_an_angle_counts_its_turns_also_within_a_communication_step(tmp_path: Path) -> None:
    """25 rad/s is two turns in half a second, and back again after the sign of the speed is changed."""
    stand = loads(OTHERS["hinge"])
    assert stand.hold is not None
    for speed in (25.0, -25.0):
        state = replace(rest_state(stand), u=(speed,), V=twist_of(stand.hold, (speed,)))
        state = complete_start(stand, state, {"u"})
        regime = loads_regime("schema = 1\n[flywheel.w1]\ntorque = 0.02", stand, 1.0)
        expected = simulate(Case(stand, regime, state, 1.0, 0.5, DT))
        fine = simulate(Case(stand, regime, state, 1.0, 0.01, DT))["q 1 [rad]"]
        found = fmpy.simulate_fmu(
            written(stand, state, tmp_path),
            stop_time=1.0, output_interval=0.5, start_values={"w1.tau": 0.02}, output=["q[1]", "u[1]"],
        )  # fmt: skip
        assert found["q[1]"] == pytest.approx(fine[[0, 50, 100]], abs=1e-8)
        assert found["u[1]"] == pytest.approx(expected["q_dot 1 [rad/s]"], abs=1e-8)
        assert abs(found["q[1]"][-1]) > 2 * math.pi


@pytest.mark.slow
def test_of_model_exchange_an_angle_is_within_half_a_turn(tmp_path: Path) -> None:
    stand, state = moving("pendulum")
    described = fmpy.read_model_description(written(stand, state, tmp_path, "me"))
    (angle,) = (v for v in described.modelVariables if v.name == "q.pitch")
    assert "within half a turn" in angle.description


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "units"),
    [
        ("pendulum", {"q.pitch": "rad", "u.pitch": "rad/s"}),
        ("plane", {"q.yaw": "rad", "q.x": "m", "q.y": "m", "u.yaw": "rad/s", "u.x": "m/s", "u.y": "m/s"}),
        ("ball joint", {f"u.{way}": "rad/s" for way in ("roll", "pitch", "yaw")}),
        ("clamped", {}),
        ("shaker", {"q[1]": "m", "u[1]": "m/s"}),
        ("hinge", {"q[1]": "rad", "u[1]": "rad/s"}),
        ("basis", {}),
    ],
)
@pytest.mark.parametrize("version", ["2.0", "3.0"])
def test_coordinates_have_units_of_their_freedoms(
    name: str, units: dict[str, str], version: str, tmp_path: Path
) -> None:
    stand = moving(name)[0] if name in HOLDS else loads(OTHERS[name])
    file = tmp_path / "held.fmu"
    file.write_bytes(export_fmu(stand, version, "cs", "torque", dt=DT, start=home(stand), binary=False).content)
    described = fmpy.read_model_description(str(file), validate=True).modelVariables
    own = {v.name: v.unit or (v.declaredType.unit if v.declaredType else None) for v in described}
    found = {each: unit for each, unit in own.items() if each[:2] in ("q.", "q[", "u.", "u[")}
    orientation = {f"q.orientation[{i}]" for i in range(1, 5)} if name == "ball joint" else set()
    assert found.keys() == units.keys() | orientation
    assert {each: found[each] for each in units} == units


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "given", "message"),
    [
        ("pendulum", {"carrier.V[1]": 1.0}, r"carrier.V: found [0-9.]+ m/s along x, which the hold blocks"),
        ("pendulum", {"carrier.position[3]": 0.1}, r"off by 0.1 m along z, which the hold blocks"),
        ("pendulum", {"carrier.attitude[1]": math.cos(0.1), "carrier.attitude[2]": math.sin(0.1)}, "which the hold"),
        ("shaker", {"carrier.attitude[1]": 0.8, "carrier.attitude[2]": 0.6}, r"off by 1.2 rad along roll"),
        ("clamped", {"carrier.V[6]": 1.0}, r"carrier.V: found 1 rad/s along yaw"),
        ("basis", {"carrier.V[2]": 1.0}, r"carrier.V: found 1 m/s along y"),
    ],
)
def test_a_start_that_the_hold_blocks_is_refused(
    name: str, given: dict[str, float], message: str, tmp_path: Path
) -> None:
    with refused_start(name, given, tmp_path) as log:
        assert any(re.search(message, line) for line in log), log


@contextmanager
def refused_start(name: str, given: dict[str, float], folder: Path) -> Iterator[list[str]]:
    """Lines that an FMU logs while it refuses a start."""
    file, log = folder / "held.fmu", list[str]()
    stand = moving(name)[0] if name in HOLDS else loads(OTHERS[name])
    file.write_bytes(export_fmu(stand, "3.0", "cs", "torque", dt=DT, start=home(stand)).content)
    with pytest.raises(FMICallException):
        fmpy.simulate_fmu(
            str(file), stop_time=0.01, start_values=given, logger=lambda *line: log.append(line[-1].decode())
        )
    yield log


def test_starts_that_the_hold_allows_are_taken(tmp_path: Path) -> None:
    stand, state = moving("pendulum")
    assert stand.hold is not None
    file, C = tmp_path / "held.fmu", Rotation.from_rotvec([0, 0.7, 0])
    file.write_bytes(export_fmu(stand, "3.0", "cs", "torque", dt=DT, start=state).content)
    P = np.array(stand.hold.pivot)
    position = P - C.apply(P) + np.array(stand.hold.position)
    given = {f"carrier.position[{i + 1}]": x for i, x in enumerate(position.tolist())}
    given |= {"carrier.attitude[1]": math.cos(0.35), "carrier.attitude[3]": math.sin(0.35)}
    found = fmpy.simulate_fmu(str(file), stop_time=0.01, start_values=given, output=["carrier.attitude[3]"])
    assert found["carrier.attitude[3]"][0] == pytest.approx(math.sin(0.35))


def test_the_command_writes_it_and_its_numbers_are_not_those_of_the_hold(tmp_path: Path) -> None:
    (tmp_path / "pendulum.toml").write_text(TEXT)
    target = tmp_path / "pendulum.fmu"
    done = run("export", "fmu", str(tmp_path / "pendulum.toml"), "--no-binary", "-o", str(target))
    assert done.exit_code == 0, done.output
    names = [v.name for v in fmpy.read_model_description(str(target)).modelVariables]
    assert "hold.reaction[6]" in names and "gravity[3]" in names
    assert not any(name.startswith(("S[", "pivot", "sliding", "home_")) for name in names)


FRICTION = {
    "slide": {"viscous": "N.s/m", "coulomb": "N", "breakaway": "N", "stribeck_speed": "m/s", "smoothing": "m/s"},
    "turn": {
        "viscous": "N.m.s/rad", "coulomb": "N.m", "breakaway": "N.m", "stribeck_speed": "rad/s", "smoothing": "rad/s"
    },
    "twist": {"viscous": "J.s", "coulomb": "J", "breakaway": "J", "stribeck_speed": "1/s", "smoothing": "1/s"},
}  # fmt: skip
STOP = {
    "slide": {"at": "m", "stiffness": "N/m", "damping": "N.s/m2"},
    "turn": {"at": "rad", "stiffness": "N.m/rad", "damping": "N.m.s/rad2"},
}


def resisted(hold: str, freedom: str = "", stops: bool = True) -> Stand:
    """A stand of HOLDS or OTHERS with friction, and stops, of one freedom."""
    text = TEXT.replace('["pitch"]', HOLDS[hold][0]) if hold in HOLDS else OTHERS[hold]
    own = f'freedom = "{freedom}"\n' if freedom else ""
    tables = f"[[hold.friction]]\n{own}viscous = 0.02\ncoulomb = 0.05\nbreakaway = 0.1\nstribeck_speed = 0.2\n"
    if stops:
        tables += f'[[hold.stop]]\n{own}at = 0.15\nside = "above"\nstiffness = 50\ndamping = 20\n'
        tables += f'[[hold.stop]]\n{own}at = -0.1\nside = "below"\nstiffness = 50\ndamping = 20\n'
    return loads(f"{text}\n{tables}")


@pytest.mark.slow
@pytest.mark.parametrize("version", ["2.0", "3.0"])
@pytest.mark.parametrize(
    ("hold", "freedom", "kind"),
    [("pendulum", "", "turn"), ("plane", "yaw", "turn"), ("shaker", "", "slide"),
     ("hinge", "", "turn"), ("basis", "2", "twist")],
)  # fmt: skip
def test_friction_and_stops_are_parameters_in_the_units_of_their_freedom(
    hold: str, freedom: str, kind: str, version: str, tmp_path: Path
) -> None:
    """None of them is a number that follows from the hold, such as the direction."""
    stand, file = resisted(hold, freedom, stops=kind != "twist"), tmp_path / "held.fmu"
    file.write_bytes(export_fmu(stand, version, "cs", "torque", dt=DT, start=home(stand), binary=False).content)
    described = fmpy.read_model_description(str(file), validate=True).modelVariables
    found = {
        v.name: v.unit or v.declaredType.unit for v in described if v.name.startswith(("friction", "turn_", "sli"))
    }
    wanted = {f"friction[1].{key}": unit for key, unit in FRICTION[kind].items()}
    for k in (1, 2):
        wanted |= {f"{kind}_stop[{k}].{key}": unit for key, unit in STOP.get(kind, {}).items()}
    assert wanted == found


@pytest.mark.slow
@pytest.mark.parametrize(("hold", "freedom"), [("pendulum", ""), ("shaker", ""), ("basis", "2")])
@pytest.mark.parametrize(("version", "kind"), [("2.0", "cs"), ("3.0", "me")])
def test_friction_and_stops_act_as_simulate_has_them(
    hold: str, freedom: str, version: str, kind: Kind, tmp_path: Path
) -> None:
    stand = resisted(hold, freedom, stops=hold != "basis")
    assert stand.hold is not None
    u = (1.5,) * len(stand.hold.freedoms)
    state = replace(rest_state(stand), u=u, V=twist_of(stand.hold, u))
    state = complete_start(stand, state, {"u"})
    regime = loads_regime("schema = 1\n[flywheel.w1]\ntorque = 0.02", stand, 0.6)
    step = DT if kind == "cs" else DT / 10  # a stop is a kink, where a step of a fixed length errs most
    expected = simulate(Case(stand, regime, state, 0.6, 0.05, step), mounts=True)
    file = tmp_path / "held.fmu"
    file.write_bytes(export_fmu(stand, version, kind, "torque", dt=DT, start=state).content)
    columns = pairs(stand, "torque")
    given = {"w1.tau": 0.02}
    free, found = (
        fmpy.simulate_fmu(
            str(file), stop_time=0.6, output_interval=0.05, relative_tolerance=1e-9, output=list(columns),
            start_values=given | changed,
        )
        for changed in ({"friction[1].viscous": 2.0}, {})
    )  # fmt: skip
    most, apart = 1e-9 if kind == "cs" else 1e-5, 0.0
    for variable, column in columns.items():
        scale = max(1.0, float(np.abs(expected[column]).max()))
        assert found[variable] == pytest.approx(expected[column], abs=most * scale), variable
        apart = max(apart, float(np.abs(free[variable] - expected[column]).max()) / scale)
    assert apart > 1e-3  # the parameter reaches the law
