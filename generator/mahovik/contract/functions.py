"""Public functions of a stand's C, one row each: what a function takes and gives, and who offers and judges it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

NORMAL, ANY, BITS = "normal", "any", "bits"
"""Sets of inputs under Frama-C Eva: ordinary magnitudes; any finite numbers; any bits, NaN and infinity among them."""

JUDGES = {
    "reference": "the literal reference of (1)-(13), in NumPy",
    "second": "the second derivation, by Lagrange's equations, in CasADi",
    "rigorous": "enclosures of the exact answer, in ball arithmetic",
    "trajectory": "an integrator of high order over the literal reference",
    "derivatives": "automatic differentiation of the second derivation",
    "allocation": "least squares with weights and damping, literally, and SciPy's with limits",
    "exact": "exact integers and many digits",
    "parameters": "the literal reference on stands with other masses, inertias and mountings",
}
"""Independent checks of a function, by name."""

REFEREES = ("reference", "second", "rigorous")
"""Judges that can answer a want of `eval`."""


SECTIONS = {
    **dict.fromkeys(("torque", "mounts", "prepare_mounts"), "Drive torque"),
    **dict.fromkeys(("coupled", "coupled_jacobian"), "The whole system"),
    **dict.fromkeys(("step", "step_driven"), "Steps in time"),
    "wrap": "Phases from encoders",
    "points": "Points",
    "quaternion": "Generalized coordinates, (10)-(11)",
    "torque_for": "Torques for a task",
}
"""Headings of docs/model.md or docs/c-interface.md with the equations of functions that have no number."""


@dataclass(frozen=True)
class PublicFunction:
    """A row of the contract: one public function.

    equation  numbers of the paper, else the heading of docs/model.md or docs/c-interface.md under which it stands
    takes     arguments in order; those that a stand does not need are left out
    gives     results, by name
    want      whether `eval` answers it, by the name of the function
    needs     parts that a stand must have: "flywheels", "sensors" (instruments or points), "tasks", "held",
              "unbalances" (flywheels of a free carrier); or nothing
    tasks     whether each task of the stand has a form of its own, `NAME_TASK`, with its demand in place of V_dot
    batch     whether it has a batch, many states in a register; others run state by state
    python    whether a model has a method of its name
    claimed   sets of inputs on which Frama-C Eva must raise no alarm; on the others it is only run
    unread    a real among the arguments that may be NaN or infinite in a call that succeeds; see the fuzz harness
    judges    its independent checks, by name of JUDGES
    ignores   arguments, or members of them, that it does not look at, or that change no more than a bit of the status
    """

    name: str
    equation: str
    takes: tuple[str, ...]
    gives: tuple[str, ...]
    judges: tuple[str, ...]
    want: bool = False
    needs: str = ""
    tasks: bool = False
    batch: bool = False
    python: bool = True
    claimed: tuple[str, ...] = ()
    unread: str = ""
    ignores: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        """Raises ValueError for a want without a referee, and for a judge that is unknown."""
        if not self.judges or not set(self.judges) <= set(JUDGES):
            raise ValueError(f"{self.name}: expected judges among {', '.join(JUDGES)}, found {self.judges}")
        if self.want and not set(self.judges) & set(REFEREES):
            raise ValueError(f"{self.name}: a want needs a judge among {', '.join(REFEREES)}")


_STATE = ("table", "x")
TURNS = ("sine", "cosine")
"""Arguments of functions of a stand with `phase_input = "sincos"`; a caller may pass null for both."""

_ALL_JUDGES = ("reference", "second", "rigorous")
_FOR_TORQUES = ("motor_power", "target_speed", "target_rate", "avoid_speed")
"""Members of the options that only `torque_for` looks at."""

_MOTOR = ("motor_torque", "motor_speed", "motor_curve_speed", "motor_curve_torque")
_FRICTION = ("motor_viscous", "motor_coulomb", "motor_coulomb_speed")
"""Members of the options that only EXCESSIVE looks at."""

_ROWS: tuple[PublicFunction, ...] = (
    PublicFunction(
        "matrices",
        "(2), (6)-(9)",
        (*_STATE, "wrench"),
        ("K", "K_dot", "M", "I", "J", "F"),
        ("reference", "rigorous"),
        want=True,
        batch=True,
    ),
    PublicFunction(
        "momentum",
        "(1), (2)",
        _STATE,
        ("Z", "Z0", "energy", "center_of_mass", "center_of_mass_velocity"),
        _ALL_JUDGES,
        want=True,
        claimed=(NORMAL, ANY),
    ),
    PublicFunction(
        "forward",
        "(8)",
        (*_STATE, *TURNS, "phi_ddot", "wrench"),
        ("V_dot",),
        _ALL_JUDGES,
        want=True,
        batch=True,
        claimed=(NORMAL, ANY, BITS),
    ),
    PublicFunction(
        "torque",
        "",
        (*_STATE, *TURNS, "V_dot", "phi_ddot", "wrench"),
        ("tau",),
        _ALL_JUDGES,
        want=True,
        needs="flywheels",
        batch=True,
        claimed=(NORMAL, ANY),
    ),
    PublicFunction(
        "mounts",
        "",
        ("table", "mounting", "x", "V_dot", "phi_ddot", "wrench"),
        ("mount_wrench",),
        ("reference", "rigorous"),
        want=True,
        needs="flywheels",
        batch=True,
    ),
    PublicFunction(
        "coupled",
        "",
        (*_STATE, *TURNS, "tau", "locked", "wrench"),
        ("V_dot", "phi_ddot"),
        _ALL_JUDGES,
        want=True,
        needs="flywheels",
        batch=True,
        claimed=(NORMAL, ANY),
    ),
    PublicFunction(
        "inverse",
        "(12)",
        (*_STATE, "V_dot", "options", "wrench"),
        ("phi_ddot", "residual", "sigma", "rank", "status", "damped_by", "limited", "hardest"),
        ("reference",),
        want=True,
        tasks=True,
        batch=True,
        unread="infinity, which is no limit at all",
        ignores=_FOR_TORQUES,
    ),
    PublicFunction(
        "generalized",
        "(10), (11)",
        (*_STATE, "angles", "phi_ddot", "wrench"),
        ("A", "D", "I0", "J0", "q", "orientation", "q_dot", "q_ddot"),
        ("reference", "second"),
        want=True,
        unread="the attitude of its state",
        ignores=("attitude",),
    ),
    PublicFunction(
        "points", "", (*_STATE, "V_dot"), ("points",), ("reference", "second"), want=True, needs="sensors", batch=True
    ),
    PublicFunction(
        "reaction",
        "(8)",
        (*_STATE, "V_dot", "phi_ddot", "wrench"),
        ("reaction",),
        _ALL_JUDGES,
        want=True,
        needs="held",
        batch=True,
    ),
    PublicFunction(
        "step",
        "",
        (*_STATE, "tau", "locked", "wrench", "dt", "order", "carry"),
        ("carry", "next"),
        ("trajectory",),
        needs="flywheels",
        batch=True,
        claimed=(BITS,),
    ),
    PublicFunction(
        "step_driven",
        "",
        (*_STATE, "phi_ddot", "wrench", "dt", "order", "carry"),
        ("carry", "next"),
        ("trajectory",),
        batch=True,
    ),
    PublicFunction(
        "inverse_fast",
        "(12)",
        (*_STATE, *TURNS, "V_dot", "options", "wrench"),
        ("phi_ddot",),
        ("allocation",),
        needs="flywheels",
        tasks=True,
        python=False,
        unread="near_singular and limits",
        ignores=("near_singular", "limit", "most", *_MOTOR, *_FRICTION, *_FOR_TORQUES),
    ),
    PublicFunction(
        "torque_for",
        "",
        (*_STATE, "demand", "options", "locked", "wrench"),
        ("tau", "phi_ddot", "V_dot", "residual", "share", "limited"),
        ("reference", "allocation"),
        want=True,
        needs="tasks",
        tasks=True,
        unread="infinity, which is no limit at all",
        ignores=("near_singular", "limit", "most", "damping", *_FRICTION),
    ),
    PublicFunction(
        "forward_jacobian",
        "(8)",
        (*_STATE, "phi_ddot", "wrench"),
        ("V_dot_V", "V_dot_phi", "V_dot_phi_dot", "V_dot_phi_ddot"),
        ("derivatives",),
    ),
    PublicFunction(
        "coupled_jacobian",
        "",
        (*_STATE, "tau", "locked", "wrench"),
        (
            "V_dot_V",
            "V_dot_phi",
            "V_dot_phi_dot",
            "V_dot_tau",
            "phi_ddot_V",
            "phi_ddot_phi",
            "phi_ddot_phi_dot",
            "phi_ddot_tau",
        ),
        ("derivatives",),
        needs="flywheels",
    ),
    PublicFunction("quaternion", "", ("angles",), ("attitude",), ("reference",)),
    PublicFunction(
        "state_from_coordinates",
        "(10)",
        ("table", "position", "angles", "q", "orientation", "q_dot", "q_ddot", "x"),
        ("x", "V_dot"),
        ("reference",),
        python=False,
        unread="what its state holds before",
        ignores=("x",),
    ),
    PublicFunction(
        "wrap",
        "",
        ("phi",),
        ("wrapped",),
        ("exact",),
        needs="flywheels",
        python=False,
        claimed=(NORMAL, ANY, BITS),
    ),
    PublicFunction(
        "prepare",
        "(2)",
        ("parameters", "table"),
        ("parameters",),
        ("parameters",),
        python=False,
        claimed=(NORMAL, BITS),
    ),
    PublicFunction(
        "prepare_mounts", "", ("parameters",), ("mounting",), ("parameters",), needs="flywheels", python=False
    ),
)
_ROWS = tuple(replace(row, equation=row.equation or SECTIONS[row.name]) for row in _ROWS)
"""At extreme inputs, numbers inside `step` and `prepare` may overflow and are then refused: Eva's claim is for `bits`,
where this is no alarm. Intervals grow over the stages of a step, too wide to show more for most stands."""


_CHOSEN = (
    PublicFunction(
        "regressor",
        "Regressor",
        ("table", "mounting", "x", "V_dot", "phi_ddot"),
        ("Y_carrier", "Y_flywheel", "Y_drive", "Y_added_mass", "Y_linear", "Y_quadratic"),
        ("reference",),
        python=False,
    ),
    PublicFunction(
        "identify_step",
        "Regressor",
        ("table", "mounting", "x", "V_dot", "phi_ddot", "wrench", "noise", "forget", "estimate"),
        ("estimate",),
        ("reference",),
        needs="unbalances",
        python=False,
    ),
)

CHOSEN = {row.name: row for row in _CHOSEN}
"""Rows of the functions that are in the C only where they are named, or with ALL, so that other stands do not pay."""

FUNCTIONS = {row.name: row for row in _ROWS if row.needs != "tasks"}
"""Rows by name; a program contains those that its stand needs."""

OF_TASKS = {row.name: row for row in _ROWS if row.needs == "tasks"}
"""Rows of functions that tasks alone have."""

WANTS = tuple(row.name for row in FUNCTIONS.values() if row.want)
"""Every want of `eval` that a state without a task may have, in the order of the evaluation contract."""

TASK_WANTS = tuple(row.name for row in OF_TASKS.values() if row.want)
"""Wants of states with a task alone."""

ALL_WANTS = (*WANTS, *TASK_WANTS)
"""Every want of `eval`."""

ROWS = FUNCTIONS | OF_TASKS
"""Rows by name, but for those of CHOSEN; of tasks, under the names without that of the task."""

BATCH_FUNCTIONS = tuple(row.name for row in FUNCTIONS.values() if row.batch)
"""Functions with a batch form."""

_GIVES = {name: row.gives for name, row in ROWS.items() if row.want}
_GIVES |= {name: (*_GIVES[name], "reaction") for name in ("forward", "coupled")}  # of held carriers


def _common_names(first: str, second: str) -> tuple[str, ...]:
    """The first name to which two wants give a value each; none where they share no name."""
    return tuple(name for name in _GIVES[first] if name in _GIVES[second])[:1]


CONFLICTS = tuple(
    (first, second, name)
    for i, first in enumerate(_GIVES)
    for second in tuple(_GIVES)[i + 1 :]
    for name in _common_names(first, second)
)
"""Pairs of wants that give two values to one name, and the name."""

TASK_TAKERS = tuple(name for name in WANTS if "V_dot" in FUNCTIONS[name].takes and name != "inverse")
"""Wants that take the motion which results of a state's task, in place of its V_dot and phi_ddot."""

