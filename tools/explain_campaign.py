"""Plant faults in programs of random stands, ask `judge --explain` for them, write docs/results/diagnosis.md.

python tools/explain_campaign.py [--stands 6] [--jobs 2] [--write]

Exit status 1 where fewer than 95 % of single faults are named first, or a correct program is given a fault.
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from decimal import Decimal
from typing import Any

import campaign
import numpy as np
from explain_deriving import interpret, plant_in_derivations
from explain_planting import (
    Answers,
    Plant,
    answers_of,
    literal,
    plant_in_answers,
    plant_in_numbers,
)
from explain_rewriting import SECOND, rewritten
from kept import Campaign, Columns, Figures

from mahovik.contract.laws import part
from mahovik.core.stand.model import Stand
from mahovik.core.stand.random import EVERYTHING, SEQUENCES, Features, random_stand
from mahovik.core.stand.read import read
from mahovik.proof.diagnose.diagnosis import Diagnoser, Diagnosis
from mahovik.proof.diagnose.faults import DICTIONARY
from mahovik.proof.diagnose.predict import FaultyProgram, Part
from mahovik.proof.second import Second
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.program_backend import with_all_inputs

COUNTS = (2, 1, 1, 3, 4, 2, 3, 5, 2, 8)
"""Flywheels of the stands, in turn."""

WHOLE, ALONE, ROUNDED = "in every body it concerns", "in one flywheel alone", "with answers rounded to float"
FORWARD = "in a program that offers `forward` only"
TWO = "two at once, both named"
SINGLE = (
    WHOLE, ALONE, ROUNDED, FORWARD, "stand edited", "states edited", "answers edited", "second derivation rewritten",
    "derivation rewritten", "numbers of the program",
)  # fmt: skip
"""Kinds of planting of one whole fault; those of the last lines are made without the dictionary's code."""

HELD_WANTS = ("forward", "torque", "coupled", "mounts")
"""What programs of held stands offer."""

LEAST = 0.95
"""Fraction of single faults that must be named first."""


@dataclass(frozen=True)
class Outcome:
    """Result for one planted fault: named first `alone`, or with `equals` that the stand cannot distinguish."""

    fault: str
    kind: str
    verdict: str


def campaign_stands(count: int) -> Iterator[Stand]:
    """The first `count` stands: always the same ones; every second with everything that a stand can have."""
    for number in range(count):
        features = replace(Features() if number % 2 else EVERYTHING, angles=SEQUENCES[number % 3])
        rng = np.random.default_rng(1000 + number)
        yield with_all_inputs(random_stand(rng, COUNTS[number % len(COUNTS)], features, f"random{number}"))


HELD = 3
"""Held stands, for the faults in friction and stops."""

OF_HELD = tuple(fault for law in ("friction", "stop") for fault in part(law, "faults").FAULTS)
"""Rows of faults that a free carrier cannot have."""

HOLDS = ('freedoms = ["x"]', 'freedoms = ["z", "yaw"]', 'freedoms = ["roll"]\npivot = [0.01, 0.02, 0.1]')
"""A cart, a shaker that turns, a pendulum."""


def held_stand(number: int) -> Stand:
    """A held stand with friction and two stops along its first freedom, and numbers of the seed."""
    rng = np.random.default_rng(3000 + number)
    a, b, c, d = (float(x) for x in rng.uniform(0.5, 1.5, 4))
    text = f"""
        schema = 1
        name = "held{number}"
        gravity = [0, 0, -9.81]
        [carrier]
        mass = {2 * a}
        center_of_mass = [0.01, {0.02 * b}, {-0.05 * c}]
        inertia = [0.05, 0.06, 0.03]
        inertia_about = "origin"
        [[flywheel]]
        name = "w1"
        mass = 0.2
        center_of_mass = [0, {0.002 * d}, 0.001]
        inertia = [0.001, 0.0006, 0.0007]
        inertia_about = "origin"
        [hold]
        {HOLDS[number % len(HOLDS)]}
        [[hold.friction]]
        freedom = "1"
        viscous = {a}
        coulomb = {0.5 * b}
        breakaway = {0.9 * b}
        stribeck_speed = 0.5
        [[hold.stop]]
        freedom = "1"
        at = {0.2 * c}
        stiffness = {50 * d}
        damping = {30 * a}
        [[hold.stop]]
        freedom = "1"
        at = {-0.2 * b}
        stiffness = {50 * d}
        damping = {30 * a}
    """
    return read(tomllib.loads(text, parse_float=Decimal), f"held{number}")


