"""`generate`: the C of a stand. `verify`: C against the reference."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from mahovik.core.stand.model import Stand as CoreStand
from mahovik.errors import UsageError
from mahovik.out.api.stands import Stand
from mahovik.out.arguments import StandGiven
from mahovik.out.functions.table import Column, Table
from mahovik.out.notices import OnProgress, Progress, tell

if TYPE_CHECKING:
    from mahovik.proof.diagnose.diagnosis import Diagnosis
    from mahovik.proof.verify.check import Report


COMPARED = ("value", "second")
"""Columns of a verification with differences from the reference: of what is judged, of the second derivation."""


class Verification(Table):
    """Verdict on C or on a program: a row per quantity, with differences relative to its natural scale.

    `passed`: something was compared, and nothing failed. `diagnosis` names the fault where `judge` was asked for it.
    """

    def __init__(self, result: Report, diagnosis: Diagnosis | None = None) -> None:
        self.result, self.diagnosis = result, diagnosis

    @property
    def columns(self) -> tuple[Column, ...]:
        rows = self.result.rows

        def numbers(values: Sequence[float | None]) -> Any:
            return np.array([np.nan if x is None else x for x in values])

        return (
            Column("judged", "", np.array([row.judged for row in rows], dtype=object)),
            Column("quantity", "", np.array([row.quantity for row in rows], dtype=object)),
            Column("states", "", np.array([row.states for row in rows])),
            Column("value", "", numbers([row.value for row in rows])),
            Column("second", "", numbers([row.second for row in rows])),
            Column("limit", "", numbers([row.limit for row in rows])),
            Column("verdict", "", np.array([row.verdict for row in rows], dtype=object)),
        )

    @property
    def passed(self) -> bool:
        """Whether something was compared and nothing failed."""
        return self.result.passed

    @property
    def conclusion(self) -> str:
        """The verdict in one line."""
        from mahovik.proof.verify.check import conclusion

        return conclusion(self.result)

    @property
    def explanation(self) -> tuple[str, ...]:
        """The diagnosis in sentences; none without one."""
        if self.diagnosis is None:
            return ()
        from mahovik.proof.diagnose.diagnosis import sentences

        return tuple(sentences(self.diagnosis))

    def to_dict(self) -> dict[str, Any]:
        """All of it, as `mahovik verify --json` prints it."""
        from mahovik.proof.verify.check import as_json

        found: dict[str, Any] = json.loads(as_json(self.result, self.more()))
        return found

    def more(self) -> dict[str, Any]:
        """What `mahovik judge --json` prints besides the rows."""
        if self.diagnosis is None:
            return {}
        from mahovik.proof.diagnose.diagnosis import as_object

        return {"diagnosis": as_object(self.diagnosis)}

    def __repr__(self) -> str:
        return f"<Verification of {self.result.stand}: {self.conclusion}>"


def verify(
    stand: StandGiven,
    *,
    states: int = 200,
    seed: int = 1,
    against: str | Path | None = None,
    real: str | None = None,
    judges: bool = False,
    progress: OnProgress | None = None,
) -> Verification:
    """Judge the generated C by the literal reference and the second derivation, at random and extreme states.

    against      folder of the C to judge; None: a fresh copy
    real         "double" or "float"; None: that of the folder, else double
    judges       judge by Pinocchio and MuJoCo instead, without the laws that they do not have

    Raises StandError, ToolchainError where it does not compile, CheckError where it is of another stand.
    """
    from mahovik.proof.second.reading import load_tables
    from mahovik.proof.verify.delivery import Options, delivered_options, stand_in
    from mahovik.proof.verify.harness import verify_c

    own: CoreStand = Stand.of(stand)
    document = load_tables(Path(stand)) if isinstance(stand, str | Path) else Stand.of(stand).to_dict()
    folder, words = None if against is None else Path(against), f"verify {own.name}"
    if judges and folder is not None:
        raise UsageError("--judges judges a fresh copy: not with --with, --against")
    if folder is not None:
        own, real = stand_in(folder, own), real or (delivered_options(folder) or Options()).real
    real = real or "double"

    def on_state(done: float, *_: object) -> None:
        tell(progress, Progress(words, done, states))

    if judges:
        from mahovik.proof.verify.judges import verify_judges

        return Verification(verify_judges(own, seed=seed, count=states, progress=on_state))
    found = verify_c(own, seed=seed, count=states, against=folder, real=real, progress=on_state, document=document)
    return Verification(found)
