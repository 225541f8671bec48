"""Comparison of a backend, the generated C above all, with two derivations over random and extreme states."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from mahovik.contract.functions import CHOSEN, TASK_WANTS
from mahovik.contract.limits import DOUBLE, LIMITS, Limits
from mahovik.core.stand.model import Stand, State
from mahovik.core.toolchain.process import side_by_side
from mahovik.errors import StateError
from mahovik.proof.second import Second
from mahovik.proof.second.reading import Table
from mahovik.proof.verify.backends import CasadiBackend, public_names
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.check import OTHER_TEXT, Check, Report, report
from mahovik.proof.verify.compare import Case, Rows, ordinary, same_bits
from mahovik.proof.verify.draw import check_drawing, draw_decided
from mahovik.proof.verify.files import (
    check_beside,
    check_file,
    check_options,
    check_texts,
    is_as_generated,
)
from mahovik.proof.verify.refusals import check_refusals, good_inputs, raw_call
from mahovik.proof.verify.scales import Scales
from mahovik.proof.verify.states import Backend, Request

INTERPRETED_EVERY = 8
"""The interpreter, a thousand times slower than C, runs at every eighth state."""

FUNCTION_STATES = 12
"""Ordinary states at which functions that answer no want are judged."""

NAMED = 4
"""Functions of a folder from which on the title counts them."""

Progress = Callable[[int, int], None]
"""States done, states in all."""


def applicable(state: State, want: str) -> bool:
    """Whether the contract allows this want: `generalized` of a free carrier needs angles, and a task its demand."""
    if want in TASK_WANTS:
        return bool(state.task)
    return want != "generalized" or state.quaternion is None or bool(state.u)


def judge(
    stand: Stand,
    backend: Backend,
    states: Sequence[tuple[str, State]],
    wants: Sequence[str],
    limits: Limits = DOUBLE,
    progress: Progress | None = None,
    second: Second | None = None,
    judged: str = "C",
    scales: Scales | None = None,
) -> list[Check]:
    """Checks of every quantity that `wants` give: the backend against the reference, and with `second` three ways."""
    scales, other = scales or Scales(stand, limits.real), None if second is None else CasadiBackend(stand, second)
    judges = {want: Rows(limits, scales, want, second=other, by=judged) for want in wants}
    for done, (name, state) in enumerate(states):
        for want, of_want in judges.items():
            if not applicable(state, want) or scales.want(state, want) is None:
                continue
            try:
                values, words = backend.evaluate(state, (want,)), ""
            except StateError as error:
                values, words = None, f"refused: {error}"
            of_want.compare_want(Request(name, state, (want,)), values, words=words)
        if progress is not None:
            progress(done + 1, len(states))
    rows = [row for of_want in judges.values() for row in of_want.checks()]
    compared = {row.judged for row in rows}
    return rows + [
        Check(want, "no state compared", verdict="FAILED", words="no reference has an answer at any of the states")
        for want in wants
        if want not in compared and states
    ]


def verify_c(
    stand: Stand,
    *,
    seed: int = 1,
    count: int = 200,
    against: Path | None = None,
    real: str = "double",
    progress: Progress | None = None,
    document: Table | None = None,
) -> Report:
    """Compile the generated C, fresh or of the folder `against`, without a warning, and compare it three ways.

    `document`: tables of the stand's file, None without one.
    What nothing judges in `against`, such as batch C, must be what this version generates.

    Raises ToolchainError where it does not compile, CheckError where it is of another stand.
    """
    check_drawing(seed, count, real)
    with side_by_side() as pool:
        built = pool.submit(CBackend, stand, real, against, chosen=(*CHOSEN,))
        from mahovik.proof.verify.functions.table import function_checks  # SciPy: loaded while the compiler runs

        second, scales, limits = Second(stand), Scales(stand, real, seed), LIMITS[real]
        states = draw_decided(stand, scales, seed, count, real)
        backend = built.result()
        rows = judge(stand, backend, states, backend.wants, limits, progress, second, scales=scales)
        some = ordinary(states, FUNCTION_STATES)
        rows += function_checks(Case(stand, backend, some, limits, second, scales, seed))
        rows.append(check_bits(backend, states, against))
        rows.append(check_refusals(backend.program, good_inputs(backend, states), raw_call(backend)))
        rows += [Check(name, "not in the folder") for name in backend.left_out]  # nothing judges them
    rows.append(check_file(stand, document))
    if any(a.name == "options" for f in backend.program.functions if f.public for a in f.arguments):
        options = backend.library.read(backend.library.default("default_options"))
        rows.append(check_options(options, document, limits, backend.layout.precision.largest))
    if against is not None:
        rows += [*check_texts(stand, backend.generated, against), *check_beside(stand, against)]
    judged = "generated C" if against is None else f"C in {against}"
    if backend.left_out:
        public = public_names(backend.program)
        counted = f"{len(public)} of {len(public) + len(backend.left_out)} functions"
        judged += f", only {', '.join(public) if len(public) < NAMED else counted}"
    return report(stand, judged, seed, len(states), limits.value, rows)


def check_bits(backend: CBackend, states: Sequence[tuple[str, State]], against: Path | None) -> Check:
    """Check: the interpreter of the program gives the same bits as the compiled C, so printer and compiler are right.

    C that another version generated may round otherwise: it is held to the tolerance only.
    """
    row = Check("", "interpreter = C, bit for bit")
    if against is not None and not is_as_generated(backend.generated.files, against):
        row.words = OTHER_TEXT
        return row
    if not backend.wants:
        row.words = "none of the functions answers a want; the self-test compares bits"
        return row
    for name, state in states[::INTERPRETED_EVERY]:
        for want in (want for want in backend.wants if applicable(state, want)):
            both = (_outcome(of, state, want) for of in (backend, backend.interpreter))
            if not same_bits(*both):
                row.note(math.inf, name, f"{want} differs", Request(name, state, (want,)))
                break
        else:
            row.note(0.0, name)
    return row


def _outcome(backend: Backend, state: State, want: str) -> Any:
    """Results, or the text of the refusal, which must be equal as well."""
    try:
        return backend.evaluate(state, (want,))
    except StateError as error:
        return str(error)