def examine_held(number: int) -> tuple[str, list[Outcome], list[Outcome]]:
    """The faults of held carriers, planted in a held stand: the dictionary's, other numbers, another derivation."""
    stand = held_stand(number)
    names = {fault.name for fault in OF_HELD}
    clinic = Diagnoser(stand, wants=HELD_WANTS)
    plants = [Plant(f.name, WHOLE, FaultyProgram(stand, (Part(f),)).answer) for f in DICTIONARY if f.name in names]
    plants += [plant for plant in plant_in_numbers(stand) if plant.fault in names]
    plants += rewritten(stand, [name for name in SECOND if name in names])
    found = [Outcome(p.fault, p.kind, verdict(clinic.diagnose(p.answers), [p.fault])) for p in plants]
    programs = (("literal reference", literal(stand)), ("second derivation", answers_of(Second(stand))))
    right = [Outcome(name, "correct", clinic.diagnose(answers).outcome) for name, answers in programs]
    return f"{stand.name}: 1 flywheel", found, right


def examine_any(number: int) -> tuple[str, list[Outcome], list[Outcome]]:
    """A free stand; of a negative number, counted from -1 downwards, a held one."""
    return examine(number) if number >= 0 else examine_held(-1 - number)


def verdict(found: Diagnosis, planted: Sequence[str]) -> str:
    """How a diagnosis answers to the planted names."""
    if found.outcome == "equal":
        return "unseen"
    if found.outcome != "named":
        return "none"
    named = [sorted(part.fault.name for part in cause.parts) for cause in found.causes]
    if sorted(planted) not in named:
        return "other"
    return "alone" if len(named) == 1 else "equals"


def of_dictionary(stand: Stand, rng: np.random.Generator, some: int) -> Iterator[Plant]:
    """The faults themselves: all; some of them in one flywheel alone; some as a float program would answer."""
    for fault in DICTIONARY:
        yield Plant(fault.name, WHOLE, FaultyProgram(stand, (Part(fault),)).answer)
    turning = [fault for fault in DICTIONARY if fault.of_flywheels]
    for k in rng.choice(len(turning), min(some, len(turning)), replace=False):
        wheel = stand.flywheels[int(rng.integers(len(stand.flywheels)))].name
        yield Plant(turning[k].name, ALONE, FaultyProgram(stand, (Part(turning[k], wheel),)).answer)
    seen = [fault for fault in DICTIONARY if visible(stand, fault)]  # of the others nothing but rounding is there
    for k in rng.choice(len(seen), some, replace=False):
        yield Plant(seen[k].name, ROUNDED, round_answers(FaultyProgram(stand, (Part(seen[k]),)).answer))


def pairs(stand: Stand, rng: np.random.Generator, some: int) -> Iterator[tuple[list[str], str, Answers]]:
    """Two faults in one program."""
    for _ in range(some):
        a, b = (DICTIONARY[int(k)] for k in rng.choice(len(DICTIONARY), 2, replace=False))
        if all(visible(stand, fault) for fault in (a, b)):
            yield [a.name, b.name], TWO, FaultyProgram(stand, (Part(a), Part(b))).answer


def visible(stand: Stand, fault: Any) -> bool:
    """Whether a fault has any effect on a stand."""
    return bool(np.any(~(np.abs(diagnoser_of(stand).predictions.error((Part(fault),), False)) < 1e-9)))


