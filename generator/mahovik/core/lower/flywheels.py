"""Terms of the flywheels at their phases: the loops over rows that all functions share, and the torque of a drive.

With c = cos phi, s = sin phi and their derivatives along the motion, a row of harmonics gives
  mu = mu_c c + mu_s s,  J = J_c c + J_s s + J_2c cos 2 phi + J_2s sin 2 phi      first moment and inertia about O1
  I_s phi_dot = (mu', t) phi_dot,  t = t_0 + t_c c + t_s s,  ' by the phase             momentum of the turning
and their rates. Torque: tau = mu' . (v_dot + omega x v - g) + t . omega_dot + Theta_ff phi_ddot - omega . J' omega / 2.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

from mahovik.core.lower.library import Library
from mahovik.core.program.expression import Place
from mahovik.core.program.function import Function
from mahovik.core.program.kernel import Reals, argument, changed, inline, kernel, reals, result
from mahovik.core.program.types import FLOAT
from mahovik.core.program.vector import Vector, cross, dot

Turns = tuple[Place, ...]
"""Sines and cosines of all phases, two arrays; empty where there are no flywheels."""


@inline
def turns_of(lib: Library, x: Any) -> Any:
    """Sines and cosines of the phases of a state as locals: all of them first, as none waits for another."""
    if not lib.layout.flywheels:
        return ()
    sine = reals(lib.layout.count)
    cosine = reals(lib.layout.count)
    lib["sincos_each"](x.phi, sine, cosine)
    return sine, cosine


def named_turns(turns: Turns) -> dict[str, Place]:
    """Sines and cosines by the names of the arguments that take them."""
    return dict(zip(("sine", "cosine"), turns, strict=True)) if turns else {}


MASS = ("J", "J_dot", "mu", "mu_dot")
"""Sums that K and its rate consist of. A compiler can keep their number in registers over a loop, not that of all."""
SPIN = ("h_rel", "g_rel", "a_rel")
"""The other sums, of the flywheels alone."""
STEADY_SPIN = ("a_rel", "h_rel", "g_rel")
"""The sums of the flywheels alone at constant speeds, in the order in which compilers need the fewest instructions."""
INERTIA = ("J", "J_dot", "mu")
"""MASS but for mu_dot, which goes with the other sums where states are side by side: so both loops keep their sums in
vector registers, and the second one is too long for gcc's unroll-and-jam, which halves its vectors. Small processors
need fewer instructions with the loops as they are."""
APART = {
    ("sum_mass", "sum_spin"): ("sum_inertia", "sum_turning"),
    ("sum_mass", "sum_steady_spin"): ("sum_inertia", "sum_steady_turning"),
}
"""Calls that follow one another, and those with the same arguments and results for states side by side."""


@inline
def weights(s: float, c: float, w: float, a: Any = None) -> Any:
    """Factors of a row's harmonics at a phase, and their time derivatives, for the speed w and the acceleration a."""
    c2 = 1 - 2 * (s * s)  # cos 2 phi, then sin 2 phi
    s2 = 2 * c * s
    dc = -w * s  # time derivatives: d(cos phi)/dt, ...
    ds = w * c
    dc2 = -2 * w * s2
    ds2 = 2 * w * c2
    ddc = -w * ds if a is None else -w * ds - a * s  # second time derivatives
    dds = w * dc if a is None else a * c + w * dc
    return c2, s2, dc, ds, dc2, ds2, ddc, dds


def terms_of(row: Any, s: float, c: float, w: float, a: Any, factors: Sequence[Any]) -> Any:
    """What a row gives to each of the sums, for the speed w, the acceleration a, and `weights` at the phase."""
    c2, s2, dc, ds, dc2, ds2, ddc, dds = factors
    return SimpleNamespace(
        mu=row.mu_c * c + row.mu_s * s,
        mu_dot=row.mu_c * dc + row.mu_s * ds,
        J=row.J_2c * c2 + row.J_2s * s2 + row.J_c * c + row.J_s * s,
        J_dot=row.J_2c * dc2 + row.J_2s * ds2 + row.J_c * dc + row.J_s * ds,
        h_rel=row.t_c * ds + w * row.t_0 - row.t_s * dc,
        g_rel=row.t_c * dds + (0 if a is None else a) * row.t_0 - row.t_s * ddc,
        a_rel=row.mu_c * ddc + row.mu_s * dds,
    )


