"""identify_step: static unbalances of all flywheels from the motion of the carrier, sample by sample.

Recursive least squares in Bierman's form: the covariance is U D U^T, U unit upper triangular and D diagonal, and one
channel after the other is taken. No root and no difference of covariances is computed, so that float is enough and no
variance becomes negative (Bierman, Factorization Methods for Discrete Sequential Estimation, 1977).
"""

from __future__ import annotations

from typing import Any

from mahovik.core.lower.checks import check_number
from mahovik.core.lower.forward import STATE_STATUSES, check_inputs, external_wrench, from_stream, scene, sum_up
from mahovik.core.lower.library import Library
from mahovik.core.lower.regressor import add_proper_acceleration
from mahovik.core.program.expression import Status
from mahovik.core.program.kernel import BAD_ARGUMENT, OK, Reals, argument, changed, reals, record, result
from mahovik.core.program.vector import cross


def add_all(lib: Library) -> None:
    """Add the function with its internal ones."""
    if "proper_acceleration" not in lib:
        add_proper_acceleration(lib)
    add_unbalance_columns(lib)
    add_take_channel(lib)
    add_identify_step(lib)


def add_unbalance_columns(lib: Library) -> None:
    """Adds the wrenches of a first moment of 1 kg m along the second and the third axis of a flywheel."""

    @lib.kernel()
    def unbalance_columns(
        mount: Any = argument(struct=lib.layout.mount),
        s: float = argument("sin phi"),
        c: float = argument("cos phi"),
        phi_dot: float = argument(unit="rad/s"),
        phi_ddot: float = argument(unit="rad/s2"),
        V: Reals = argument("", 6),
        V_dot: Reals = argument("", 6),
        g: Reals = argument("gravity in E1", 3),
        Y: Reals = result("in E1 about O1", 2, 6),
    ) -> None:
        """Wrench on the carrier by the static unbalance of one flywheel along its second and third axis."""
        first, second, third = mount.axes[0::3], mount.axes[1::3], mount.axes[2::3]
        d = reals(3)  # proper acceleration of Os
        lib["proper_acceleration"](mount.origin, V, V_dot, g, d)
        w: Reals = first * phi_dot + V[3:6]  # angular velocity of the flywheel
        a: Reals = first * phi_ddot + -cross(first, V[3:6]) * phi_dot + V_dot[3:6]  # angular acceleration
        e2: Reals = second * c + third * s  # its second axis
        Y[0][0:3] = cross(a, e2) - cross(-cross(e2, w), w)
        Y[0][3:6] = cross(mount.origin, Y[0][0:3]) - cross(d, e2)
        e3: Reals = third * c - second * s  # its third axis
        Y[1][0:3] = cross(a, e3) - cross(-cross(e3, w), w)
        Y[1][3:6] = cross(mount.origin, Y[1][0:3]) - cross(d, e3)


def add_take_channel(lib: Library) -> None:
    """Adds the taking of one channel of a sample into an estimate."""
    n = lib.layout.unbalances

    @lib.kernel()
    def take_channel(
        h: Reals = argument("change of the channel by each unbalance", n),
        excess: float = argument("measured less modelled"),
        noise: float = argument("its variance, greater than 0"),
        estimate: Any = changed(struct=lib.layout.estimate),
    ) -> None:
        """Takes one channel of a sample into the estimate: Bierman's U D U^T."""
        gain = reals(n)  # D f; then U D f
        share = reals(n)  # f = U^T h
        rest: float = excess  # excess less h . unbalance
        first: int = 0  # place of a column of U
        for j in range(n):
            total: float = h[j]
            for i in range(j):
                total += estimate.factor[first + i] * h[i]
            share[j] = total
            gain[j] = estimate.variance[j] * total
            rest -= h[j] * estimate.unbalance[j]
            first = first + j
        before: float = noise  # variance of the channel by noise and the unbalances before j
        inverse: float = 1 / noise  # 1 / before
        first = 0
        for j in range(n):
            now = before + share[j] * gain[j]
            following = 1 / now
            slope = share[j] * inverse
            estimate.variance[j] = estimate.variance[j] * (before * following)
            for i in range(j):
                old = estimate.factor[first + i]
                estimate.factor[first + i] = old - gain[i] * slope
                gain[i] = gain[i] + old * gain[j]
            before = now
            inverse = following
            first = first + j
        change = rest * inverse
        for j in range(n):
            estimate.unbalance[j] += gain[j] * change


