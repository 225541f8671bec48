"""Would a physical fault be seen? Each fault of the dictionary, on this stand; and the C, which has none of them."""

from __future__ import annotations

import json
from collections.abc import Mapping
from importlib.metadata import version
from typing import Any

from mahovik.proof.evidence.piece import Outcome, Piece, Subject, Table, Tell, judged, program

_EQUAL = {"double": ("equal",), "float": ("equal", "rounding")}


def _run(subject: Subject, tell: Tell) -> Outcome:
    import numpy as np

    from mahovik.errors import StateError
    from mahovik.proof.diagnose.diagnosis import Clinic
    from mahovik.proof.diagnose.faults import DICTIONARY
    from mahovik.proof.diagnose.predict import singles
    from mahovik.proof.diagnose.words import as_object, sentences
    from mahovik.proof.verify.bounds import BOUNDS
    from mahovik.proof.verify.c_backend import CBackend
    from mahovik.proof.verify.states import Request

    backend = CBackend(subject.stand, subject.real)
    clinic = Clinic(subject.stand, 1, backend.wants)

    def answer(request: Request) -> Mapping[str, Any]:
        try:
            return backend.evaluate(request.state, request.want)
        except StateError:
            return {}

    tell("the C")
    diagnosis = clinic.diagnose(answer)
    noise = clinic.whole.noise(BOUNDS[subject.real])
    rows, largest = [], {}
    for number, suspect in enumerate(singles(DICTIONARY)):
        tell(f"fault {number + 1} of {len(DICTIONARY)}")
        error = np.abs(np.nan_to_num(clinic.predictions.error(suspect, True), nan=0.0))
        fault, worst = suspect[0].fault, float(error.max(initial=0.0))
        word = "seen" if (error > noise[: error.size]).any() else "within rounding" if worst else "no effect here"
        largest[fault.name] = {"equation": fault.equation, "error": worst, "outcome": word}
        rows.append((fault.name, fault.equation, f"{worst:.0e}" if worst else "0", word))
    seen = sum(each["outcome"] == "seen" for each in largest.values())
    absent = sum(each["outcome"] == "no effect here" for each in largest.values())
    rest = len(largest) - seen - absent
    clear = diagnosis.outcome in _EQUAL[subject.real]
    figure = f"the C has none; of {len(largest)} faults {seen} would be seen, {absent} have no effect on this stand"
    figure += f", {rest} none beyond rounding" if rest else ""
    files = {"diagnosis.json": json.dumps({"C": as_object(diagnosis), "faults": largest}, indent=1) + "\n"}
    table = Table(("fault", "equation", "largest error, of scale>", "outcome"), tuple(rows))
    notes = tuple(line.strip() for line in sentences(diagnosis))
    return Outcome(judged(clear), figure if clear else notes[0], (f"NumPy {version('numpy')}",), table, notes, files)


PIECE = Piece(
    name="faults",
    title="Would a fault be seen?",
    shows=(
        "Each physical fault of a dictionary (a term left out, a sign, an inertia about the wrong point) is planted in "
        "the equations of this stand; the table says how far its answers are from the right ones. The C is asked as a "
        "foreign program would be, and found to have none of them."
    ),
    limits=(
        "Faults that the dictionary does not have, and faults of the C as C, such as a loop bound: these are planted "
        "in the emitted text by the project's own tests, for its example stands: `docs/results/planted-faults.md`."
    ),
    command=lambda s: f'mahovik judge {s.stand_file} --with "mahovik eval {s.stand_file}{s.option}" --explain',
    run=_run,
    needs=lambda _: (program("gcc"),),
)