_diagnosers: dict[Stand, Diagnoser] = {}


def diagnoser_of(stand: Stand) -> Diagnoser:
    """The diagnoser of the stand at hand: its predictions are kept."""
    if stand not in _diagnosers:
        _diagnosers.clear()
        _diagnosers[stand] = Diagnoser(stand)
    return _diagnosers[stand]


def round_answers(answers: Answers) -> Answers:
    """Answers with seven digits."""

    def to_float(value: Any) -> Any:
        if isinstance(value, Mapping):
            return {name: to_float(each) for name, each in value.items()}
        if isinstance(value, str):  # a status
            return value
        return np.asarray(value, dtype=np.float32).astype(np.float64)

    return lambda request: to_float(answers(request))


def correct(stand: Stand) -> Iterator[tuple[str, Answers]]:
    """Programs without a fault."""
    yield "literal reference", literal(stand)
    yield "second derivation", answers_of(Second(stand))
    if len(stand.flywheels) < 2:  # it takes long to make: of some stands only
        yield "interpreter of the program", answers_of(interpret(stand))
        yield "generated C, double", answers_of(CBackend(stand, "double"))
        yield "generated C, float", answers_of(CBackend(stand, "float"))


def examine(number: int, some: int = 8) -> tuple[str, list[Outcome], list[Outcome]]:
    """Everything that is planted on the stand of that number: outcomes, and those of correct programs."""
    *_, stand = campaign_stands(number + 1)
    rng = np.random.default_rng(number)
    clinic = diagnoser_of(stand)
    plants: list[Plant] = [*of_dictionary(stand, rng, some), *plant_in_numbers(stand), *plant_in_answers(stand)]
    found = [Outcome(p.fault, p.kind, verdict(clinic.diagnose(p.answers), [p.fault])) for p in plants]
    costly = {
        0: (rewritten,),
        1: (plant_in_derivations,),
        4: (rewritten,),
    }  # they take long to make: of some stands only
    for others in costly.get(number, ()):
        found += [Outcome(p.fault, p.kind, verdict(clinic.diagnose(p.answers), [p.fault])) for p in others(stand)]
    for names, kind, answers in pairs(stand, rng, some):
        found.append(Outcome(" + ".join(names), kind, verdict(clinic.diagnose(answers), names)))
    forward = Diagnoser(stand, wants=("forward",))
    for k in rng.choice(len(DICTIONARY), 2 * some, replace=False):
        fault = DICTIONARY[k]
        answers = FaultyProgram(stand, (Part(fault),)).answer
        found.append(Outcome(fault.name, FORWARD, verdict(forward.diagnose(answers), [fault.name])))
    right = [Outcome(name, "correct", clinic.diagnose(answers).outcome) for name, answers in correct(stand)]
    return f"{stand.name}: {len(stand.flywheels)} flywheels", found, right


def count_outcomes(outcomes: Sequence[Outcome]) -> tuple[int, int, int, int]:
    """Seen, named first alone, named first with equals, of a set of outcomes; and the part named first, in percent."""
    seen = [each for each in outcomes if each.verdict != "unseen"]
    alone, equals = (sum(each.verdict == word for each in seen) for word in ("alone", "equals"))
    return len(seen), alone, equals, len(seen) - alone - equals


def rate(outcomes: Sequence[Outcome]) -> float:
    """Fraction of the visible faults that are named first."""
    seen, alone, equals, _ = count_outcomes(outcomes)
    return (alone + equals) / seen if seen else 1.0


KINDS_TABLE = Columns(
    {"planted": "{}", "visible": "{}", "named first": "{}", "with equals": "{}", "not": "{}", "rate": "{:.0%}"}
)
RIGHT_TABLE = Columns({"correct program": "{}", "stands": "{}", "given a fault": "{}"})
FAULT_TABLE = Columns({"fault": "{}", "planted": "{}", "named first": "{}"})
DICTIONARY_HEAD = ("fault", "equation", "what the program does", "planted", "named first")