TASK_CONFLICTS = tuple(name for name in WANTS if "V_dot" in FUNCTIONS[name].gives)
"""Wants that give another motion than the task of a state."""


def wants_of(referee: str) -> tuple[str, ...]:
    """Wants that a referee can answer, in the order of the evaluation contract."""
    return tuple(name for name in WANTS if referee in FUNCTIONS[name].judges)


def want_fault(want: Sequence[str]) -> str:
    """A line on a fault of a list of wants: empty, a name that is unknown, two values of one name; "" where none is."""
    if not want:
        return f"want: empty, expected at least one of {', '.join(WANTS)}"
    for name in want:
        if name not in ALL_WANTS:
            return f'want: unknown "{name}", expected one of {", ".join(ALL_WANTS)}'
    for first, second, value in CONFLICTS:
        if first in want and second in want:
            return f'want: "{first}" and "{second}" both give {value}, ask for them in two states'
    return ""


def wants_of_carrier(held: bool) -> tuple[str, ...]:
    """Wants without a task of a free or a held carrier, in the order of the evaluation contract."""
    return tuple(name for name in WANTS if held or FUNCTIONS[name].needs != "held")


def hold_fault(want: Sequence[str], held: bool) -> str:
    """A line on the first want that only held carriers have, of a carrier that is free; "" where there is none."""
    for name in want:
        if name in WANTS and name not in wants_of_carrier(held):
            return f'want: "{name}" is of held carriers, and the stand has no [hold]: ask for forward'
    return ""


