"""forward_jacobian, coupled_jacobian: exact derivatives by V (or u), phi, phi_dot, phi_ddot or tau, at fixed attitude.

In motion nothing is left of (8): R = F - Phi Z - K_dot V - (a_rel, g_rel) - K V_r_dot = 0. So K d(V_r_dot) = dR, where
V_r_dot stays in R, and dR is solved by the factors that gave V_r_dot itself; with free flywheels, of torques
T = I . V_r_dot + bias + Theta_ff phi_ddot - own moment, after these were eliminated. Of all flywheels only s depends on
phi_s and its rate. R and T are functions of the program, and their derivatives are made of them by program/tangent;
this file solves.

With a stream V_r_dot = V_dot + (omega x C^T stream, 0), and V_dot = S u_dot along freedoms, where V changes by S du:
S^T K S d(u_dot) = S^T (dR - K d(omega x C^T stream, 0)).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from mahovik.core.lower.drive import with_moment, without
from mahovik.core.lower.flywheels import common_terms, couple_flywheel, named_turns, terms_of, weights
from mahovik.core.lower.forward import (
    STATE_STATUSES,
    check_inputs,
    external_wrench,
    scene,
    sum_up,
    without_drift,
)
from mahovik.core.lower.freedoms import place_of
from mahovik.core.lower.hold import write_twist
from mahovik.core.lower.library import Library
from mahovik.core.lower.solve import mass_times, start_blocks
from mahovik.core.program.expression import Const, Expr, Place, Status, equal, real, select
from mahovik.core.program.function import Function
from mahovik.core.program.inline import Inliner
from mahovik.core.program.kernel import OK, Reals, Result, argument, body, inline, reals, record, result
from mahovik.core.program.tangent import Seed, Tangents, partials
from mahovik.core.program.vector import Vector, cross, dot

NOTES = ("At a kink of a damping law with magnitudes, the derivative from one side is returned.",)
NOTHING: Any = Vector([])
TWIST = tuple(f"V{j + 1}" for j in range(6))


def add_all(lib: Library) -> None:
    """Adds both Jacobians, and the derivatives of which they consist."""
    tangents = Tangents(lib)
    if "external" in lib:
        inputs = [name for name in ("V", "x.V") if name.split(".")[0] in lib.taken("external")]
        if inputs:
            tangents.change("external", {"V": inputs})
    by_V: dict[str, dict[str, Seed]] = {name: {"V": _unit(j), "F": lambda _: None} for j, name in enumerate(TWIST)}
    lib.add(partials(lib["subtract_rates"], "subtract_rates_by_V", "V", by_V))
    if lib.layout.flywheels:
        _add_flywheel(lib, tangents)
    add_forward_jacobian(lib)
    if lib.layout.flywheels:
        add_coupled_jacobian(lib)


def _unit(j: int) -> Seed:
    """Derivative of the elements of an array by element j."""

    def seed(element: Place) -> Expr | None:
        index = element.operands[0]
        assert isinstance(index, Const)
        return real(1) if index.value == j else None

    return seed


def _add_flywheel(lib: Library, tangents: Tangents) -> None:
    """Derivatives of what one flywheel gives to R, of its torque, and of its own wrench."""
    share, torque = _share(lib), _torque(lib)
    flat = Inliner({name: lib[name] for name in ("subtract_rates", "couple")} | {f.name: f for f in (share, torque)})
    turning = _turning(share)
    by: dict[str, dict[str, Seed]] = {"phi": turning}
    by |= {name: {name: lambda _: real(1)} for name in ("phi_dot", "phi_ddot")}
    lib.add(partials(flat[share.name], "flywheel_share_by_phase", "phi, phi_dot and phi_ddot", by))
    by = {name: {"V": _unit(j)} for j, name in enumerate(TWIST)} | {"phi": _turning(torque)}
    lib.add(partials(flat[torque.name], "flywheel_torque_by_motion", "V and phi", by))
    if lib.layout.local_turning:
        tangents.derivative("own_wrench", "phi", _turning(lib["own_wrench"]))
    if lib.layout.local_turning and lib.layout.local_damped:
        tangents.derivative("own_wrench", "phi_dot", {"x.phi_dot": lambda _: real(1)})


def _turning(function: Function) -> dict[str, Seed]:
    """Derivatives of sines and cosines by their phase."""
    places = {a.name: a.place for a in function.arguments}

    def at(name: str, element: Place) -> Place:
        return places[name][element.operands[0]] if element.path else places[name]

    sine, cosine = ("sine", "cosine") if "sine" in places else ("s", "c")
    return {sine: lambda element: at(cosine, element), cosine: lambda element: -at(sine, element)}


def _share(lib: Library) -> Function:
    """What one flywheel gives to R, by its row of harmonics."""
    layout = lib.layout

    @lib.kernel(equation="(8)")
    def flywheel_share(
        table: Any = lib.table,
        row: Any = argument(struct=layout.row),
        s: float = argument(),
        c: float = argument(),
        phi_dot: float = argument(),
        phi_ddot: float = argument(),
        V: Reals = argument("", 6),
        V_dot: Reals = argument("V_r_dot", 6),
        g: Reals = argument("gravity in E1", 3, unit="m/s2"),
        R: Reals = result("", 6),
    ) -> None:
        """Share of one flywheel in what is left of (8)."""
        terms = terms_of(row, s, c, phi_dot, phi_ddot, weights(s, c, phi_dot, phi_ddot))
        sum_ = record(layout.sums)  # its part of the sums
        for f in layout.sums.fields:
            sum_.member(f.name)[:] = getattr(terms, f.name)
        R[0:3] = [0, 0, 0]
        if layout.flywheel_displaces:
            R[3:6] = cross(sum_.mu - (row.displaced_c * c + row.displaced_s * s), g)
        elif layout.weight:
            R[3:6] = cross(sum_.mu, g)
        else:
            R[3:6] = [0, 0, 0]
        lib["subtract_rates"](table, sum_, V, R)
        R -= mass_times(lib, table, sum_, V_dot)

    return flywheel_share


def _torque(lib: Library) -> Function:
    """T = I . V_r_dot + bias of one flywheel."""

    @lib.kernel(equation="(9)")
    def flywheel_torque(
        row: Any = argument(struct=lib.layout.row),
        s: float = argument(),
        c: float = argument(),
        V: Reals = argument("", 6),
        V_dot: Reals = argument("V_r_dot", 6),
        g: Reals = argument("gravity in E1", 3, unit="m/s2"),
        T: Result = result(unit="N m"),
    ) -> None:
        """Torque of one flywheel without that of its own acceleration."""
        common = common_terms(lib, V, g)
        drive = record(lib.layout.coupling)
        lib["couple"](row, s, c, common.origin_acceleration, common.spun, g, drive)
        T.value = dot(V_dot, drive.I) + drive.bias

    return flywheel_torque


@dataclass(frozen=True)
class System:
    """The equations of the carrier at a state, which are solved for R or its changes: K V_r_dot = R, or along a hold.

    named   inputs of functions by their names
    R       what is left of (8) (6);  side  its part along the freedoms of a hold (count), else R;  y  solution (count)
    K       mass matrix, along the freedoms of a hold;  factors  of it, or its inverse
    drives  columns of I, where the flywheels are eliminated;  shares  their part along the freedoms
    d_own   changes of own wrenches of the flywheels
    drift   omega x C^T stream of a held carrier in a stream, for which K drift is taken from R
    """

    named: dict[str, Any]
    seen: Any
    R: Any
    side: Any
    y: Any
    K: Any
    factors: Any
    drives: Any
    shares: Any
    d_own: Any
    drift: Any

    def call(self, lib: Library, function: str, **named: Any) -> None:
        """Calls a function with what it takes."""
        body().do(lib[function](*lib.arguments_of(function, **(self.named | named))))


@inline
def set_up(lib: Library, table: Any, x: Any, phi_ddot: Any, wrench: Any, eliminated: bool) -> Any:
    """The system at a state; `eliminated`: with the flywheels, which are to be eliminated."""
    layout, N, m = lib.layout, lib.layout.count, lib.layout.moved[3]
    seen = scene(lib, table, x)
    sum_up(lib, table, x, seen, phi_ddot)
    R = reals(6)  # what is left of (8), and its changes
    y = reals(m)  # solution
    K, drives, shares, d_own, drift = None, None, None, None, None
    if eliminated:
        drives = record(layout.coupling, N)
    if any(changes_moments(lib, by) for by in OWN_BY):
        d_own = reals(6 * int(N))  # changes of own wrenches
    external_wrench(lib, table, x, seen, wrench, R)
    lib["subtract_rates"](table, seen.sums, seen.V, R)
    if layout.held:
        drift = without_drift(lib, table, x, seen, R)
        side = reals(m)  # its part along the freedoms
        K = reals(place_of(m, 0))  # mass matrix along the freedoms
        factors = reals(m, m)  # its inverse
        if eliminated:
            shares = reals(N, m)  # S^T I, flywheel by flywheel
        lib["project_mass"](table, seen.sums, K)
        lib["project_wrench"](table, R, side)
    else:
        side = R
        if eliminated:
            K = record(layout.schur)  # mass matrix with free flywheels eliminated
            factors = record(layout.schur_factor)
            start_blocks(lib, table, seen.sums, K)
        else:
            factors = record(layout.carrier_factor)
    named = inputs_of(table, x, seen, wrench)
    return System(named, seen, R, side, y, K, factors, drives, shares, d_own, drift)


def inputs_of(table: Any, x: Any, seen: Any, wrench: Any) -> dict[str, Any]:
    """Inputs of functions by their names."""
    named = {"table": table, "x": x, "sum": seen.sums, "C": seen.C, "V": seen.V, "g": seen.g}
    return named | named_turns(seen.turns) | ({} if wrench is None else {"wrench": wrench})


def share_of(lib: Library, at: System, s: Any) -> Any:
    """The column of I of flywheel s, along the freedoms of a hold."""
    return at.shares[s] if lib.layout.held else at.drives[s].I


@inline
def factor(lib: Library, table: Any, at: System) -> None:
    """Factor the mass matrix; the function returns where it is not positive definite."""
    if lib.layout.held:
        m = lib.layout.freedoms
        for k in range(m):
            for i in range(m):
                at.y[i] = 1 if i == k else 0
            lib["solve_freedoms"](at.K, at.y)
            for i in range(m):
                at.factors[i][k] = at.y[i]
    elif at.drives is None:
        lib["factor_carrier"](table, at.seen.sums, at.factors)
    else:
        lib["factor_schur"](at.K, at.factors)


@inline
def solve(lib: Library, table: Any, at: System) -> None:
    """Set y to the solution of `side`."""
    if lib.layout.held:
        for i in range(lib.layout.freedoms):
            at.y[i] = dot(at.factors[i], at.side)
    elif at.drives is None:
        lib["solve_carrier"](table, at.factors, at.R, at.y)
    else:
        lib["solve_schur"](at.factors, at.R, at.y)


@inline
def motion_of(lib: Library, table: Any, at: System) -> Any:
    """V_r_dot (6) of y."""
    V_r_dot = reals(6)  # V_r_dot
    if lib.layout.held:
        write_twist(lib, table, [at.y], V_r_dot)
    else:
        V_r_dot[:] = at.y
    if at.drift is not None:
        V_r_dot[0:3] += at.drift
    return V_r_dot


@inline
def change_of_twist(lib: Library, table: Any, j: int) -> Any:
    """The change of V with component j of the speeds."""
    d_V = reals(6)  # change of V
    for i in range(6):
        d_V[i] = table.S[i][j] if lib.layout.held else 1 if i == j else 0
    return d_V


@inline
def turn_stream(lib: Library, table: Any, at: System, d_V: Any) -> Any:
    """The change of omega x C^T stream with V, for which K times it is taken from R; None where R has no such part."""
    if at.drift is None:
        return None
    d_drift: Reals = -cross(at.seen.stream, d_V[3:6])  # change of omega x C^T stream
    lib["subtract_drift"](table, at.seen.sums, d_drift, at.R)
    return d_drift


@inline
def change_by_speed(lib: Library, table: Any, at: System, slopes: Any, j: int) -> Any:
    """Set R and `side` to the change with component j of the speeds; changes of V and of omega x C^T stream.

    `slopes`: of R without the wrench (7) by V.
    """
    held, wrench = lib.layout.held, has_changing_wrench(lib)
    d_V = change_of_twist(lib, table, j) if held or wrench else NOTHING
    if wrench:
        at.call(lib, "external_by_V", V=at.seen.V_r, d_V=d_V, d_F=at.R, d_own=at.d_own)
        for i in range(6):
            at.R[i] += dot(slopes[:, i], d_V) if held else slopes[j][i]
    elif held:
        for i in range(6):
            at.R[i] = dot(slopes[:, i], d_V)
    else:
        at.R[:] = slopes[j]
    d_drift = turn_stream(lib, table, at, d_V)
    if held:
        lib["project_wrench"](table, at.R, at.side)
    return d_V, d_drift


OWN_BY = ("external_by_V", "own_wrench_by_phi", "own_wrench_by_phi_dot")
"""Derivatives that may have changes of own wrenches of the flywheels."""


def changes_moments(lib: Library, derivative: str) -> bool:
    """Whether own wrenches of the flywheels change in a derivative: run-time wrenches alone do not."""
    return derivative in lib and "d_own" in lib.taken(derivative)


def has_changing_wrench(lib: Library) -> bool:
    """Does the wrench (7) change with V?"""
    return "external_by_V" in lib and "d_F" in lib.taken("external_by_V")


@inline
def slopes_by_speed(lib: Library, at: System) -> Any:
    """Derivatives of R without the wrench (7) by V (6, 6)."""
    R_by_V = reals(6, 6)  # derivatives of R without the wrench (7): by V1, by V2, ...
    at.call(lib, "subtract_rates_by_V", d_F=R_by_V)
    return R_by_V


@inline
def slopes_by_phase(lib: Library, table: Any, x: Any, at: System, V_r_dot: Reals, phi_ddot: Reals, s: int) -> Any:
    """Derivatives of R by phi_s, phi_s' and phi_s'' (3, 6), without the flywheel's own wrench."""
    R_by_phase = reals(3, 6)  # derivatives of R by phi, phi_dot and phi_ddot
    sine, cosine = at.seen.turns
    turn = {"s": sine[s], "c": cosine[s], "phi_dot": x.phi_dot[s], "phi_ddot": phi_ddot[s]}
    at.call(lib, "flywheel_share_by_phase", row=table.flywheel[s], V_dot=V_r_dot, d_R=R_by_phase, **turn)
    return R_by_phase


@inline
def change_by_phase(lib: Library, table: Any, at: System, slopes: Reals, s: int, by: str) -> Any:
    """Set R and `side` to the change with phi_s or phi_s'; the change of the flywheel's own moment about its axis."""
    at.R[:] = slopes
    changed = None
    if f"own_wrench_by_{by}" in lib:
        for k in range(len(lib.layout.local_bodies)):
            if table.frame[k].flywheel == s:
                frame, V_r = table.frame[k], at.seen.V_r
                at.call(lib, f"own_wrench_by_{by}", frame=frame, V=V_r, d_F=at.R, d_own=at.d_own)
        if changes_moments(lib, f"own_wrench_by_{by}"):
            changed = at.d_own[s * 6 + 3]
    if lib.layout.held:
        lib["project_wrench"](table, at.R, at.side)
    return changed


@inline
def write(lib: Library, at: System, out: Any, by: str, column: int) -> None:
    """Write y into a column of the derivatives of the carrier's motion."""
    rate, _, _, m = lib.layout.moved
    for i in range(m):
        out.member(f"{rate}_{by}")[i][column] = at.y[i]