def figures(stands: int, found: Sequence[Outcome], right: Sequence[Outcome]) -> Figures:
    """The figures to keep: by kind of planting, of correct programs, fault by fault."""
    kinds = {kind: [each for each in found if each.kind == kind] for kind in (*SINGLE, TWO)}
    programs = {name: [each for each in right if each.fault == name] for name in dict.fromkeys(o.fault for o in right)}
    faults = []
    for fault in DICTIONARY:
        of_it = [each for each in found if each.kind in SINGLE and each.fault == fault.name]
        seen, alone, equals, _ = count_outcomes(of_it)
        faults.append((fault.name, seen, alone + equals))
    return {
        "stands": stands,
        "held": HELD,
        "kinds": KINDS_TABLE.rows((kind, *count_outcomes(of), rate(of)) for kind, of in kinds.items() if of),
        "correct": RIGHT_TABLE.rows(
            (name, len(of), sum(each.verdict not in ("equal", "rounding") for each in of))
            for name, of in programs.items()
        ),
        "faults": FAULT_TABLE.rows(faults),
    }


def page(found: Figures) -> str:
    """The results as Markdown. Faults of the dictionary that were not planted yet are listed as such."""
    single = [row for row in found["kinds"] if row["planted"] in SINGLE]
    seen, alone, equals = (sum(row[key] for row in single) for key in ("visible", "named first", "with equals"))
    kept = {row["fault"]: row for row in found["faults"]}
    rows = [
        (*(each.replace("|", "\\|") for each in (fault.name, fault.equation, fault.words)), kept[fault.name]["planted"],
         kept[fault.name]["named first"])
        for fault in DICTIONARY if fault.name in kept
    ]  # fmt: skip
    new = [fault.name for fault in DICTIONARY if fault.name not in kept]
    held = f", {found['held']} held ones" if found.get("held") else ""
    return (
        f"{found['stands']} random stands{held}. Of {seen} single faults that are visible "
        f"on the stand, {alone + equals} were named first ({(alone + equals) / seen:.1%}),\n"
        f"{equals} of them together with others that no state of the stand tells apart.\n\n"
        f"{KINDS_TABLE.text(found['kinds'])}\n{RIGHT_TABLE.text(found['correct'])}\n"
        + campaign.table(DICTIONARY_HEAD, rows, 3)
        + (f"\nNot planted yet: {'; '.join(new)}.\n" if new else "")
    )


CAMPAIGN = Campaign(
    "diagnosis",
    campaign.Block("docs/results/diagnosis.md", "campaign: tools/explain_campaign.py --write"),
    page,
)


def main() -> None:
    """Run it."""
    given = campaign.parser(__doc__, stands=6, jobs=campaign.cores(), write=False).parse_args()
    found: list[Outcome] = []
    right: list[Outcome] = []
    for line, outcomes, of_correct in campaign.map_rows(
        examine_any, given.jobs, [*range(-HELD, 0), *range(given.stands)]
    ):
        single = [each for each in outcomes if each.kind in SINGLE]
        print(f"{line}: {rate(single):.1%} of {count_outcomes(single)[0]} single faults named first", flush=True)
        for each in outcomes:
            if each.verdict in ("other", "none"):
                print(f"  {each.kind}: {each.fault}: {each.verdict}", flush=True)
        found += outcomes
        right += of_correct
    kept = figures(given.stands, found, right)
    print(f"\n{page(kept)}", end="")
    if given.write:
        CAMPAIGN.keep(kept, 0)
    false = [each for each in right if each.verdict not in ("equal", "rounding")]
    raise SystemExit(1 if false or rate([each for each in found if each.kind in SINGLE]) < LEAST else 0)


if __name__ == "__main__":
    main()
