"""Slow trim of a programme: adaptive harmonic correction by measured motion of the carrier.

A round is `settling` samples of waiting, `window` samples over which the carrier's coordinates are multiplied with
1, cos k theta, sin k theta (synchronous detection, theta = 2 pi phase), and one sample a flywheel in which its
corrections lose matrix times error. So no sample costs much more than another. Corrections are Fourier coefficients of
each flywheel's angle; what is applied follows them smoothly.
"""

from __future__ import annotations

from mahovik.core.lower.library import Library
from mahovik.core.lower.programme import MOST, check_phase
from mahovik.core.lower.servo.form import ServoForm, TrimForm
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import (
    Convert,
    Not,
    Place,
    Status,
    and_,
    equal,
    integer,
    or_,
    real,
    select,
    unequal,
)
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind
from mahovik.core.routines.real_constants import PI, nearest


def reset(form: ServoForm) -> Function:
    """`trim_reset(state)`."""
    state = Argument("state", form.trim_state, (), "out", "", "nothing measured, nothing corrected")
    trim = _of(form)
    x = state.place
    body = Body()
    body.set(x.sample, integer(0))
    body.set(x.rounds, integer(0))
    with body.loop("c", trim.measured) as c, body.loop("i", trim.terms) as i:
        body.set(x.member("sum")[c][i], real(0))
    with body.loop("s", form.count) as s, body.loop("i", trim.terms) as i:
        body.set(x.wanted[s][i], real(0))
        body.set(x.present[s][i], real(0))
    return body.checked_function("trim_reset", "A trim without corrections.", (state,), statuses=("OK",), public=True)


def basis(lib: Library, form: ServoForm) -> Function:
    """`trim_basis(phase, basis)`: 1, then cosine and sine of each harmonic."""
    trim = _of(form)
    phase = Argument("phase", Kind.REAL, purpose="in [0, 1)")
    out = Argument("basis", Kind.REAL, (trim.terms,), "out", "", "1, cos theta, sin theta, cos 2 theta ...")
    b = out.place
    body = Body()
    sine, cosine = body.local("sine"), body.local("cosine")
    centred = body.let("centred", select(phase.place > 0.5, phase.place - real(1), phase.place))
    body.call(lib["sincos"], centred * real(nearest(2 * PI, lib.layout.precision)), sine, cosine)
    body.set(b[0], real(1))
    body.set(b[1], cosine)
    body.set(b[2], sine)
    if trim.harmonics > 1:
        with body.loop("k", trim.harmonics, 1) as k:
            before, after = k + k - integer(1), k + k + integer(1)
            body.set(b[after], b[before] * cosine - b[before + integer(1)] * sine)
            body.set(b[after + integer(1)], b[before + integer(1)] * cosine + b[before] * sine)
    return lib.add(
        body.function(
            "trim_basis",
            "1, then cosine and sine of each harmonic of theta = 2 pi phase, by the sum of angles.",
            (phase, out),
        )
    )


def measure(lib: Library, form: ServoForm) -> Function:
    """`trim_measure(design, sample, basis, q, sum)`: what one sample adds, and the error at the end of the window."""
    trim = _of(form)
    design, sample = Argument("design", form.design), Argument("sample", Kind.INT)
    functions = Argument("basis", Kind.REAL, (trim.terms,))
    q = Argument("q", Kind.REAL, (trim.measured,))
    total = Argument("sum", Kind.REAL, (trim.measured, trim.terms), "inout")
    d, n = design.place, sample.place
    body = Body()
    first, last = d.settling, d.settling + d.window
    with body.when(and_(n >= first, n < last)):
        with body.loop("c", trim.measured) as c, body.loop("i", trim.terms) as i:
            before = select(equal(n, first), real(0), total.place[c][i])
            body.set(total.place[c][i], before + q.place[c] * functions.place[i])
        with body.when(equal(n, last - integer(1)), "what was measured, less what is wanted"):
            scale = body.let("scale", real(1) / Convert(d.window, Kind.REAL))
            with body.loop("c", trim.measured) as c, body.loop("i", trim.terms) as i:
                mean = body.let("mean", total.place[c][i] * scale)
                body.set(total.place[c][i], select(equal(i, integer(0)), mean, real(2) * mean) - d.target[c][i])
    return lib.add(
        body.function(
            "trim_measure",
            "Inside the window: what one sample adds; at its last sample the error.",
            (design, sample, functions, q, total),
        )
    )


def correct(lib: Library, form: ServoForm) -> Function:
    """`trim_correct(design, s, state)`: the corrections of one flywheel lose matrix times error."""
    trim = _of(form)
    design, flywheel = Argument("design", form.design), Argument("s", Kind.INT)
    state = Argument("state", form.trim_state, (), "inout")
    d, terms = design.place, integer(trim.terms)
    error, wanted = state.place.member("sum"), state.place.wanted[flywheel.place]
    body = Body()
    cut = body.local("cut", (), Kind.INT)
    body.set(cut, integer(0))
    with body.loop("j", trim.terms) as j:
        row = body.let("row", flywheel.place * terms + j)
        found = body.local("found")
        body.set(found, wanted[j])
        with body.loop("c", trim.measured) as c, body.loop("i", trim.terms) as i:
            body.set(found, found - d.matrix[row][c * terms + i] * error[c][i])
        inside = body.let("inside", lib["clamped"](found, -d.limit, d.limit))
        body.set(cut, select(or_(inside < found, inside > found), integer(1), cut))
        body.set(wanted[j], inside)
    with body.when(unequal(cut, integer(0))):
        body.ret(Status("LIMITED"))
    return lib.add(
        body.checked_function(
            "trim_correct",
            "The corrections of one flywheel less matrix times error, inside the limit.",
            (design, flywheel, state),
            statuses=("OK", "LIMITED"),
        )
    )