@inline
def start(table: Any, sums: Any, names: Sequence[str]) -> None:
    """The sums of these names without flywheels: carrier, instruments, the constant part of the flywheels."""
    constant = {"mu": table.first_moment, "J": table.inertia}
    for name in names:
        sums.member(name)[:] = constant.get(name, [0] * len(sums.member(name)))


def start_sums(lib: Library) -> Function:
    """The sums without flywheels' harmonics: constants of the table."""

    @kernel(equation="(2)")
    def start_sums(table: Any = lib.table, sum_: Any = result(struct=lib.layout.sums)) -> None:
        """Sums of carrier, instruments and the constant part of the flywheels."""
        start(table, sum_, ("mu", "J", "mu_dot", "J_dot", *SPIN))

    return start_sums


def sum_mass(lib: Library, apart: bool = False) -> Function:
    """First moment and inertia of all bodies, and their rates: row by row, in a loop of its own.

    `apart`: sum_inertia, without the rate of the first moment.
    """
    N, names = lib.layout.count, INERTIA if apart else MASS
    # In float J goes in a loop: a third of the code, which small processors lack; desktop ones are slower with it.
    short = lib.layout.precision is FLOAT
    purpose = "Inertia of all bodies and its rate in E1, and their first moment; w = phi_dot."

    @kernel("sum_inertia" if apart else "sum_mass", equation="(2), (6)", purpose=purpose if apart else "")
    def sum_mass(
        table: Any = lib.table,
        sine: Reals = lib.sine,
        cosine: Reals = lib.cosine,
        phi_dot: Reals = argument("", N, unit="rad/s"),
        sum_: Any = changed(struct=lib.layout.sums),
    ) -> None:
        """First moment and inertia of all bodies, and their rates in E1; w = phi_dot."""
        start(table, sum_, names)
        for k in range(N):
            row = table.flywheel[k]
            s = sine[k]
            c = cosine[k]
            w = phi_dot[k]
            factors = weights(s, c, w)
            terms = terms_of(row, s, c, w, None, factors)
            if short:
                c2, s2, dc, ds, dc2, ds2, _, _ = factors
                # inertia
                for i in range(6):
                    sum_.J[i] += row.J_2c[i] * c2 + row.J_2s[i] * s2 + row.J_c[i] * c + row.J_s[i] * s
                    sum_.J_dot[i] += row.J_2c[i] * dc2 + row.J_2s[i] * ds2 + row.J_c[i] * dc + row.J_s[i] * ds
            else:
                # inertia
                sum_.J += terms.J
                # its rate: K_dot of (6)
                sum_.J_dot += terms.J_dot
            # first moment and its rate
            sum_.mu += terms.mu
            if not apart:
                sum_.mu_dot += terms.mu_dot

    return sum_mass


def sum_spin(lib: Library, steady: bool = False, apart: bool = False) -> Function:
    """Terms of the flywheels' turning; `steady`: sum_steady_spin, at constant speeds.

    `apart`: sum_turning, sum_steady_turning, with the rate of the first moment. Products with a phi_ddot of 0 are left
    out, which leaves the sums as they are: they begin with +0, and a zero of any sign added to them changes nothing.
    """
    N = lib.layout.count
    names = (*(("mu_dot",) if apart else ()), *(STEADY_SPIN if steady else SPIN))
    purpose = (
        ("Rate of the first moment, and terms" if apart else "Terms")
        + " of the flywheels' turning in momentum and forces; w = phi_dot"
        + (" is constant." if steady else ", a = phi_ddot.")
    )
    name = f"sum_{'steady_' if steady else ''}{'turning' if apart else 'spin'}"

    @kernel(name, equation="(2), (5)", purpose=purpose, copied=not apart)
    def sum_spin(
        table: Any = lib.table,
        sine: Reals = lib.sine,
        cosine: Reals = lib.cosine,
        phi_dot: Reals = argument("", N, unit="rad/s"),
        phi_ddot: Any = None if steady else argument("", N, unit="rad/s2"),
        sum_: Any = changed(struct=lib.layout.sums),
    ) -> None:
        """Terms of the flywheels' turning in momentum and forces."""
        start(table, sum_, names if apart else SPIN)
        for k in range(N):
            row = table.flywheel[k]
            s = sine[k]
            c = cosine[k]
            w = phi_dot[k]
            a = None if steady else phi_ddot[k]
            terms = terms_of(row, s, c, w, a, weights(s, c, w, a))
            for name in names:
                if name == "h_rel":
                    # moment part of I phi_dot (its force part is mu_dot)
                    sum_.h_rel += terms.h_rel
                elif name == "a_rel":
                    # I phi_ddot + Ls [<e>] Theta f phi_dot^2, the last two sums of (5)
                    sum_.a_rel += terms.a_rel
                else:
                    sum_.member(name)[:] += getattr(terms, name)

    return sum_spin


