"""identify_step: static unbalances of all flywheels from the motion of the carrier, sample by sample.

Recursive least squares in Bierman's form: the covariance is U D U^T, U unit upper triangular and D diagonal, and one
channel after the other is taken. No root and no difference of covariances is computed, so that float is enough and no
variance becomes negative (Bierman, Factorization Methods for Discrete Sequential Estimation, 1977).
"""

from __future__ import annotations

from typing import Any

from mahovik.core.formula.derived import regressor as derived
from mahovik.core.lower.flywheels import turn_of
from mahovik.core.lower.forward import STATE_STATUSES, check_inputs, external_wrench, from_stream, scene, sum_up
from mahovik.core.lower.library import Library
from mahovik.core.lower.regressor import flywheel_arguments, proper_acceleration
from mahovik.core.lower.symbolic import assign
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Not, Place, and_, integer, magnitude, real, select
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind


def add_all(lib: Library) -> None:
    """Add the function with its internal ones."""
    if "proper_acceleration" not in lib:
        lib.add(proper_acceleration(lib))
    lib.add(unbalance_columns(lib))
    lib.add(take_channel(lib))
    lib.add(identify_step(lib))


def unbalance_columns(lib: Library) -> Function:
    """Wrenches of a first moment of 1 kg m along the second and the third axis of a flywheel."""
    mount, s, c, phi_dot, phi_ddot, V, V_dot, g = flywheel_arguments(lib)
    Y = Argument("Y", Kind.REAL, (2, 6), "out", purpose="in E1 about O1")
    body = Body()
    m = mount.place
    d = body.local("d", (3,), comment="proper acceleration of Os")
    named: dict[str, Any] = {"O": m.origin, "V": V.place, "V_dot": V_dot.place, "g": g.place, "d": d}
    body.call(lib["proper_acceleration"], *lib.arguments_of("proper_acceleration", **named))
    bound: dict[str, Any] = {"omega": list(V.place)[3:], "omega_dot": list(V_dot.place)[3:]}
    bound |= {"axis": [m.axes[3 * i] for i in range(3)], "phi_dot": phi_dot.place, "phi_ddot": phi_ddot.place}
    w = body.local("w", (3,), comment="angular velocity of the flywheel")
    a = body.local("a", (3,), comment="angular acceleration")
    assign(body, list(w), derived.spinning_velocity(), bound)
    assign(body, list(a), derived.spinning_acceleration(), bound)
    axes = derived.turned_axes()
    for k in range(2):
        e = body.local(f"e{k + 2}", (3,), comment="its second axis" if k == 0 else "its third axis")
        assign(body, list(e), axes[:, k + 1], {"R": m.axes, "c": c.place, "s": s.place})
        six = list(Y.place[k])
        known = {"e": e, "O": m.origin, "d": d, "a": a, "w": w}
        force, moment = derived.first_moment_force(), derived.first_moment_moment()
        assign(body, six[:3], force, known)
        assign(body, six[3:], moment, known | {"f": six[:3]})
    return body.function(
        "unbalance_columns",
        "Wrench on the carrier by the static unbalance of one flywheel along its second and third axis.",
        (mount, s, c, phi_dot, phi_ddot, V, V_dot, g, Y),
    )


def take_channel(lib: Library) -> Function:
    """One channel of a sample into an estimate."""
    n = lib.layout.unbalances
    h = Argument("h", Kind.REAL, (n,), purpose="change of the channel by each unbalance")
    excess = Argument("excess", Kind.REAL, purpose="measured less modelled")
    noise = Argument("noise", Kind.REAL, purpose="its variance, greater than 0")
    estimate = Argument("estimate", lib.layout.estimate, (), "inout")
    body = Body()
    at = estimate.place
    gain = body.local("gain", (n,), comment="D f; then U D f")
    share = body.local("share", (n,), comment="f = U^T h")
    rest = body.local("rest", comment="excess less h . unbalance")
    body.set(rest, excess.place)
    first = body.local("first", (), Kind.INT, "place of a column of U")
    body.set(first, integer(0))
    with body.loop("j", n) as j:
        total = body.local("total")
        body.set(total, h.place[j])
        with body.loop("i", j, most=n - 1) as i:
            body.add(total, at.factor[first + i] * h.place[i])
        body.set(share[j], total)
        body.set(gain[j], at.variance[j] * total)
        body.add(rest, -(h.place[j] * at.unbalance[j]))
        body.set(first, first + j)
    before = body.local("before", comment="variance of the channel by noise and the unbalances before j")
    inverse = body.local("inverse", comment="1 / before")
    body.set(before, noise.place)
    body.set(inverse, 1 / noise.place)
    body.set(first, integer(0))
    with body.loop("j", n) as j:
        now = body.let("now", before + share[j] * gain[j])
        following = body.let("following", 1 / now)
        slope = body.let("slope", share[j] * inverse)
        body.set(at.variance[j], at.variance[j] * (before * following))
        with body.loop("i", j, most=n - 1) as i:
            old = body.let("old", at.factor[first + i])
            body.set(at.factor[first + i], old - gain[i] * slope)
            body.set(gain[i], gain[i] + old * gain[j])
        body.set(before, now)
        body.set(inverse, following)
        body.set(first, first + j)
    change = body.let("change", rest * inverse)
    with body.loop("j", n) as j:
        body.add(at.unbalance[j], gain[j] * change)
    return body.function(
        "take_channel",
        "Takes one channel of a sample into the estimate: Bierman's U D U^T.",
        (h, excess, noise, estimate),
    )