@inline
def write_stream(lib: Library, at: System, out: Any) -> None:
    """Take d(omega x C^T stream)/d omega from the derivatives by V: V_dot = V_r_dot - (omega x C^T stream, 0)."""
    u = at.seen.stream
    if u is not None and not lib.layout.held:
        # V_dot = V_r_dot - (omega x C^T stream, 0)
        for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
            out.V_dot_V[i][3 + j] -= u[k]
            out.V_dot_V[i][3 + k] += u[j]


def add_forward_jacobian(lib: Library) -> None:
    """Adds the derivatives of V_dot, or u_dot, of forward."""
    layout = lib.layout
    _, speed, words, m = layout.moved
    by_phase = ", phi, phi_dot and phi_ddot"

    @lib.kernel(
        equation="(8)",
        purpose=f"Derivatives of forward by {speed}{by_phase}, at fixed position and attitude.",
        notes=NOTES,
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE"),
        public=True,
    )
    def forward_jacobian(
        table: Any = lib.table,
        x: Any = lib.x,
        phi_ddot: Any = lib.phi_ddot,
        wrench: Any = lib.wrench,
        out: Any = result(f"derivatives of {words}", struct=layout.forward_jacobian_result),
    ) -> Status:
        """Derivatives of forward."""
        check_inputs(lib, table, x, phi_ddot, wrench)
        at = set_up(lib, table, x, phi_ddot, wrench, False)
        factor(lib, table, at)
        solve(lib, table, at)
        V_r_dot = motion_of(lib, table, at)
        slopes = slopes_by_speed(lib, at)
        for j in range(m):
            change_by_speed(lib, table, at, slopes, j)
            solve(lib, table, at)
            write(lib, at, out, speed, j)
        write_stream(lib, at, out)
        if layout.flywheels:
            for s in range(layout.count):
                rows = slopes_by_phase(lib, table, x, at, V_r_dot, phi_ddot, s)
                for number, by in enumerate(("phi", "phi_dot", "phi_ddot")):
                    change_by_phase(lib, table, at, rows[number], s, by)
                    solve(lib, table, at)
                    write(lib, at, out, by, s)
        return OK


