"""A programme from Fourier coefficients: one sine and cosine, the others by the angle sum, harmonic by harmonic."""

from __future__ import annotations

from mahovik.core.lower.library import Library
from mahovik.core.lower.programme.form import SECTORS, Form
from mahovik.core.lower.programme.place import check_phase, phase_argument, phase_of_winding, spot
from mahovik.core.lower.programme.quintic import output_arguments
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import real, select
from mahovik.core.program.function import Function
from mahovik.core.routines.real_constants import PI, nearest


def fourier(lib: Library, form: Form) -> Function:
    """`..._course(table, phase, phi, phi_dot, phi_ddot, tau)` of a Fourier table."""
    table, phase = Argument("table", form.table), phase_argument(form.cyclic)
    outputs = output_arguments(form)
    phi, phi_dot, phi_ddot = (a.place for a in outputs[:3])
    t = table.place
    body = Body()
    check_phase(lib, body, phase.place, form.cyclic)
    at = spot(lib, body, phase.place, SECTORS, form.cyclic)
    body.note("Sine and cosine of k 2 pi phase, from k = 1 on by the sum of angles.")
    sine_1, cosine_1 = body.local("sine_1"), body.local("cosine_1")
    centred = body.let("centred", select(phase.place > 0.5, phase.place - real(1), phase.place))
    body.call(lib["sincos"], centred * real(nearest(2 * PI, lib.layout.precision)), sine_1, cosine_1)
    sine, cosine = body.local("sine"), body.local("cosine")
    k = body.local("k")
    body.set(sine, sine_1)
    body.set(cosine, cosine_1)
    body.set(k, real(0))
    with body.loop("s", form.count) as s:
        body.set(phi[s], t.mean[s])
        body.set(phi_dot[s], real(0))
        body.set(phi_ddot[s], real(0))
        if form.torque:
            body.set(outputs[3].place[s], t.tau_mean[s])
    with body.loop("i", form.size) as i:
        row = t.harmonic[i]
        body.add(k, real(1))
        with body.loop("s", form.count) as s:
            value = body.let("value", row.cos[s] * cosine + row.sin[s] * sine)
            slope = body.let("slope", row.sin[s] * cosine - row.cos[s] * sine)
            body.add(phi[s], value)
            body.add(phi_dot[s], k * slope)
            body.set(phi_ddot[s], phi_ddot[s] - k * k * value)
            if form.torque:
                body.add(outputs[3].place[s], row.tau_cos[s] * cosine + row.tau_sin[s] * sine)
        turned_cosine = body.let("turned_cosine", cosine * cosine_1 - sine * sine_1)
        body.set(sine, sine * cosine_1 + cosine * sine_1)
        body.set(cosine, turned_cosine)
    with body.loop("s", form.count) as s:
        angle = phase_of_winding(lib, body, t.winding[s], at, SECTORS) + phi[s]
        body.set(phi[s], lib["wrapped"](angle))
        body.set(phi_dot[s], t.speed[s] + t.omega * phi_dot[s])
        body.set(phi_ddot[s], t.omega * t.omega * phi_ddot[s])
    return body.checked_function(
        f"{form.prefix}course",
        "Angles, speeds and accelerations of all flywheels from Fourier coefficients.",
        (table, phase, *outputs),
    )