def step(lib: Library, form: ServoForm) -> Function:
    """`trim_step(design, state, phase, q, phi, phi_dot, tau)`."""
    trim, n = _of(form), (form.count,)
    design = Argument("design", form.design, purpose="as the generator made it")
    state = Argument("state", form.trim_state, (), "inout", "", "what trim_reset made")
    phase = Argument("phase", Kind.REAL, purpose="of the programme's clock at this sample, in [0, 1)")
    measured = "measured coordinates of the carrier" + (": `q` of generalized" if trim.held else "")
    q = Argument("q", Kind.REAL, (trim.measured,), unit="m, rad", purpose=measured)
    phi = Argument("phi", Kind.REAL, n, "inout", "rad", "wanted angles of the programme; corrected")
    phi_dot = Argument("phi_dot", Kind.REAL, n, "inout", "rad/s", "wanted speeds; corrected")
    tau = Argument("tau", Kind.REAL, n, "inout", "N m", "feedforward; corrected")
    d, x = design.place, state.place
    body = Body()
    check_phase(lib, body, phase.place, True)
    limit = {name: found.expression for name, found in lib.limits.items()}
    lib.check(body, "within", q.place, trim.measured, limit["MAX_POSITION"])
    for place, most in ((phi, "MAX_PHASE"), (phi_dot, "MAX_SPEED"), (tau, "MAX_WRENCH")):
        lib.check(body, "within", place.place, form.count, limit[most])
    end = body.let("end", d.settling + d.window)
    good = and_(and_(x.sample >= 0, x.rounds >= 0), x.sample < end + integer(form.count))
    lib.guard(body, Not(good), "BAD_ARGUMENT")
    functions = body.local("basis", (trim.terms,))
    body.call(lib["trim_basis"], phase.place, functions)
    body.call(lib["trim_measure"], design.place, x.sample, functions, q.place, x.member("sum"))
    outcome = body.local("outcome", (), Kind.STATUS)
    body.set(outcome, Status("OK"))
    with body.when(x.sample >= end, "one flywheel a sample"):
        s = body.let("s", x.sample - end)
        body.set(outcome, lib["trim_correct"](design.place, s, x))
    body.set(x.sample, x.sample + integer(1))
    with body.when(Not(x.sample < end + integer(form.count)), "the next round"):
        body.set(x.sample, integer(0))
        body.set(x.rounds, x.rounds + select(x.rounds < MOST, integer(1), integer(0)))
    with body.loop("s", form.count) as s:
        _apply(body, form, d, x.wanted[s], x.present[s], functions, s, phi.place, phi_dot.place, tau.place)
    body.ret(outcome)
    return Function(
        "trim_step",
        "One sample of the trim: measures the carrier, and corrects what the programme wants.",
        (design, state, phase, q, phi, phi_dot, tau),
        body.statements,
        returns=Kind.STATUS,
        statuses=("OK", "LIMITED", "NOT_FINITE", "RANGE", "BAD_ARGUMENT"),
        notes=(
            "A round: the carrier settles, its coordinates are measured over whole periods, their harmonics compared "
            "with the target, and the angles corrected through the constant matrix, one flywheel a sample. LIMITED: a "
            "correction reached its limit.",
        ),
        public=True,
    )


def _apply(
    body: Body, form: ServoForm, d: Place, wanted: Place, present: Place, functions: Place, s: Place,
    phi: Place, phi_dot: Place, tau: Place,
) -> None:  # fmt: skip
    """Adds the corrections of one flywheel to its angle, speed and torque."""
    trim = _of(form)
    angle, rate, bend = body.local("angle"), body.local("rate"), body.local("bend")
    with body.loop("i", trim.terms) as i:
        body.add(present[i], d.smoothing * (wanted[i] - present[i]))
    body.set(angle, present[0])
    body.set(rate, real(0))
    body.set(bend, real(0))
    with body.loop("k", trim.harmonics + 1, 1) as k:
        at = body.let("at", k + k - integer(1))
        turn = body.let("turn", Convert(k, Kind.REAL) * d.omega)
        cosine, sine = functions[at], functions[at + integer(1)]
        value = body.let("value", present[at] * cosine + present[at + integer(1)] * sine)
        body.add(angle, value)
        body.add(rate, turn * (present[at + integer(1)] * cosine - present[at] * sine))
        body.set(bend, bend - turn * turn * value)
    body.add(phi[s], angle)
    body.add(phi_dot[s], rate)
    body.add(tau[s], d.inertia[s] * bend)


def _of(form: ServoForm) -> TrimForm:
    assert form.trim is not None
    return form.trim