def inverse_fault(freedoms: int, flywheels: int) -> str:
    """Why a held carrier with these numbers of freedoms and flywheels has no `inverse`; "" where it has one."""
    if not freedoms:
        return 'no "inverse" of a hold that clamps the carrier, ask for forward'
    return "" if flywheels else 'no "inverse" of a held carrier without flywheels, ask for forward'


def task_of(function: str) -> str:
    """Name of the task that a public function belongs to, by its name; "" of a function of no task.

    No task has a name that would make that of another function.
    """
    if function in FUNCTIONS or function in CHOSEN:
        return ""
    for row in reversed([row for row in _ROWS if row.tasks]):  # the longer names first
        if function.startswith(f"{row.name}_"):
            return function.removeprefix(f"{row.name}_")
    return ""


DEFAULT = ("forward", "torque", "coupled", "inverse", "inverse_fast", "momentum", "step", "prepare")
"""Functions that `generate` writes unless others are asked for."""

ALL = ("all",)
"""In place of names: every public function that a stand has."""


def is_default(function: str) -> bool:
    """Whether `generate` writes a public function unless others are asked for: of tasks their `inverse`."""
    return function in DEFAULT or function == f"inverse_{task_of(function)}"


def is_public(name: str) -> bool:
    """Whether some stand has a public function of this name."""
    return name in FUNCTIONS or name in CHOSEN or bool(task_of(name))


def row_of(function: str) -> PublicFunction:
    """The row of a public function of a stand; for a task, of the function whose form it is. Raises KeyError."""
    task = task_of(function)
    if not task:
        return (FUNCTIONS | CHOSEN)[function]
    name = function.replace(f"_{task}", "", 1)
    row = ROWS[name]
    inverts = row.want and name in FUNCTIONS
    gives = ("phi_ddot", "V_dot", *row.gives[1:]) if inverts else row.gives
    return replace(
        row,
        name=function,
        equation="Tasks: chosen components" if name.startswith("inverse") else row.equation,
        takes=tuple("demand" if name == "V_dot" else name for name in row.takes),
        gives=gives,
        judges=("reference",) if inverts else row.judges,
        want=False,
    )