def identify_step(lib: Library) -> Function:
    """One sample into the estimate."""
    layout = lib.layout
    n = layout.unbalances
    table, x = lib.table_argument(), lib.state_argument()
    mounting = Argument("mounting", layout.mount_table, purpose="made once by prepare_mounts; only its places are used")
    V_dot = Argument(
        "V_dot", Kind.REAL, (6,), unit="m/s2, rad/s2", purpose="measured derivative of the components of V"
    )
    phi_ddot, wrench = lib.phi_ddot_arguments(), lib.wrench_arguments()
    purpose = "standard deviation of each component of V_dot; 0: this one is not used"
    noise = Argument("noise", Kind.REAL, (6,), unit="m/s2, rad/s2", purpose=purpose)
    forget = Argument(
        "forget", Kind.REAL, purpose="share by which variances grow before the sample, 0 to 1; 0: nothing"
    )
    estimate = Argument("estimate", layout.estimate, (), "inout", purpose="start with variance = largest, the rest 0")
    body = Body()
    check_inputs(lib, body, table, x, phi_ddot, wrench)
    lib.check(body, "within", V_dot.place, 6, lib.limits["MAX_ACCELERATION"].expression)
    lib.check(body, "within", noise.place, 6, lib.limits["MAX_ACCELERATION"].expression)
    lib.guard(body, Not(and_(forget.place >= 0, forget.place <= 1)), "BAD_ARGUMENT")
    at, limit = estimate.place, lib.limits["MAX_PARAMETER"].expression
    lib.check_number(body, at.largest, limit)
    for name in ("unbalance", "variance", "factor"):
        lib.check(body, "within", at.member(name), len(at.member(name)), limit)
    seen = scene(lib, body, table.place, x.place)
    sum_up(lib, body, table.place, x.place, seen, phi_ddot[0].place)
    F = body.local("F", (6,), comment="wrench (7); then the right-hand side of (8)")
    K = body.local("K", (), layout.carrier_factor)
    model = body.local("model", (6,), comment="V* of the stand in the table")
    external_wrench(lib, body, table.place, x.place, seen, wrench, F)
    body.call(lib["subtract_rates"], table.place, seen.sums, seen.V, F)
    lib.check(body, "factor_carrier", table.place, seen.sums, K)
    body.call(lib["solve_carrier"], *lib.arguments_of("solve_carrier", table=table.place, K=K, F=F, y=model))
    from_stream(body, x.place, seen, model)
    slopes = body.local("slopes", (6, n), comment="of V* by the unbalances: -K^-1 Y")
    with body.loop("s", layout.count) as s:
        Y = body.local("Y", (2, 6))
        named: dict[str, Any] = {
            "mount": mounting.place.flywheel[s],
            **turn_of(seen.turns, s),
            "phi_dot": x.place.phi_dot[s],
            "phi_ddot": phi_ddot[0].place[s],
            "V": x.place.V,
            "V_dot": V_dot.place,
            "g": seen.g,
            "Y": Y,
        }
        body.call(lib["unbalance_columns"], *lib.arguments_of("unbalance_columns", **named))
        for k in range(2):
            y = body.local(f"y{k + 2}", (6,))
            body.call(lib["solve_carrier"], *lib.arguments_of("solve_carrier", table=table.place, K=K, F=Y[k], y=y))
            for i in range(6):
                body.set(slopes[i][s * integer(2) + integer(k)], -y[i])
    _grow(body, at, forget.place, n)
    with body.loop("i", 6) as channel:
        variance = body.let("noise_variance", noise.place[channel] * noise.place[channel])
        with body.when(variance >= real(layout.precision.smallest)):
            body.call(lib["take_channel"], slopes[channel], V_dot.place[channel] - model[channel], variance, at)
    return body.checked_function(
        "identify_step",
        "Static unbalances of all flywheels from the motion of the carrier: one sample of recursive least squares.",
        (table, mounting, x, V_dot, *phi_ddot, *wrench, noise, forget, estimate),
        statuses=(*STATE_STATUSES, "BAD_ARGUMENT", "NOT_POSITIVE_DEFINITE"),
        notes=(
            "The covariance of the unbalances is U D U^T: U has 1 on its diagonal, `factor` above it column by column, "
            "and D is `variance`. An unbalance whose variance is 0 stays as it is. Signs of variances do not count.",
        ),
        public=True,
    )


def _grow(body: Body, at: Place, forget: Place, n: int) -> None:
    """Old samples are forgotten: variances grow, up to the largest."""
    body.note("old samples are forgotten, no farther than to the variance at the start")
    growth = body.let("growth", 1 + forget)
    most = body.let("most", magnitude(at.largest))
    with body.loop("j", n) as j:
        grown = body.let("grown", magnitude(at.variance[j]) * growth)
        body.set(at.variance[j], select(grown < most, grown, most))