@inline
def reduce_by(lib: Library, at: System, t: int, side: float, inverse: Reals) -> None:
    """Take from the right-hand side what flywheel t takes by the right-hand side of its drive."""
    share = side * inverse[t]
    for i in range(len(at.side)):
        at.side[i] -= share_of(lib, at, t)[i] * share


def side_of(by: str, moment: Any, slope: Any) -> Any:
    """Change of the right-hand side of a drive with its phase, its speed or its torque; None: there is none."""
    if by == "tau":
        return real(1)
    if by == "phi_dot":
        return moment
    return -slope if moment is None else moment - slope


def left_by_speed(lib: Library, at: System, torque: Any, d_V: Any, d_drift: Any, j: Any, t: Any) -> Any:
    """Change of the right-hand side of drive t with component j of the speeds."""
    slope = -dot(torque[0:6], d_V) if lib.layout.held else -torque[j]
    moments = at.d_own if changes_moments(lib, "external_by_V") else None
    return without(with_moment(slope, moments, t), at.drives[t].I, d_drift)


def left_of_drive(side: Any, t: Any, s: Any, back: Any) -> Any:
    """What is left for drive t where the right-hand side of drive s alone changes, and the carrier takes `back`."""
    return -back if side is None else select(equal(t, s), side, real(0)) - back


