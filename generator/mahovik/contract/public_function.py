"""A row of the contract: one public function of a stand's C, and the judges that there are."""

from __future__ import annotations

from dataclasses import dataclass

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
    needs     parts that a stand must have: "flywheels", "sensors" (instruments or points), "tasks", "held"; or nothing
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
