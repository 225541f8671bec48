"""One fault of the dictionary: the equations with a term replaced, and the words that say which."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any, ClassVar, Literal

from mahovik.core.stand.model import Body, Flywheel
from mahovik.proof.diagnose.equations import Equations

OF_A_BODY = (
    "read_body", "theta", "weight", "buoyancy", "damping", "twist_in_fluid", "run_time", "wrench", "carried",
)  # fmt: skip
"""Terms of any one body: replaced for those that `bodies` names."""

OF_A_FLYWHEEL = (
    "phase", "speed", "acceleration", "wheel_transfer", "wheel_mass", "spin_inertia", "wheel_rate", "coupling",
    "turning", "spinning", "base_acceleration", "transport", "own_acceleration", "gyroscopic", "own_wrench", "in_mount",
)  # fmt: skip
"""Terms of one flywheel."""


class Fault(Equations):
    """Equations with a fault: every override of a subclass is a wrong term, its docstring says what is wrong.

    name      short, for tables and `--json`
    equation  where the term stands
    look      what to look at in it
    bodies    the bodies whose terms are wrong
    """

    name: ClassVar[str]
    equation: ClassVar[str]
    look: ClassVar[str]
    bodies: ClassVar[Literal["flywheels", "fixed", "all"]] = "flywheels"
    of_flywheels: ClassVar[bool] = False
    """Whether it may be a fault of one flywheel alone."""

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        hooks = [name for name in vars(cls) if callable(getattr(cls, name)) and hasattr(Equations, name)]
        hooks = [name for name in hooks if not name.startswith("_")]
        single = [name for name in hooks if name in OF_A_BODY or name in OF_A_FLYWHEEL]
        cls.of_flywheels = cls.bodies == "flywheels" and bool(hooks) and single == hooks
        for name in single:
            setattr(cls, name, _where_it_is(cls, name, vars(cls)[name]))

    @classmethod
    def words(cls) -> str:
        """What the program does, as a sentence without its full stop."""
        return " ".join((cls.__doc__ or cls.name).split()).removesuffix(".")

    @classmethod
    def concerns(cls, body: Body, wheel: str | None) -> bool:
        """Whether the term of this body is wrong; `wheel`: the only flywheel that has the fault, where it is one."""
        turns = isinstance(body, Flywheel)
        if cls.bodies != "all" and turns != (cls.bodies == "flywheels"):
            return False
        return wheel is None or wheel == body.name


def _where_it_is(fault: type[Fault], name: str, wrong: Callable[..., Any]) -> Callable[..., Any]:
    """The wrong term where the fault is, the right one elsewhere."""

    @functools.wraps(wrong)
    def term(self: Fault, k: Any, *rest: Any) -> Any:
        if fault.concerns(getattr(k, "body", k), self.wheels.get(fault)):
            return wrong(self, k, *rest)
        return getattr(super(fault, self), name)(k, *rest)

    return term
