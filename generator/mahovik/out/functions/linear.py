"""`modes`, `linearize`: small motions of a stand about rest or a state."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from mahovik.core.stand.state import State
from mahovik.errors import CheckError
from mahovik.out.api.fields import Array
from mahovik.out.api.stands import Stand
from mahovik.out.functions.equilibrium import rest_to_start
from mahovik.out.functions.given import Keys, StandGiven, state_of
from mahovik.out.functions.table import Column, Table, module
from mahovik.use.numeric import uniform_stream
from mahovik.use.simulate.held import allowed_start
from mahovik.use.study.linear import LinearModel as CoreModel
from mahovik.use.study.linear import Modes as CoreModes
from mahovik.use.study.linear import linear_model
from mahovik.use.study.linear import modes as modes_of

if TYPE_CHECKING:
    from mahovik.out.report.plot.panel import Panel

STATE_KEYS = ("id", "position", "angles", "quaternion", "V", "u", "phi", "phi_dot", "phi_ddot", "wrench")
"""Keys of a state as `eval` reads it; V* and the drive torques follow from them."""

At = State | Keys | str | Path | None


class Modes(Table):
    """Natural frequencies, damping ratios and shapes: a row per mode, free directions first."""

    def __init__(self, stand: Stand, result: CoreModes, steady: bool) -> None:
        self.stand, self.result, self.steady = stand, result, steady

    @property
    def columns(self) -> tuple[Column, ...]:
        modes = self.result.modes
        shapes = [
            Column(channel.name, channel.unit, self.shapes[:, i]) for i, channel in enumerate(self.result.coordinates)
        ]
        return (
            Column("kind", "", np.array([mode.kind for mode in modes], dtype=object)),
            Column("frequency", "Hz", self.frequency),
            Column("damping", "", self.damping),
            *shapes,
        )

    @property
    def frequency(self) -> Array:
        """Natural frequencies, Hz."""
        return np.array([mode.frequency for mode in self.result.modes])

    @property
    def damping(self) -> Array:
        """Damping ratios; negative: the mode grows."""
        return np.array([mode.damping for mode in self.result.modes])

    @property
    def eigenvalue(self) -> Array:
        """Eigenvalues, 1/s, complex."""
        return np.array([mode.eigenvalue for mode in self.result.modes])

    @property
    def shapes(self) -> Array:
        """(modes, coordinates), complex; the largest of a shape is 1."""
        return np.array([mode.shape for mode in self.result.modes]).reshape(-1, len(self.result.coordinates))

    @property
    def unstable(self) -> bool:
        """Whether some mode grows; where the state is not `steady` that shows nothing."""
        return self.result.unstable

    def _panels(self) -> Sequence[Panel]:
        from mahovik.out.report.plot.panel import Line, Panel

        found = [mode.frequency for mode in self.result.modes if mode.kind != "free"]
        span = (found[0] / 2, found[0] * 2) if len(set(found)) == 1 and found[0] > 0.0 else None
        lines: list[Line] = []
        for i, mode in enumerate(self.result.modes):
            if mode.kind != "free":
                height = np.array([0.0, max(abs(mode.damping), 1e-6)])
                lines.append(Line(f"mode {i + 1}", np.full(2, mode.frequency), height, len(lines)))
        quantity = "damping ratio of the modes"
        return [Panel(quantity, tuple(lines), abscissa="frequency, Hz", log_abscissa=True, span=span)]

    def __repr__(self) -> str:
        free = sum(mode.kind == "free" for mode in self.result.modes)
        swinging = [f"{f:.4g}" for f in self.frequency if f > 0.0]
        creeping = len(self.result.modes) - free - len(swinging)
        words = [f"{free} free"]
        words += [f"{creeping} that do not swing"] if creeping else []
        words += [", ".join(swinging) + " Hz"] if swinging else []
        return f"<Modes of {self.stand.name}: {', '.join(words)}>"


def modes(stand: StandGiven, at: At = None, *, locked: bool = True) -> Modes:
    """Find natural frequencies, damping and shapes of small motions about a state; `at` None: about rest.

    locked   flywheels keep their motion, as under a stiff servo; else they are free under constant torques

    Raises StandError, UsageError, CheckError where there is no equilibrium.
    """
    own = Stand.of(stand)
    uniform_stream(own)
    model = linear_model(own, _nominal(own, at), [], locked=locked)
    return Modes(own, modes_of(model), model.steady)


class LinearModel(Table):
    """x' = A x + B u, y = C x + D u of small deviations: the table has a row per state, with its row of A and B.

    `states`, `inputs`, `outputs` are names, `A`, `B`, `C`, `D` arrays, SI.
    """

    index = "state"

    def __init__(self, stand: Stand, result: CoreModel) -> None:
        self.stand, self.result = stand, result
        self.A, self.B, self.C, self.D = result.A, result.B, result.C, result.D

    @property
    def columns(self) -> tuple[Column, ...]:
        names = np.array([str(each) for each in self.result.states], dtype=object)
        channels = (*self.result.states, *self.result.inputs)
        whole = np.hstack([self.A, self.B])
        return (Column("state", "", names), *(Column(c.name, c.unit, whole[:, i]) for i, c in enumerate(channels)))

    @property
    def states(self) -> tuple[str, ...]:
        """Names of the states, with their units."""
        return tuple(str(each) for each in self.result.states)

    @property
    def inputs(self) -> tuple[str, ...]:
        """Names of the inputs, with their units."""
        return tuple(str(each) for each in self.result.inputs)

    @property
    def outputs(self) -> tuple[str, ...]:
        """Names of the outputs, with their units."""
        return tuple(str(each) for each in self.result.outputs)

    def to_xarray(self) -> Any:
        """A, B, C, D as an xarray.Dataset labelled by states, inputs and outputs."""
        rows = {"states": self.states, "inputs": self.inputs, "outputs": self.outputs}
        axes = {
            "A": ("states", "states_of"), "B": ("states", "inputs"),
            "C": ("outputs", "states_of"), "D": ("outputs", "inputs"),
        }  # fmt: skip
        coords = {name: list(labels) for name, labels in (rows | {"states_of": self.states}).items()}
        return module("xarray").Dataset({key: (dims, getattr(self, key)) for key, dims in axes.items()}, coords=coords)

    def save(self, path: str | Path) -> None:
        """Write the model to a file .json or .mat. Raises UsageError."""
        from mahovik.use.study.linear.model import check_model_file, model_file
        from mahovik.writing import write

        write(Path(path), model_file(self.result, check_model_file(Path(path))))

    def _panels(self) -> Sequence[Panel]:
        from mahovik.out.report.plot.panel import Line, Panel

        poles = np.linalg.eigvals(self.A)
        lines = []
        for i, pole in enumerate(sorted(poles, key=abs)):
            x, y = np.array([0.0, pole.real]), np.array([0.0, pole.imag])
            lines.append(Line("", x, y, i % 8))
        return [Panel("eigenvalues of A, imaginary part, 1/s", tuple(lines), abscissa="real part, 1/s")]

    def __repr__(self) -> str:
        sizes = f"{len(self.A)} states, {self.B.shape[1]} inputs, {len(self.C)} outputs"
        return f"<LinearModel of {self.stand.name}: {sizes}>"


def linearize(
    stand: StandGiven, at: At = None, *, points: Sequence[str] | None = None, locked: bool = False
) -> LinearModel:
    """Linearise a stand about a state by exact derivatives; `at` None: about rest.

    points   whose displacement, velocity and acceleration are the outputs; None: all, else the carrier
    locked   flywheels keep their motion; else they are driven by torques

    Raises StandError, UsageError, CheckError where there is no equilibrium.
    """
    own = Stand.of(stand)
    uniform_stream(own)
    names = None if points is None else list(points)
    if names is None and not (own.points or own.instruments):
        names = ["carrier"]
    return LinearModel(own, linear_model(own, _nominal(own, at), names, locked=locked))


def _nominal(stand: Stand, at: At) -> State:
    """The state to linearise about. Raises UsageError, CheckError."""
    if at is not None and at != "rest":
        return allowed_start(stand, state_of(at, stand, STATE_KEYS, "; V_dot and tau follow from them"))
    try:
        return rest_to_start(stand)
    except CheckError as error:
        raise CheckError(f"{error}; give a state by --at STATE.json") from None
