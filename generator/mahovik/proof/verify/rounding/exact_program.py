"""The program of a stand in ball arithmetic, on the table of its C: what the C would give if nothing were rounded.

Sine, cosine, square root and arc tangent are those of Arb, so that the program's polynomials count as rounding. The
difference to the C is the error of a function alone, its table taken as exact; that of the table is in the difference
to the literal equations.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

from flint import arb

from mahovik.core.lower.layout import Layout
from mahovik.core.program.function import Program
from mahovik.core.program.interpret import Interpreter
from mahovik.core.program.types import Precision
from mahovik.core.stand.state import State
from mahovik.proof.verify.program_backend import ProgramBackend


def of_balls(precision: Precision) -> Precision:
    """The element type with balls for numbers; those that come in are rounded to the type first, as in C."""

    def ball(x: Any) -> arb:
        return x if isinstance(x, arb) else arb(float(precision.scalar(x)))

    return replace(precision, scalar=ball)


def sincos(x: arb, sine: list[arb], cosine: list[arb]) -> None:
    """The program's function of that name."""
    sine[0], cosine[0] = x.sin_cos()


def sincos_each(x: Sequence[arb], sine: list[arb], cosine: list[arb]) -> None:
    """The program's function of that name; places beyond the angles are zero."""
    for place in range(len(sine)):
        sine[place], cosine[place] = x[place].sin_cos() if place < len(x) else (arb(0), arb(0))


def square_root(x: arb) -> arb:
    """The program's `sqrt`: of a ball that reaches below zero, of what is not."""
    return x.nonnegative_part().sqrt()


def arc_tangent(y: arb, x: arb) -> arb:
    """The program's `atan2`."""
    return arb.atan2(y, x)


ROUTINES: Mapping[str, Callable[..., Any]] = {
    "sincos": sincos,
    "sincos_each": sincos_each,
    "sqrt": square_root,
    "atan2": arc_tangent,
}


class ExactProgram(ProgramBackend):
    """Wants of a state as balls, at the working precision. `table`, `mounting`: the prepared stand."""

    def __init__(self, layout: Layout, program: Program, table: Any, mounting: Any) -> None:
        exact = replace(program, precision=of_balls(program.precision))
        interpreter = Interpreter(exact, ROUTINES)

        def run(function: str, inputs: Mapping[str, Any]) -> tuple[int, dict[str, Any]]:
            return interpreter.run(function, inputs)

        # filled once: the interpreter takes records as they are, and binary numbers are exact at any precision
        kept = interpreter.filled(layout.table, table)
        borne = None if mounting is None else interpreter.filled(layout.mount_table, mounting)
        super().__init__("exact", layout, exact, kept, borne, run)


def given_to_c(backend: ProgramBackend, state: State) -> State:
    """The state with the quaternion that the C is given: of angles, that of its own `quaternion`."""
    rounded = backend.layout.precision.scalar
    w, x, y, z = (float(rounded(element)) for element in backend.arguments(state)["x"]["attitude"])
    return replace(state, angles=None, quaternion=(w, x, y, z))
