"""Judging a backend, the generated C in particular, by two derivations, over random and extreme states."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof.second import Second
from mahovik.proof.verify.backends import Backend
from mahovik.proof.verify.batch import batch_row
from mahovik.proof.verify.bounds import BOUNDS, DOUBLE, Bounds
from mahovik.proof.verify.compare import Judge, Row, same_bits
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.refusals import refusals
from mahovik.proof.verify.report import Report
from mahovik.proof.verify.states import Request

if TYPE_CHECKING:
    from mahovik.proof.verify.c_backend import CBackend

INVERSE_EVERY = 8
"""The interpreter runs `inverse`, tens of thousands of operations, on one state of so many."""

Progress = Callable[[int, int], None]
"""States done, states in all."""


def askable(state: State, want: str) -> bool:
    """Whether the contract lets a state ask for it: `generalized` wants angles."""
    return want != "generalized" or state.quaternion is None


def judge(
    stand: Stand,
    backend: Backend,
    states: Sequence[tuple[str, State]],
    wants: Sequence[str],
    bounds: Bounds = DOUBLE,
    progress: Progress | None = None,
    second: Second | None = None,
    judged: str = "C",
) -> list[Row]:
    """Rows of every quantity that `wants` give: the backend against the reference, and with `second` three ways."""
    found = Judge(stand, bounds, second, judged)
    for done, (name, state) in enumerate(states):
        for want in wants:
            if not askable(state, want):
                continue
            request = Request(name, state, (want,))
            if found.expected(state, want) is None:
                continue
            try:
                found.compare(request, want, backend.evaluate(state, (want,)))
            except StateError as error:
                found.refused(request, want, f"refused: {error}")
        if progress is not None:
            progress(done + 1, len(states))
    return found.rows()


def verify_c(
    stand: Stand,
    *,
    seed: int = 1,
    count: int = 200,
    against: Path | None = None,
    real: str = "double",
    lanes: int | None = None,
    fast: bool = False,
    progress: Progress | None = None,
    wrenches: bool = True,
    backend: CBackend | None = None,
) -> Report:
    """Generated C, fresh or as it lies in `against`: compiled without a warning, and judged three ways.

    `lanes`, `fast`: as CBackend has them. C for speed is held to the same tolerances, not to the interpreter's bits.
    `wrenches`: run-time wrenches on every body, for which fresh C is compiled once more, with all its inputs.
    `backend`: of these options, where the caller has it.
    Batch C in `against` must be what this version generates.

    Raises ToolchainError where it does not compile, CheckError where it is of another stand.
    """
    from mahovik.proof.verify.c_backend import CBackend

    backend = backend or CBackend(stand, real, against, lanes, fast)
    states = draw(stand, seed, count, real, wrenches=wrenches and against is None)
    rows = judge(stand, backend, states, backend.wants, BOUNDS[real], progress, Second(stand))
    rows.append(bits(backend, states, against))
    rows.append(refusals(backend.program, _good_inputs(backend, states), _raw(backend)))
    beside = None if against is None else batch_row(stand, backend.generated, against)
    rows += [] if beside is None else [beside]
    judged = "generated C" if against is None else f"C in {against}"
    judged += f", lanes {backend.layout.lanes}" if backend.layout.lanes > 1 else ""
    judged += ", fast" if backend.fast else ""
    return report(stand, judged, seed, len(states), BOUNDS[real].default, rows)


def report(
    stand: Stand, judged: str, seed: int, count: int, tolerance: float, rows: Sequence[Row], error: str = ""
) -> Report:
    """The report of these rows on a stand."""
    names = identities(stand)
    return Report(stand.name, names.structure, names.physics, judged, seed, count, tolerance, tuple(rows), error)


def bits(backend: CBackend, states: Sequence[tuple[str, State]], against: Path | None) -> Row:
    """The interpreter of the program gives the same bits as the compiled C: printer, templates and compiler are right.

    C that another version generated may round otherwise: it is held to the tolerance only.
    """
    row = Row("", "interpreter = C, bit for bit", verdict="ok")
    if backend.fast:
        row.verdict, row.reason = "not compared", "fast: its bits are not reproducible"
        return row
    if against is not None and not _same_text(backend.generated.files, against):
        row.verdict, row.reason = "not compared", "its text is not what this version generates"
        return row
    for number, (name, state) in enumerate(states):
        wants = [want for want in backend.wants if askable(state, want)]
        if number % INVERSE_EVERY and "inverse" in wants:
            wants.remove("inverse")
        row.states += 1
        for want in wants:
            if same_bits(_outcome(backend.evaluate, state, want), _outcome(backend.interpreter_evaluate, state, want)):
                continue
            if row.verdict == "ok":
                row.verdict, row.state, row.request = "FAILED", name, Request(name, state, (want,))
                row.reason = f"{want} differs"
    return row


def _outcome(evaluate: Callable[[State, Sequence[str]], dict[str, Any]], state: State, want: str) -> Any:
    """Results, or the words of the refusal: these must be equal as well."""
    try:
        return evaluate(state, (want,))
    except StateError as error:
        return str(error)


def _same_text(files: Mapping[str, str], folder: Path) -> bool:
    return all(
        (folder / name).read_bytes().replace(b"\r\n", b"\n") == text.encode("utf-8") for name, text in files.items()
    )


def _good_inputs(backend: CBackend, states: Sequence[tuple[str, State]]) -> dict[str, Any]:
    """Arguments of an ordinary state, with angles as well."""
    state = next((s for name, s in states if name.startswith("random")), states[0][1])
    return {**backend.arguments(state), "angles": (0.1, 0.7, -0.2), "dt": 1e-4, "order": 4}


def _raw(backend: CBackend) -> Callable[[str, Mapping[str, Any]], tuple[int, bool]]:
    def call(name: str, inputs: Mapping[str, Any]) -> tuple[int, bool]:
        return backend.library.probe(backend.program.function(name), inputs)

    return call