@inline
def sum_up(lib: Library, table: Any, x: Any, turns: Turns, sums: Any, phi_ddot: Any, mass_alone: bool = False) -> None:
    """Sums over all bodies; without phi_ddot those of constant speeds. `mass_alone`: what K and K_dot need."""
    if not lib.layout.flywheels:
        lib["start_sums"](table, sums)
    else:
        lib["sum_mass"](table, *turns, x.phi_dot, sums)
        if phi_ddot is not None:
            lib["sum_spin"](table, *turns, x.phi_dot, phi_ddot, sums)
        elif not mass_alone:
            lib["sum_steady_spin"](table, *turns, x.phi_dot, sums)


def column_of(row: Any, s: Any, c: Any) -> Vector:
    """I_s = (mu', t) of (9)."""
    return Vector([*(row.mu_s * c - row.mu_c * s), *(row.t_c * c + row.t_s * s + row.t_0)])


def couple(lib: Library) -> Function:
    """I_s, and the torque at V_dot = 0, phi_ddot = 0, of one flywheel."""
    displaces = lib.layout.flywheel_displaces

    @kernel(equation="(9)", copied=True)
    def couple(
        row: Any = argument(struct=lib.layout.row),
        s: float = argument("sin phi"),
        c: float = argument("cos phi"),
        origin_acceleration: Reals = argument("omega x v, minus gravity", 3, unit="m/s2"),
        spun: Reals = argument("products of omega", 6, unit="rad2/s2"),
        g: Reals = argument("gravity in E1", 3, unit="m/s2"),
        out: Any = result(struct=lib.layout.coupling),
    ) -> None:
        """Column of I of one flywheel, and its drive torque at V_dot = 0, phi_ddot = 0."""
        two_c2 = 2 - 4 * (s * s)  # twice the cosine and sine of the double phase
        two_s2 = 4 * c * s
        out.I[:] = column_of(row, s, c)
        # dJ / dphi
        J_p = row.J_2s * two_c2 + row.J_s * c - row.J_2c * two_s2 - row.J_c * s
        displaced_p = Vector([])
        if displaces:
            # derivative of the displaced first moment
            displaced_p = row.displaced_s * c - row.displaced_c * s
        out.bias = dot((*J_p, *displaced_p, *out.I[0:3]), (*spun, *g[0 : len(displaced_p)], *origin_acceleration))

    return couple


@dataclass(frozen=True)
class Carried:
    """Quantities common to all flywheels: origin_acceleration = omega x v - g (3), spun: products of omega (6)."""

    origin_acceleration: Any
    spun: Any


@inline
def common_terms(lib: Library, V: Reals, g: Reals) -> Any:
    """Both, as locals."""
    v, omega = V[0:3], V[3:6]
    if lib.layout.weight:
        origin_acceleration: Reals = -g + cross(omega, v)  # acceleration of O1 at V_dot = 0, minus gravity
    else:
        origin_acceleration: Reals = cross(omega, v)  # omega x v
    spun = reals(6)  # six numbers: J . spun = -omega . J omega / 2 for every inertia J
    spun[0:3] = [-0.5 * (w * w) for w in omega]
    spun[3:6] = [-omega[i] * omega[j] for i, j in ((0, 1), (0, 2), (1, 2))]
    return Carried(origin_acceleration, spun)


@inline
def couple_flywheel(lib: Library, table: Any, s: int, seen: Any, common: Any, out: Any) -> None:
    """I_s and the bias torque of flywheel s into `out`."""
    sine, cosine = seen.turns
    lib["couple"](table.flywheel[s], sine[s], cosine[s], common.origin_acceleration, common.spun, seen.g, out)


def along(column: Any, V_dot: Any) -> Any:
    """I_s . V_dot."""
    return dot(V_dot, column)
