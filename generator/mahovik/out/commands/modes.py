"""`modes`: natural frequencies, damping and shapes of small motions, their linear model, and the Campbell diagram."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from mahovik.contract.quantities import RPM
from mahovik.errors import CheckError, UsageError
from mahovik.nearest import names_in
from mahovik.out.arguments import FileGiven, Names, StandGiven, Turning, command
from mahovik.out.notices import rest_to_start
from mahovik.out.plots import Line, Panel, stems
from mahovik.out.result import Result, column, columns_of

if TYPE_CHECKING:
    from mahovik.core.stand.model import State
    from mahovik.out.api.stands import Stand
    from mahovik.out.api.states import States
    from mahovik.use.vibration.plant import Campbell

STATE_KEYS = ("id", "position", "angles", "quaternion", "V", "u", "phi", "phi_dot", "phi_ddot", "wrench")
"""Keys of a state as `eval` reads it; V* and the drive torques follow from them."""


@command(needs={"speed": ("steps",)}, excludes={"speed": ("start", "flywheels", "at")})
def modes(
    stand: StandGiven,
    *,
    start: FileGiven | States = "rest",
    flywheels: Literal["locked", "free"] = "locked",
    at: Names | None = None,
    speed: Turning | None = None,
    steps: int = 121,
) -> Result:
    """Find natural frequencies, damping and shapes.

    Small motions about rest or a state, by exact derivatives: x' = A x + B u, y = C x + D u. A shape is a motion of the
    carrier (O1 along the axes of E1, rotations about them) and of free flywheels; its largest number is 1, in m or
    rad. Free directions come first, without a frequency. JSON has A, B, C, D with the names and units
    of states (pose, V, angles and speeds of free flywheels), inputs (their drive torques, a wrench on the carrier) and
    outputs (displacement, velocity and acceleration of points).

    With --speed the flywheels turn: natural frequencies against a speed that is swept, means over a turn, and where
    order 1, of asymmetric flywheels also order 2, meets one. `-o FILE.svg` is the Campbell diagram.

    Args:
        stand: the stand file.
        start: linearise about this state, as `eval` reads it.
        flywheels: keep flywheels locked to their motion, as a stiff servo does, or free, driven by torques.
        at: points and instruments of the outputs; default all, else the carrier.
        speed: speed of a flywheel, rad/s or with a unit; one range, LOW..HIGH, is swept; FACTOR*NAME is geared to
            another; `all` is every flywheel. The rest stand still.
        steps: speeds of the sweep, evenly spaced.

    Raises:
        UsageError: a state that cannot be, an unknown point or flywheel.
        CheckError: there is no rest pose.
    """
    from mahovik.core.stand.hold import numbers_in_words
    from mahovik.core.stand.structure import identities
    from mahovik.out.api.stands import Stand
    from mahovik.proof.verify.states import state_object
    from mahovik.use.numeric.frame import uniform_stream
    from mahovik.use.study.linear import linear_model, shape_words
    from mahovik.use.study.linear import modes as modes_of

    machine = Stand.of(stand)
    if speed is not None:
        return _campbell(machine, speed, steps)
    uniform_stream(machine)
    names = None if at is None else list(names_in("at", at))
    if names is None and not (machine.points or machine.instruments):
        names = ["carrier"]
    model = linear_model(machine, _nominal(machine, start), names, locked=flywheels == "locked")
    result = modes_of(model)
    modes = result.modes
    where = start if isinstance(start, str) else "a state"
    messages = []
    if any(mode.kind == "free" for mode in modes):
        messages.append("without a frequency: a free direction, no restoring force")
    if not model.steady:
        messages.append(
            "valid for one moment: the carrier or a flywheel accelerates here, so growth does not show stability"
        )
    elif result.unstable:
        messages.append("warning: unstable, a mode with negative damping grows")
    if words := numbers_in_words(machine.hold, "q_"):
        messages.append(words)
    coordinates = list(map(str, result.coordinates))
    channels = {"states": model.states, "inputs": model.inputs, "outputs": model.outputs}
    matrices = {"A": model.A, "B": model.B, "C": model.C, "D": model.D}
    return Result(
        f"modes of {machine.name} at {where}, flywheels {flywheels}",
        (
            column("kind", "", [mode.kind for mode in modes]),
            column("frequency", "Hz", [np.nan if mode.kind == "free" else mode.frequency for mode in modes]),
            column("damping", "", [np.nan if mode.kind == "free" else mode.damping for mode in modes]),
            column("motion", "", [shape_words(result, mode.shape) for mode in modes]),
            column("damped_frequency", "Hz", [mode.damped_frequency for mode in modes]),
            column("eigenvalue", "1/s", [mode.eigenvalue for mode in modes]),
            column("shape", "", np.array([mode.shape for mode in modes]), coordinates),
        ),
        rows="modes",
        meta={
            "stand": machine.name, "physics": identities(machine).physics, "at": where, "flywheels": flywheels,
            "state": state_object(model.state), "coordinates": coordinates, "zero_eigenvalues": result.zeros,
            "unstable": result.unstable, "steady": model.steady,
            **{name: [channel.name for channel in named] for name, named in channels.items()},
            **{f"{name[:-1]}_units": [channel.unit for channel in named] for name, named in channels.items()},
            "points": list(model.points),
            **matrices,
        },
        messages=messages,
        details=(
            "damped_frequency", "eigenvalue", "shape", "stand", "physics", "at", "flywheels", "state", "coordinates",
            "zero_eigenvalues", "unstable", "steady", *channels, *(f"{name[:-1]}_units" for name in channels),
            "points", *matrices,
        ),
        drawings=_pictures(result),
    )  # fmt: skip


def _nominal(stand: Stand, start: Any) -> State:
    """The state to linearise about. Raises UsageError, CheckError."""
    from mahovik.out.api.states import state_of
    from mahovik.use.simulate.held import allowed_start

    if not isinstance(start, str) or start != "rest":
        return allowed_start(stand, state_of("start", start, stand, STATE_KEYS, "; V_dot and tau follow from them"))
    try:
        return rest_to_start(stand)
    except CheckError as error:
        raise CheckError(f"{error}; give a state by start=STATE.json") from None


def _pictures(result: Any) -> tuple[Panel, Panel]:
    """Damping ratio of each mode over its frequency; eigenvalues in the complex plane."""
    modes = result.modes
    swinging = [(k, mode) for k, mode in enumerate(modes, start=1) if mode.frequency > 0.0 and mode.kind != "free"]
    lines = [stems(f"mode {k}", [mode.frequency], np.array([mode.damping]), k - 1) for k, mode in swinging]
    marks = tuple((mode.eigenvalue.real, mode.eigenvalue.imag) for mode in modes)
    return (
        Panel("damping ratio of the modes", tuple(lines), abscissa="frequency, Hz"),
        Panel("eigenvalues, imaginary part, 1/s", (), abscissa="real part, 1/s", marks=marks),
    )


def _campbell(stand: Stand, speed: Any, steps: int) -> Result:
    """Natural frequencies and damping over a swept speed, and where orders meet them. Raises UsageError, CheckError."""
    from mahovik.use.vibration.plant import Scene, campbell
    from mahovik.use.vibration.speeds import read_speeds

    plan = read_speeds(stand, speed)
    if plan.sweep is None:
        raise UsageError("speed: none is swept, expected a range of one, NAME=LOW..HIGH or all=LOW..HIGH")
    result = campbell(Scene.of(stand), plan, np.array(plan.values(steps)))
    absent = int((~np.isfinite(result.natural).any(axis=0)).sum())  # the first columns, which are nowhere
    modes = [str(k) for k in range(1, result.natural.shape[1] - absent + 1)]
    units = {"order": "", "mode": "", "speed": "rad/s", "frequency": "Hz", "damping": ""}
    met = [vars(crossing) | {"mode": crossing.mode - absent} for crossing in result.crossings]
    crossings = columns_of(met, units, shown={"speed": "rpm"})
    growing = np.flatnonzero(result.growth > 0.0)
    messages = []
    if len(growing):
        messages.append(f"warning: unstable from {RPM * result.speed[growing[0]]:.6g} rpm: small motions grow")
    return Result(
        f"natural frequencies of {stand.name} over the {plan.words}",
        (
            column("speed", "rad/s", result.speed, shown="rpm"),
            column("frequency", "Hz", result.natural[:, absent:], modes),
            column("damping", "", result.damping[:, absent:], modes),
            column("growth", "1/s", result.growth),
        ),
        index="speed",
        meta={"orders": list(result.orders), "crossings": Result("orders meet modes", crossings)},
        messages=messages,
        details=("damping", "growth"),
        drawings=(_diagram(result, absent, plan.words),),
    )


def _diagram(campbell: Campbell, absent: int, words: str) -> Panel:
    """Natural frequencies over a speed in words, orders of the flywheels, dots where they meet."""
    speed, top = RPM * campbell.speed, 1.15 * (float(np.nanmax(np.nan_to_num(campbell.natural))) or 1.0)
    ends = speed[[0, -1]]
    columns = range(absent, campbell.natural.shape[1])
    lines = [Line(f"mode {k - absent + 1}", speed, campbell.natural[:, k], k - absent) for k in columns]
    for n in campbell.orders:
        x = np.clip([ends[0], np.clip(0.0, *ends), ends[1]], -60.0 * top / n, 60.0 * top / n)  # a corner at rest
        seen = np.ptp(x) > 0.15 * np.ptp(ends)
        lines.append(Line("", x, np.abs(n * x / 60.0), None, dashed=True, tag=f"{n}×" * bool(seen)))
    return Panel(
        "natural frequency, Hz", tuple(lines), abscissa=f"{words}, rpm",
        height=1.6, top=top, span=(float(ends[0]), float(ends[1])),
        marks=tuple((RPM * crossing.speed, crossing.frequency) for crossing in campbell.crossings),
        note="dashed: orders " + ", ".join(f"{n}×" for n in campbell.orders),
    )  # fmt: skip