def add_coupled_jacobian(lib: Library) -> None:
    """Adds the derivatives of V_dot, or u_dot, and phi_ddot of coupled."""
    layout, N, locks = lib.layout, lib.layout.count, lib.locked_argument()
    _, speed, words, m = layout.moved

    @lib.kernel(
        purpose=f"Derivatives of coupled by {speed}, phi, phi_dot and tau, at fixed position and attitude.",
        notes=NOTES,
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE"),
        public=True,
    )
    def coupled_jacobian(
        table: Any = lib.table,
        x: Any = lib.x,
        tau: Reals = argument("drive torques, mount on flywheel", N, unit="N m"),
        locked: Any = locks,
        wrench: Any = lib.wrench,
        out: Any = result(f"derivatives of {words} and phi_ddot", struct=layout.coupled_jacobian_result),
    ) -> Status:
        """Derivatives of coupled."""
        check_inputs(lib, table, x, None, wrench, (), tau)
        at = set_up(lib, table, x, None, wrench, True)
        inverse = reals(N)  # 1 / Theta_ff; 0 where a lock holds
        spins = reals(N)  # accelerations of the flywheels at V_r_dot = 0, then phi_ddot
        common = common_terms(lib, at.seen.V, at.seen.g)
        for s in range(N):
            couple_flywheel(lib, table, s, at.seen, common, at.drives[s])
            inverse[s] = table.flywheel[s].spin_inv if locked[s] == 0 else 0
            drive = at.drives[s]
            spins[s] = without(with_moment(tau[s] - drive.bias, at.seen.own, s), drive.I, at.drift) * inverse[s]
            if layout.held:
                lib["project_wrench"](table, drive.I, at.shares[s])
            lib["eliminate"](share_of(lib, at, s), inverse[s], spins[s], at.K, at.side)
        factor(lib, table, at)
        solve(lib, table, at)
        for s in range(N):
            spins[s] -= dot(share_of(lib, at, s), at.y) * inverse[s]
        V_r_dot = motion_of(lib, table, at)
        sine, cosine = at.seen.turns
        torques = reals(N, 7)  # derivatives of the drives' torques by V and phi
        for s in range(N):
            turn = {"s": sine[s], "c": cosine[s]}
            at.call(lib, "flywheel_torque_by_motion", row=table.flywheel[s], V_dot=V_r_dot, d_T=torques[s], **turn)
        # changes with the speeds: of all drives
        sides = reals(N)  # changes of what the drives have left
        slopes = slopes_by_speed(lib, at)
        for j in range(m):
            d_V, d_drift = change_by_speed(lib, table, at, slopes, j)
            for t in range(N):
                sides[t] = left_by_speed(lib, at, torques[t], d_V, d_drift, j, t)
                reduce_by(lib, at, t, sides[t], inverse)
            solve(lib, table, at)
            write(lib, at, out, speed, j)
            for t in range(N):
                out.member(f"phi_ddot_{speed}")[t][j] = (sides[t] - dot(share_of(lib, at, t), at.y)) * inverse[t]
        write_stream(lib, at, out)
        # changes with the motion and the torque of one flywheel: of its own drive
        for s in range(N):
            rows = slopes_by_phase(lib, table, x, at, V_r_dot, spins, s)
            for number, by in enumerate(("phi", "phi_dot", "tau")):
                with body().block():
                    moment = None
                    if by == "tau":
                        at.side[:] = [0] * m
                    else:
                        moment = change_by_phase(lib, table, at, rows[number], s, by)
                    left = side_of(by, moment, torques[s][6])
                    if left is not None:
                        reduce_by(lib, at, s, left, inverse)
                    solve(lib, table, at)
                    write(lib, at, out, by, s)
                    for t in range(N):
                        rest = left_of_drive(left, t, s, dot(share_of(lib, at, t), at.y))
                        out.member(f"phi_ddot_{by}")[t][s] = rest * inverse[t]
        return OK