def add_identify_step(lib: Library) -> None:
    """Adds the taking of one sample into the estimate."""
    layout, n, limit = lib.layout, lib.layout.unbalances, lib.limit
    measured: Any = argument("measured derivative of the components of V", 6, unit="m/s2, rad/s2")
    spread: Any = argument(
        "standard deviation of each component of V_dot; 0: this one is not used", 6, unit="m/s2, rad/s2"
    )

    @lib.kernel(
        statuses=(*STATE_STATUSES, "BAD_ARGUMENT", "NOT_POSITIVE_DEFINITE"),
        notes=(
            "The covariance of the unbalances is U D U^T: U has 1 on its diagonal, `factor` above it column by column, "
            "and D is `variance`. An unbalance whose variance is 0 stays as it is. Signs of variances do not count.",
        ),
        public=True,
    )
    def identify_step(
        table: Any = lib.table,
        mounting: Any = argument("made once by prepare_mounts; only its places are used", struct=layout.mount_table),
        x: Any = lib.x,
        V_dot: Reals = measured,
        phi_ddot: Any = lib.phi_ddot,
        wrench: Any = lib.wrench,
        noise: Reals = spread,
        forget: float = argument("share by which variances grow before the sample, 0 to 1; 0: nothing"),
        estimate: Any = changed("start with variance = largest, the rest 0", struct=layout.estimate),
    ) -> Status:
        """Static unbalances of all flywheels from the motion of the carrier: one sample of recursive least squares."""
        check_inputs(lib, table, x, phi_ddot, wrench)
        for values in (V_dot, noise):
            lib["within"](values, 6, limit("MAX_ACCELERATION"))
        if not (forget >= 0 and forget <= 1):
            return BAD_ARGUMENT
        check_number(lib, estimate.largest, limit("MAX_PARAMETER"))
        for values in (estimate.unbalance, estimate.variance, estimate.factor):
            lib["within"](values, len(values), limit("MAX_PARAMETER"))
        seen = scene(lib, table, x)
        sum_up(lib, table, x, seen, phi_ddot)
        F = reals(6)  # wrench (7); then the right-hand side of (8)
        K = record(layout.carrier_factor)
        model = reals(6)  # V_dot of the stand in the table
        external_wrench(lib, table, x, seen, wrench, F)
        lib["subtract_rates"](table, seen.sums, seen.V, F)
        lib["factor_carrier"](table, seen.sums, K)
        lib["solve_carrier"](table, K, F, model)
        from_stream(x, seen, model)
        slopes = reals(6, n)  # of V_dot by the unbalances: -K^-1 Y
        sine, cosine = seen.turns
        for s in range(layout.count):
            Y = reals(2, 6)
            lib["unbalance_columns"](
                mounting.flywheel[s], sine[s], cosine[s], x.phi_dot[s], phi_ddot[s], x.V, V_dot, seen.g, Y
            )
            y2 = reals(6)
            lib["solve_carrier"](table, K, Y[0], y2)
            slopes[:, s * 2] = -y2
            y3 = reals(6)
            lib["solve_carrier"](table, K, Y[1], y3)
            slopes[:, s * 2 + 1] = -y3
        # old samples are forgotten, no farther than to the variance at the start
        growth = 1 + forget
        most = abs(estimate.largest)
        for j in range(n):
            grown = abs(estimate.variance[j]) * growth
            estimate.variance[j] = grown if grown < most else most
        for i in range(6):
            noise_variance = noise[i] * noise[i]
            if noise_variance >= layout.precision.smallest:
                lib["take_channel"](slopes[i], V_dot[i] - model[i], noise_variance, estimate)
        return OK
