"""Public functions of a stand's C, one row each: what a function takes and gives, and who offers and judges it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

NORMAL, ANY, BITS = "normal", "any", "bits"
"""Sets of inputs under Frama-C Eva: ordinary magnitudes; any finite numbers; any bits, NaN and infinity among them."""

JUDGES = {
    "reference": "the literal reference of (1)-(13), in NumPy",
    "second": "the second derivation, by Lagrange's equations, in CasADi",
    "rigorous": "enclosures of the exact answer, in ball arithmetic",
    "trajectory": "an integrator of high order over the literal reference",
    "differences": "difference quotients of the function that is differentiated",
    "inverse": "the answer of `inverse` to the same state",
    "exact": "exact integers and many digits",
    "table": "the table that the generator makes of the same stand",
}
"""What a function is held to, by name."""

REFEREES = ("reference", "second", "rigorous")
"""Judges that answer a want."""


@dataclass(frozen=True)
class PublicFunction:
    """A row of the contract. A want has the name of its function.

    equation  numbers of the paper
    takes     arguments in order; a stand that has no use for one leaves it out
    gives     results by the names of the contract
    want      whether `eval` answers it, under the name of the function
    needs     what a stand must have: "flywheels", "sensors" (instruments or points), "wrenches" (any), or nothing
    sines     whether it has a form `NAME_at` that takes sines and cosines of the phases
    batched   whether it has a batch, many states in a register; others run state by state
    python    whether a model has a method of its name
    claimed   sets of inputs on which Frama-C Eva must raise no alarm; on the others it is only run
    unread    a real among the arguments that may be NaN or infinite in a call that succeeds; see the fuzz harness
    judges    what holds it, by name of JUDGES
    """

    name: str
    equation: str
    takes: tuple[str, ...]
    gives: tuple[str, ...]
    judges: tuple[str, ...]
    want: bool = False
    needs: str = ""
    sines: bool = False
    batched: bool = False
    python: bool = True
    claimed: tuple[str, ...] = ()
    unread: str = ""

    def __post_init__(self) -> None:
        """Raises ValueError for a want without a referee, and for a judge that is unknown."""
        if not self.judges or not set(self.judges) <= set(JUDGES):
            raise ValueError(f"{self.name}: expected judges among {', '.join(JUDGES)}, found {self.judges}")
        if self.want and not set(self.judges) & set(REFEREES):
            raise ValueError(f"{self.name}: a want needs a judge among {', '.join(REFEREES)}")


_STATE = ("table", "x")

_ROWS = (
    PublicFunction(
        "matrices",
        "(2), (6)-(9)",
        (*_STATE, "wrench"),
        ("K", "K_dot", "M", "I", "J", "F"),
        ("reference", "rigorous"),
        want=True,
    ),
    PublicFunction(
        "momentum",
        "(1), (2)",
        _STATE,
        ("Z", "Z0", "energy", "center_of_mass"),
        ("reference", "second", "rigorous"),
        want=True,
        claimed=(NORMAL, ANY),
    ),
    PublicFunction(
        "forward",
        "(8)",
        (*_STATE, "phi_ddot", "wrench"),
        ("V_dot",),
        ("reference", "second", "rigorous"),
        want=True,
        sines=True,
        batched=True,
        claimed=(NORMAL, ANY, BITS),
    ),
    PublicFunction(
        "torque",
        "",
        (*_STATE, "V_dot", "phi_ddot", "wrench"),
        ("tau",),
        ("reference", "second", "rigorous"),
        want=True,
        needs="flywheels",
        sines=True,
        batched=True,
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
    ),
    PublicFunction(
        "coupled",
        "",
        (*_STATE, "tau", "locked", "wrench"),
        ("V_dot", "phi_ddot"),
        ("reference", "second", "rigorous"),
        want=True,
        needs="flywheels",
        sines=True,
        batched=True,
        claimed=(NORMAL, ANY),
    ),
    PublicFunction(
        "inverse",
        "(12)",
        (*_STATE, "V_dot", "options", "wrench"),
        ("phi_ddot", "residual", "sigma", "rank", "status", "damped_by", "limited", "hardest"),
        ("reference",),
        want=True,
        needs="flywheels",
        unread="infinity, which is no limit at all",
    ),
    PublicFunction(
        "generalized",
        "(10), (11)",
        (*_STATE, "angles", "phi_ddot", "wrench"),
        ("A", "D", "I0", "J0", "q_dot", "q_ddot"),
        ("reference", "second"),
        want=True,
        unread="the attitude of its state",
    ),
    PublicFunction(
        "points",
        "",
        (*_STATE, "V_dot"),
        ("points",),
        ("reference", "second"),
        want=True,
        needs="sensors",
    ),
    PublicFunction("center_of_mass_velocity", "", _STATE, ("center_of_mass_velocity",), ("reference",), want=True),
    PublicFunction("wrench", "(7)", (*_STATE, "wrench"), ("F",), ("reference",), needs="wrenches"),
    PublicFunction(
        "step",
        "",
        (*_STATE, "tau", "locked", "wrench", "dt", "order"),
        ("next",),
        ("trajectory",),
        needs="flywheels",
        batched=True,
        claimed=(BITS,),
    ),
    PublicFunction("step_driven", "", (*_STATE, "phi_ddot", "wrench", "dt", "order"), ("next",), ("trajectory",)),
    PublicFunction(
        "inverse_fast",
        "(12)",
        (*_STATE, "V_dot", "options", "wrench"),
        ("phi_ddot",),
        ("inverse",),
        needs="flywheels",
        sines=True,
        python=False,
        unread="near and limits",
    ),
    PublicFunction(
        "forward_jacobian",
        "(8)",
        (*_STATE, "phi_ddot", "wrench"),
        ("V_dot_V", "V_dot_phi", "V_dot_phi_dot", "V_dot_phi_ddot"),
        ("differences",),
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
        ("differences",),
        needs="flywheels",
    ),
    PublicFunction("quaternion", "", ("angles",), ("attitude",), ("reference",)),
    PublicFunction(
        "state_from_coordinates",
        "(10)",
        ("position", "angles", "q_dot", "q_ddot", "x"),
        ("x", "V_dot"),
        ("reference",),
        python=False,
        unread="what its state holds before",
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
        "phase_of_counts", "", ("count", "per_turn", "zero"), ("phi",), ("exact",), needs="flywheels", python=False
    ),
    PublicFunction(
        "speed_of_counts", "", ("moved", "per_turn", "dt"), ("phi_dot",), ("exact",), needs="flywheels", python=False
    ),
    PublicFunction(
        "accumulate",
        "",
        ("encoder", "counter", "bits", "per_turn"),
        ("encoder",),
        ("exact",),
        needs="flywheels",
        python=False,
    ),
    PublicFunction(
        "prepare",
        "(2)",
        ("parameters", "table"),
        ("table",),
        ("table",),
        python=False,
        claimed=(NORMAL, BITS),
    ),
    PublicFunction("prepare_mounts", "", ("parameters",), ("mounting",), ("table",), needs="flywheels", python=False),
)
"""Far out, numbers inside `step` and `prepare` may overflow, to be refused later: there Eva's claim is for bits, where
that is no alarm. Over the stages of a step intervals grow too wide to show more of most stands."""


def _forms() -> Iterator[PublicFunction]:
    for row in _ROWS:
        yield row
        if row.sines:
            at = len(_STATE)
            takes = (*row.takes[:at], "sine", "cosine", *row.takes[at:])
            yield replace(
                row,
                name=f"{row.name}_at",
                takes=takes,
                want=False,
                batched=False,
                python=False,
                claimed=(),
                sines=False,
            )


FUNCTIONS = {row.name: row for row in _forms()}
"""All rows by name, forms of given sines and cosines among them; a program has those that its stand has a use for."""

WANTS = tuple(row.name for row in FUNCTIONS.values() if row.want)
"""Every want of `eval`, in the order of the evaluation contract."""

BATCHED = tuple(row.name for row in FUNCTIONS.values() if row.batched)
"""Functions that have a batch."""

CONFLICTS = tuple(
    (first, second, name)
    for i, first in enumerate(WANTS)
    for second in WANTS[i + 1 :]
    for name in FUNCTIONS[first].gives
    if name in FUNCTIONS[second].gives
)
"""Pairs of wants that give two values to one name, and the name."""


def wants_of(referee: str) -> tuple[str, ...]:
    """Wants that a referee answers, in the order of the evaluation contract."""
    return tuple(name for name in WANTS if referee in FUNCTIONS[name].judges)
