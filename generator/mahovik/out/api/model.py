"""Compiled functions of a stand for one state or many: what each takes and gives."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from inspect import Parameter, Signature
from typing import Literal

from numpy.typing import ArrayLike

from mahovik.contract.functions import FUNCTIONS, PublicFunction
from mahovik.contract.quantities import QUANTITIES, is_shared
from mahovik.core.stand.model import Stand
from mahovik.core.stand.units import show
from mahovik.core.toolchain.compiled import ELEMENT, Real
from mahovik.errors import InputError
from mahovik.nearest import suggestion
from mahovik.out.api import results
from mahovik.out.api.call import OnError
from mahovik.out.api.coordinates import WithCoordinates
from mahovik.out.api.core import Built, Locks, Wrenches
from mahovik.out.api.fields import Array
from mahovik.out.api.inputs import Given
from mahovik.out.api.reaction import WithReaction
from mahovik.out.api.results import Answer
from mahovik.out.api.simulate import WithSimulation
from mahovik.out.api.states import States
from mahovik.out.api.tables import Tables


def add_methods(model: type[Built]) -> None:
    """Give a class of models a method for each function of states that it has none for."""
    for row in FUNCTIONS.values():
        if row.python and "x" in row.takes and not hasattr(model, row.name):
            setattr(model, row.name, _method(row))


def _method(row: PublicFunction) -> Callable[..., Answer]:
    inputs = [name for name in row.takes if name not in ("x", "wrench") and not is_shared(name)]
    positional, keyword = Parameter.POSITIONAL_OR_KEYWORD, Parameter.KEYWORD_ONLY
    parameters = [Parameter(name, positional) for name in ("self", "x")]
    parameters += [Parameter(name, positional, default=0.0) for name in inputs]
    parameters += [Parameter("wrench", keyword, default=None)] if "wrench" in row.takes else []
    parameters += [Parameter("tables", keyword, default=None), Parameter("on_error", keyword, default="raise")]
    signature = Signature(parameters)

    def method(*arguments: object, **named: object) -> Answer:
        bound = signature.bind(*arguments, **named)
        bound.apply_defaults()
        given = dict(bound.arguments)
        model, x, tables, on_error = (given.pop(name) for name in ("self", "x", "tables", "on_error"))
        found: Answer = model._result(Answer, row.name, x, on_error, given.pop("wrench", None), tables, **given)
        return found

    results = (f"`{name}`" + (f", {q.unit}: {q.axes}" if (q := QUANTITIES.get(name)) else "") for name in row.gives)
    method.__doc__ = f"{'; '.join(results)}. State by state. Raises InputError, RefusedError."
    method.__name__ = row.name
    method.__signature__ = signature  # type: ignore[attr-defined]  # inspect reads it
    return method


def build(stand: Stand, *, real: Real = "double", compiler: str | None = None, threads: int = 1) -> Model:
    """Compiles the C of a stand for this machine, once: later calls find it in the cache.

    real      element type of the C, "double" or "float"
    compiler  command of the C compiler; else the environment's CC, else cc, gcc or clang
    threads   among which the states of a call are shared, by OpenMP; results do not depend on it

    Raises InputError, ToolchainError (no compiler, or it refused the C), UsageError and StandError as `generate`.
    """
    if not isinstance(stand, Stand):
        raise InputError(f"build: expected a Stand, found {type(stand).__name__}: mahovik.load(path) reads one")
    if real not in ELEMENT:
        raise InputError(f'build: real: expected "double" or "float", found {real!r:.40}')
    if isinstance(threads, bool) or not isinstance(threads, int) or threads < 1:
        raise InputError(f"build: threads: expected a number from 1, found {threads!r:.40}")
    return Model(stand, real, compiler, threads)


class Model(WithReaction, WithCoordinates, WithSimulation):
    """Functions of a stand for one state or many; made by `mahovik.build`.

    `x` is `States` or an array of shape (n, 13 + 2 N), or (13 + 2 N,) of one state. Other inputs are arrays of shape
    (n, k), or (k,) for all states alike, or one number for all, or numbers by the name of the flywheel; what is not
    given is zero. Results have the batch axis first, and none where all inputs are of one state.

    A state that the C refuses raises RefusedError, which names it; with `on_error="nan"` its results are NaN.
    With `tables=`, of `tables`, state j is of the stand of sample j; one state is of all of them.
    Functions may be called from several threads at once; a model can be pickled, and is built again from the cache.
    """

    # -- functions that have a batch ---------------------------------------------------------------------------------

    def forward(
        self,
        x: States | ArrayLike,
        phi_ddot: Given = 0.0,
        *,
        wrench: Wrenches = None,
        tables: Tables | None = None,
        on_error: OnError = "raise",
    ) -> results.Forward:
        """Acceleration of the carrier for given accelerations of the flywheels, (8).

        phi_ddot  rad/s2
        wrench    N, N m; by body, in the body's own frame about its origin

        Gives `V_dot`. Batch C. Raises InputError, RefusedError.
        """
        return self._result(results.Forward, "forward", x, on_error, wrench, tables, phi_ddot=phi_ddot)

    def coupled(
        self,
        x: States | ArrayLike,
        tau: Given = 0.0,
        *,
        locked: Locks = (),
        wrench: Wrenches = None,
        tables: Tables | None = None,
        on_error: OnError = "raise",
    ) -> results.Coupled:
        """Motion of the whole system under given drive torques.

        tau     N m; mount on flywheel
        locked  names of flywheels that a lock holds at phi'' = 0, or a flag for each; the same for all states

        Gives `V_dot`, `phi_ddot`. Batch C. Raises InputError, RefusedError.
        """
        return self._result(results.Coupled, "coupled", x, on_error, wrench, tables, tau=tau, locked=locked)

    def torque(
        self,
        x: States | ArrayLike,
        V_dot: Given = 0.0,
        phi_ddot: Given = 0.0,
        *,
        wrench: Wrenches = None,
        tables: Tables | None = None,
        on_error: OnError = "raise",
    ) -> results.Torque:
        """Drive torques for a given motion: V_dot m/s2, rad/s2; phi_ddot rad/s2. Of wrenches those on flywheels act.

        Gives `tau`. Batch C. Raises InputError, RefusedError.
        """
        return self._result(results.Torque, "torque", x, on_error, wrench, tables, V_dot=V_dot, phi_ddot=phi_ddot)

    def step(
        self,
        x: States | ArrayLike,
        dt: float | str,
        tau: Given = 0.0,
        *,
        locked: Locks = (),
        order: Literal[2, 4] = 4,
        wrench: Wrenches = None,
        carry: Array | None = None,
        tables: Tables | None = None,
        on_error: OnError = "raise",
    ) -> States:
        """The states a time `dt` later, s or a text with a unit, under drive torques and wrenches held constant.

        order  4: Runge-Kutta; 2: midpoint rule
        carry  of `model.carry`: takes what rounding took from these states, and is changed in place

        Batch C; with a carry state by state. Raises InputError, RefusedError.
        """
        return self._step("step", x, dt, order, on_error, wrench, carry, tables, tau=tau, locked=locked)

    # -- functions for one state, in a loop --------------------------------------------------------------------------

    def step_driven(
        self,
        x: States | ArrayLike,
        dt: float | str,
        phi_ddot: Given = 0.0,
        *,
        order: Literal[2, 4] = 4,
        wrench: Wrenches = None,
        carry: Array | None = None,
        tables: Tables | None = None,
        on_error: OnError = "raise",
    ) -> States:
        """The states a time `dt` (s) later, under given flywheel accelerations; `carry` as in `step`.

        Batch C; with a carry state by state.

        Raises InputError, RefusedError.
        """
        return self._step("step_driven", x, dt, order, on_error, wrench, carry, tables, phi_ddot=phi_ddot)

    def inverse(
        self,
        x: States | ArrayLike,
        V_dot: Given | None = None,
        *,
        task: str | None = None,
        demand: Given | None = None,
        rows: Sequence[str] | None = None,
        weight: Given | None = None,
        limit: Given | None = None,
        most: Given | None = None,
        motor_torque: Given | None = None,
        motor_speed: Given | None = None,
        near_singular: float | None = None,
        damping: float | None = None,
        wrench: Wrenches = None,
        tables: Tables | None = None,
        on_error: OnError = "raise",
    ) -> results.Inverse:
        """Flywheel accelerations for a wanted motion of the carrier, (12): least residual, then least weighted phi''.

        task          name of a task of the stand, with `demand`, a number for each row, in place of V_dot
        rows          names of its rows that are demanded, the others are free; by default all
        weight        of each flywheel in the norm of phi''; of those not given what the stand file says
        limit         rad/s2; of each |phi''|; of those not given none
        most          rad/s2; EXCESSIVE above this |phi''|; by default `inverse_most` of flywheels without a motor
        motor_torque  N m; EXCESSIVE if the drive torque is above it; by default that of the motor
        motor_speed   rad/s; no-load speed, where the torque that drives has fallen to 0; by default that of the motor
        near_singular  status NEAR_SINGULAR below this part of the largest singular value
        damping       of small singular values, a part of the largest; else none

        Gives `phi_ddot`, `residual`, `sigma`, `rank`, `damped_by`, `limited`, `hardest`, of a task `V_dot` as well, the
        motion that results; positive statuses say what to know. State by state. Raises InputError, RefusedError.
        """
        each = {"weight": weight, "limit": limit, "most": most}
        each |= {"motor_torque": motor_torque, "motor_speed": motor_speed}
        shares = {"near_singular": near_singular, "damping": damping}
        if task is None:
            if demand is not None or rows is not None:
                raise InputError(f"{'rows' if demand is None else 'demand'}: needs a task, task=NAME")
            if V_dot is None:
                raise InputError("V_dot: missing; give V_dot, or a task and its demand")
            options = self._options(each, shares)
            return self._result(results.Inverse, "inverse", x, on_error, wrench, tables, V_dot=V_dot, options=options)
        self._check_task(task)
        if V_dot is not None:
            raise InputError("V_dot, task: both given, expected one of them")
        if demand is None:
            raise InputError(f"demand: missing, expected one number for each of {', '.join(self._rows[task])}")
        options = self._options(each, shares, self._demand_options(task, rows))
        function = f"inverse_{task}"
        return self._result(results.Inverse, function, x, on_error, wrench, tables, demand=demand, options=options)

    def torque_for(
        self,
        x: States | ArrayLike,
        task: str,
        demand: Given,
        *,
        rows: Sequence[str] | None = None,
        locked: Locks = (),
        weight: Given | None = None,
        motor_torque: Given | None = None,
        motor_speed: Given | None = None,
        motor_power: Given | None = None,
        target_speed: Given | None = None,
        target_rate: float | None = None,
        avoid_speed: float | None = None,
        keep_direction: bool = False,
        wrench: Wrenches = None,
        tables: Tables | None = None,
        on_error: OnError = "raise",
    ) -> results.TorqueFor:
        """Drive torques for the demand of a task, within what the motors have: least error, then least torque.

        rows            names of the rows that are demanded, the others are free; by default all
        locked          flywheels that take no part: locked, or failed
        weight          of each flywheel in the norm of the torques; of those not given what the stand file says
        motor_torque    N m; largest torque; by default that of the motor. Braking has all of it
        motor_speed     rad/s; no-load speed, where the torque that drives has fallen to 0; by default that of the motor
        motor_power     W; largest mechanical power when driving; by default none
        target_speed    rad/s; speeds that the flywheels approach with what the demand leaves free
        target_rate     1/s; part of what is missing to them, a second; by default 0: least torque
        avoid_speed     rad/s; no wanted speed lies nearer to 0 than this
        keep_direction  a demand out of reach is made smaller, and not turned; `share` is the part that is met

        Gives `tau`, `phi_ddot`, `V_dot`, `residual`, `share`, `limited`. State by state. Raises InputError,
        RefusedError.
        """
        self._check_task(task)
        each = {"weight": weight, "motor_torque": motor_torque, "motor_speed": motor_speed}
        each |= {"motor_power": motor_power, "target_speed": target_speed}
        numbers = {"target_rate": target_rate, "avoid_speed": avoid_speed, "keep_direction": float(keep_direction)}
        given = {
            "demand": demand,
            "locked": locked,
            "options": self._options(each, numbers, self._demand_options(task, rows)),
        }
        return self._result(results.TorqueFor, f"torque_for_{task}", x, on_error, wrench, tables, **given)

    def _check_task(self, task: str) -> None:
        if task not in self._rows:
            raise InputError(f"task: unknown {show(task)}{suggestion(task, self._rows, 'the stand has none')}")

    def matrices(
        self,
        x: States | ArrayLike,
        *,
        wrench: Wrenches = None,
        tables: Tables | None = None,
        on_error: OnError = "raise",
    ) -> results.Matrices:
        """`K`, `K_dot`, `M`, `I`, `J`, `F` of (8). Batch C. Raises InputError, RefusedError."""
        return self._result(results.Matrices, "matrices", x, on_error, wrench, tables)

    def momentum(
        self, x: States | ArrayLike, *, tables: Tables | None = None, on_error: OnError = "raise"
    ) -> results.Momentum:
        """`Z`, `Z0`, `energy`, `center_of_mass`, its velocity, (1), (2). State by state; InputError, RefusedError."""
        return self._result(results.Momentum, "momentum", x, on_error, None, tables)

    def points(
        self, x: States | ArrayLike, V_dot: Given = 0.0, *, tables: Tables | None = None, on_error: OnError = "raise"
    ) -> results.Points:
        """What accelerometers and gyros read at instruments and points. Batch C.

        Gives `position`, `C`, `twist`, `specific_force`, `angular_acceleration`, each with an axis of `sensors`.
        Raises InputError, RefusedError.
        """
        return self._result(results.Points, "points", x, on_error, None, tables, V_dot=V_dot)

    def mounts(
        self,
        x: States | ArrayLike,
        V_dot: Given = 0.0,
        phi_ddot: Given = 0.0,
        *,
        wrench: Wrenches = None,
        tables: Tables | None = None,
        on_error: OnError = "raise",
    ) -> results.Mounts:
        """Wrench of the mount on each flywheel: bearing loads. Of wrenches those on flywheels act.

        Batch C. Raises InputError, RefusedError.
        """
        return self._result(results.Mounts, "mounts", x, on_error, wrench, tables, V_dot=V_dot, phi_ddot=phi_ddot)

    def forward_jacobian(
        self,
        x: States | ArrayLike,
        phi_ddot: Given = 0.0,
        *,
        wrench: Wrenches = None,
        tables: Tables | None = None,
        on_error: OnError = "raise",
    ) -> results.ForwardJacobian:
        """Derivatives of `forward` by V, phi, phi', phi''. State by state. Raises InputError, RefusedError."""
        return self._result(results.ForwardJacobian, "forward_jacobian", x, on_error, wrench, tables, phi_ddot=phi_ddot)

    def coupled_jacobian(
        self,
        x: States | ArrayLike,
        tau: Given = 0.0,
        *,
        locked: Locks = (),
        wrench: Wrenches = None,
        tables: Tables | None = None,
        on_error: OnError = "raise",
    ) -> results.CoupledJacobian:
        """Derivatives of `coupled` by V, phi, phi', tau. State by state. Raises InputError, RefusedError."""
        return self._result(
            results.CoupledJacobian, "coupled_jacobian", x, on_error, wrench, tables, tau=tau, locked=locked
        )


add_methods(Model)
