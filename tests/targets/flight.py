"""A program that flies: the stand, its recorder, and a `main` that prints the log."""

from __future__ import annotations

from mahovik.core.emit.generate import generate_all
from mahovik.core.emit.literal import real_literal
from mahovik.core.emit.recorder import recorder_files
from mahovik.core.stand.model import Stand
from targets.programs import template


def flight(stand: Stand, real: str, steps: int, dt: float = 1e-3, torque: float = 0.02) -> dict[str, str]:
    """C texts by file name for `targets.build`: the stand, its recorder, and a `main` that prints the log.

    New torques are drawn for each of `steps` steps of `dt` seconds, up to `torque` N m. The stand has flywheels and no
    run-time wrenches.
    """
    generated = generate_all(stand, real)
    precision = generated.program.precision
    main = template("flight.c.j2").render(
        name=stand.name,
        NAME=stand.name.upper(),
        steps=steps,
        dt=real_literal(dt, precision),
        torque=real_literal(torque, precision),
        unit=real_literal(2.0**-15, precision),
    )
    return generated.files | recorder_files(stand, generated) | {"flight.c": main}
