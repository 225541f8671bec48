"""Compiled functions of a stand for one state or many."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, Unpack

import numpy as np
from numpy.typing import ArrayLike

from mahovik.contract.functions import row_of, task_of
from mahovik.core.stand.hold import has_coordinates
from mahovik.core.stand.model import Stand
from mahovik.core.toolchain.compiled import ELEMENT, Real
from mahovik.errors import InputError
from mahovik.out.api.calls import Array, Calls, How, Locks, OnError
from mahovik.out.api.inputs import Given, is_count
from mahovik.out.api.states import StateNumbers, States
from mahovik.out.api.tables import Tables
from mahovik.out.result import Result, column

if TYPE_CHECKING:
    from mahovik.core.motion.regime import Regime

StatesLike = States | Mapping[str, Any] | ArrayLike
"""`States`, what `Model.states` takes by name, or an array of shape (n, 13 + 2 N), or (13 + 2 N,) of one state."""


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
    if not is_count(threads) or threads < 1:
        raise InputError(f"build: threads: expected a number from 1, found {threads!r:.40}")
    return Model(stand, real, compiler, threads)


class Model:
    """Functions of a stand for one state or many; made by `mahovik.build`.

    `x` is `States`, what `states` takes by name, or an array (n, 13 + 2 N) or (13 + 2 N,); `simulate` alone compares an
    array with a hold. Other inputs are arrays of shape (n, k), or (k,) for all states alike, or one number for all, or
    numbers by the name of the flywheel; what is not given is zero. Each answers a `Result` of arrays with the batch
    axis first, and without it where all inputs are of one state; its column `status` has what the C said of each state,
    see `mahovik.Status`.

    All take `wrench=`, N and N m, six numbers by the name of a body, in its frame about its origin (not `momentum` and
    `points`); `tables=` of `Model.tables`: state j is of the stand of sample j; `on_error="nan"`: a state that the C
    refuses has NaN, in place of a RefusedError. Shapes and names that do not fit raise InputError. Functions may be
    called from several threads at once; a model can be pickled.
    """

    def __init__(self, stand: Stand, real: Real, compiler: str | None, threads: int) -> None:
        self._calls = Calls(stand, real, compiler, threads)
        self._made_by = (stand, real, compiler, threads)

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), self._made_by

    # -- what it is --------------------------------------------------------------------------------------------------

    @property
    def stand(self) -> Stand:
        """The stand it was built of."""
        return self._calls.stand

    @property
    def compiler(self) -> str:
        """Command of the compiler of its C."""
        return " ".join(self._calls.made.compiler)

    @property
    def flywheels(self) -> tuple[str, ...]:
        """Names of the flywheels, in the order of all arrays."""
        return self._calls.flywheels

    @property
    def sensors(self) -> tuple[str, ...]:
        """Names of instruments and points, in the order of `points`."""
        return self._calls.made.sensors

    @property
    def wrenches(self) -> tuple[str, ...]:
        """Bodies that take a run-time wrench: those with `wrench_input = true` in the stand file."""
        return self._calls.made.inputs

    @property
    def functions(self) -> Result:
        """Functions of this stand's C: `takes`, `gives`, and `how`, many states in a register or one by one."""
        made = self._calls.made
        # a task is asked of `inverse`
        known = {name: f for name, f in made.functions.items() if "x" in row_of(name).takes and not task_of(name)}
        takes = [[a.name for a in f.arguments if a.direction == "in"] for f in known.values()]
        gives = [
            ["states"] if "next" in row_of(name).gives else [one.name for one in self._calls.columns[name]]
            for name in known
        ]
        return Result(
            repr(self).strip("<>"),
            (
                column("function", "", [*known]),
                column("takes", "", [", ".join(name for name in names if name not in made.tables) for names in takes]),
                column("gives", "", [", ".join(names) for names in gives]),
                column("how", "", ["batch C" if f.wide else "C, state by state" for f in known.values()]),
            ),
        )

    def tables(self, changes: Mapping[str, Any], n: int | None = None) -> Tables:
        """Prepared tables of n stands that differ from the model's: arrays by path of the stand file.

        `{"w1.unbalance.static": array, "gravity": array}`: paths as in `Stand.replace`, arrays with the samples first,
        (n,) for a number, (n, 3) for a vector; SI, or `{"value": array, "unit": "g mm"}`; a number or a text is for all
        samples. Table j has the bits of `Stand.replace` with the values of sample j.

        Raises InputError for arrays that do not fit, UsageError for a path that leads nowhere or to another structure,
        StandError for a sample that cannot be, by its number.
        """
        return Tables(self._calls.made, self._calls.threads, changes, n)

    def __repr__(self) -> str:
        calls, count = self._calls, self._calls.threads
        how = f"{calls.real}, {count} thread{'' if count == 1 else 's'}"
        return f"<Model of {calls.stand.name}: {len(calls.flywheels)} flywheels; {how}>"

    def _repr_html_(self) -> str:
        return self.functions._repr_html_()

    # -- states ------------------------------------------------------------------------------------------------------

    def state(self, **numbers: Unpack[StateNumbers]) -> States:
        """One state; see `states`."""
        x = self.states(None, **numbers)
        if x.batch is not None:
            raise InputError(f"state: {x.batch} states given, expected one: use states")
        return x

    def states(self, n: int | None = None, **numbers: Unpack[StateNumbers]) -> States:
        """States: n of them, or as many as the arrays given have; one without batch axis where none has one.

        position    m; of O1 in E0; left out, 0, or where a hold has O1 with this attitude
        attitude    quaternion, w first, of x0 = C x1; made unit where it is within 1e-3 of that; or `quaternion`
        angles      rad; of the sequence of the stand, instead of `attitude`; neither: aligned with E0, or the home pose
        V           m/s, rad/s; twist in E1 about O1
        u           m/s, rad/s; of a held carrier instead of `V`: the speeds of its freedoms
        phi         rad; phases
        phi_dot     rad/s; speeds

        Raises InputError, also where a hold does not allow the pose or V.
        """
        return self._calls.maker.states(n, numbers)

    def states_of(self, array: ArrayLike) -> States:
        """States of an array of all their numbers, (n, 13 + 2 N) or (13 + 2 N,), as `States.array` has them: a copy.

        Quaternions are taken as they are: the C refuses those that are not unit within 1e-3. Raises InputError.
        """
        return self._calls.maker.of_array(array)

    def carry(self, n: int | None = None) -> Array:
        """A carry for `step` and `step_driven`, all zero: (n, 13 + 2 N), or (13 + 2 N,) of one state."""
        if n is not None and not is_count(n):
            raise InputError(f"carry: expected a number of states from 0, found {n!r:.40}")
        components = self._calls.maker.components
        return np.zeros(components if n is None else (n, components), self._calls.element)

    # -- motion ------------------------------------------------------------------------------------------------------

    def forward(self, x: StatesLike, phi_ddot: Given = 0.0, **how: Unpack[How]) -> Result:
        """`V_dot` (6) of the carrier for given accelerations of the flywheels, rad/s2, (8). Batch C."""
        return self._calls.result("forward", x, how, phi_ddot=phi_ddot)

    def coupled(self, x: StatesLike, tau: Given = 0.0, *, locked: Locks = (), **how: Unpack[How]) -> Result:
        """`V_dot` (6) and `phi_ddot` (N) of the whole system under given drive torques. Batch C.

        tau     N m; mount on flywheel
        locked  names of flywheels that a lock holds at phi'' = 0, or a flag for each; the same for all states
        """
        return self._calls.result("coupled", x, how, tau=tau, locked=locked)

    def torque(self, x: StatesLike, V_dot: Given = 0.0, phi_ddot: Given = 0.0, **how: Unpack[How]) -> Result:
        """Drive torques `tau` (N) for a given motion, m/s2 and rad/s2. Of wrenches those on flywheels act. Batch C."""
        return self._calls.result("torque", x, how, V_dot=V_dot, phi_ddot=phi_ddot)

    def step(
        self,
        x: StatesLike,
        dt: float | str,
        tau: Given = 0.0,
        *,
        locked: Locks = (),
        order: Literal[2, 4] = 4,
        carry: Array | None = None,
        **how: Unpack[How],
    ) -> States:
        """The states a time `dt` later, s or a text with a unit, under drive torques and wrenches held constant.

        order  4: Runge-Kutta; 2: midpoint rule
        carry  of `model.carry`: takes what rounding took from these states, and is changed in place

        Batch C; with a carry state by state.
        """
        return self._calls.step("step", x, dt, order, carry, how, tau=tau, locked=locked)

    def step_driven(
        self,
        x: StatesLike,
        dt: float | str,
        phi_ddot: Given = 0.0,
        *,
        order: Literal[2, 4] = 4,
        carry: Array | None = None,
        **how: Unpack[How],
    ) -> States:
        """The states a time `dt` later under given flywheel accelerations; else as `step`."""
        return self._calls.step("step_driven", x, dt, order, carry, how, phi_ddot=phi_ddot)

    def simulate(
        self,
        until: float | str,
        *,
        regime: Regime | Mapping[str, Any] | str | Path | None = None,
        start: StatesLike | None = None,
        dt: float | str = 1e-4,
        every: float | str = 1e-3,
        order: int = 4,
        mounts: bool = False,
        tables: Tables | None = None,
        on_error: OnError = "raise",
    ) -> Result:
        """The motion until a time (s, or a text with a unit), of all states and stands at once, in C.

        regime    speeds or torques of the flywheels, wrenches: a file, its keys, or a Regime; the same for all samples.
                  None: the flywheels keep the speeds of `start`
        start     one state for all samples, or one for each; None: rest of the model's stand
        dt        the longest step; every: time between moments of output, the last of which is `until`
        order     of the step: 4 or 2
        mounts    also the wrench of the mount on each flywheel
        tables    of `model.tables`: sample j is of stand j
        on_error  "raise": a state that the C refuses raises RefusedError; "nan": its numbers are NaN from then on

        Arrays are (T, ...), of many samples (n, T, ...): `t`, the state, `V_dot`, `phi_ddot`, `tau` (whole drive
        torques), `specific_force` and `rate` of sensors, `reaction` of a hold, in E1 about O1; `refused` says of each
        sample why the C refused it, or "". Phases are not wrapped.
        Raises InputError, UsageError, RegimeError, CheckError (no rest pose), RefusedError.
        """
        from mahovik.out.api.simulate import simulate

        return simulate(self._calls, until, regime, start, dt, every, order, mounts, tables, on_error)

    # -- inverse problems --------------------------------------------------------------------------------------------

    def inverse(
        self,
        x: StatesLike,
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
        **how: Unpack[How],
    ) -> Result:
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
        motion that results; positive statuses say what to know. State by state.
        """
        settings = {"weight": weight, "limit": limit, "most": most, "motor_torque": motor_torque}
        settings |= {"motor_speed": motor_speed, "near_singular": near_singular, "damping": damping}
        if task is None:
            if demand is not None or rows is not None:
                raise InputError(f"{'rows' if demand is None else 'demand'}: needs a task, task=NAME")
            if V_dot is None:
                raise InputError("V_dot: missing; give V_dot, or a task and its demand")
            return self._calls.result("inverse", x, how, V_dot=V_dot, options=self._calls.options(settings))
        known = self._calls.rows_of(task)
        if V_dot is not None:
            raise InputError("V_dot, task: both given, expected one of them")
        if demand is None:
            raise InputError(f"demand: missing, expected one number for each of {', '.join(known)}")
        options = self._calls.options(settings, task, rows)
        return self._calls.result(f"inverse_{task}", x, how, demand=demand, options=options)

    def torque_for(
        self,
        x: StatesLike,
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
        **how: Unpack[How],
    ) -> Result:
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

        Gives `tau`, `phi_ddot`, `V_dot`, `residual`, `share`, `limited`. State by state.
        """
        self._calls.rows_of(task)
        options = self._calls.options(
            {
                "weight": weight, "motor_torque": motor_torque, "motor_speed": motor_speed, "motor_power": motor_power,
                "target_speed": target_speed, "target_rate": target_rate, "avoid_speed": avoid_speed,
                "keep_direction": float(keep_direction),
            },
            task,
            rows,
        )  # fmt: skip
        return self._calls.result(f"torque_for_{task}", x, how, demand=demand, locked=locked, options=options)

    # -- what the equations are made of ------------------------------------------------------------------------------

    def matrices(self, x: StatesLike, **how: Unpack[How]) -> Result:
        """`K`, `K_dot`, `M` (6, 6), `I`, `J` (6, N), `F` (6) of (8). Batch C."""
        return self._calls.result("matrices", x, how)

    def momentum(self, x: StatesLike, **how: Unpack[How]) -> Result:
        """`Z` (6) in E1 about O1, `Z0` (6) in E0 about its origin, kinetic `energy`, `center_of_mass` (3) in E1,
        `center_of_mass_velocity` (3) in E0; (1), (2). State by state."""
        return self._calls.result("momentum", x, how)

    def points(self, x: StatesLike, V_dot: Given = 0.0, **how: Unpack[How]) -> Result:
        """What accelerometers and gyros read at instruments and points, `sensors`. Batch C.

        Gives `position`, `C`, `twist`, `specific_force`, `angular_acceleration`, each with an axis of sensors.
        """
        return self._calls.result("points", x, how, V_dot=V_dot)

    def mounts(self, x: StatesLike, V_dot: Given = 0.0, phi_ddot: Given = 0.0, **how: Unpack[How]) -> Result:
        """`mount_wrench` (N, 6) of the mount on each flywheel, N, N m, about Os in the axes of Es at phi = 0: bearing
        loads. Of wrenches those on flywheels act. Batch C."""
        return self._calls.result("mounts", x, how, V_dot=V_dot, phi_ddot=phi_ddot)

    def reaction(self, x: StatesLike, V_dot: Given | None = None, phi_ddot: Given = 0.0, **how: Unpack[How]) -> Result:
        """`reaction` (6) of the hold on a held carrier for a given motion, N, N m, in E1 about O1; (8). Batch C.

        `V_dot` = S u_dot is required where the carrier has freedoms; that of a clamped one is zero. For a motion that
        is not the one that `forward` finds, the part along the freedoms is what a drive would add.
        """
        if V_dot is None and self.stand.hold is not None and self.stand.hold.freedoms:
            raise InputError(
                "reaction: V_dot is missing, expected that of the motion; forward gives the free one, with its reaction"
            )
        return self._calls.result("reaction", x, how, V_dot=0.0 if V_dot is None else V_dot, phi_ddot=phi_ddot)

    def generalized(
        self, x: StatesLike, angles: Given | None = None, phi_ddot: Given = 0.0, **how: Unpack[How]
    ) -> Result:
        """The equations in generalized coordinates, (10), (11); `angles`, rad, take the place of the attitude of `x`.

        Gives `A`, `D`, `I0`, `J0` (6, 6), `q_dot`, `q_ddot` (6). Of a held carrier, without `angles`, the coordinates
        of its freedoms: `q`, `q_dot`, `q_ddot`, and `orientation` of one that turns about a point. State by state.
        """
        hold = self.stand.hold
        held = hold is not None
        if held != (angles is None):
            expected = "none, the carrier is held and its attitude is that of x" if held else "psi, theta, phi"
            raise InputError(f"generalized: angles: {'given' if held else 'missing'}, expected {expected}")
        if hold is not None and not has_coordinates(hold):
            lacks = "the freedoms of [hold] have no coordinates" if hold.freedoms else "the carrier is clamped"
            raise InputError(f"generalized: {lacks}, ask for forward")
        arguments = {"phi_ddot": phi_ddot} | ({} if held else {"angles": angles})
        return self._calls.result("generalized", x, how, **arguments)

    def forward_jacobian(self, x: StatesLike, phi_ddot: Given = 0.0, **how: Unpack[How]) -> Result:
        """Derivatives of `forward` by V, phi, phi', phi'': `V_dot_V` (6, 6), `V_dot_phi` (6, N), ... State by state."""
        return self._calls.result("forward_jacobian", x, how, phi_ddot=phi_ddot)

    def coupled_jacobian(self, x: StatesLike, tau: Given = 0.0, *, locked: Locks = (), **how: Unpack[How]) -> Result:
        """Derivatives of `coupled` by V, phi, phi', tau. State by state."""
        return self._calls.result("coupled_jacobian", x, how, tau=tau, locked=locked)
