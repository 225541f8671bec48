"""Stands that the emitted C is tried on, and C of any stand and element type, made once a test run."""

from collections.abc import Iterable
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from mahovik import stands as examples
from mahovik.core.emit.generate import Generated, generate_all
from mahovik.core.lower.layout import Layout
from mahovik.core.lower.values import Values
from mahovik.core.program.function import Program
from mahovik.core.stand import load
from mahovik.core.stand.hold import FREEDOMS
from mahovik.core.stand.model import Body, Carrier, Freedom, Hold, Instrument, Law, Stand, StreamProfile
from mahovik.core.stand.random import BARE, EVERYTHING, Features, random_stand
from mahovik.laws.buoyancy.law import Buoyancy
from mahovik.laws.damping.law import Damping
from mahovik.laws.leg.law import Legs, legs_of
from mahovik.laws.suspension.law import Suspension

WET = Features("aircraft", 1, True, True, True, 1, False, False, {"suspension": 0, "leg": 0})
HUNG = Features("euler", 1, True, False, False, 0, True, True, {"suspension": 1, "leg": 2})
STREAM_ONLY = Features("ship", 0, False, True, False, 0, False, False, {"suspension": 0, "leg": 0})
DRAWN = Features()

GENERAL = {
    "everything0": (0, EVERYTHING),
    "everything1": (1, EVERYTHING),
    "everything6": (6, EVERYTHING),
    "bare0": (0, BARE),
    "bare5": (5, BARE),
    "bare64": (64, BARE),
    "wet7": (7, WET),
    "hung5": (5, HUNG),
    "stream1": (1, STREAM_ONLY),
    "drawn12": (12, DRAWN),
}
"""Random general stands: name to flywheels and features. The name is the stand's as well."""

AIR = replace(EVERYTHING, fluid=False, stream=False, tasks=0)
STREAM = replace(AIR, stream=True)
TWO_STATIONS = StreamProfile((0.0, 0.0, -1.0), (-10.0, 10.0), ((0.5, 0.0, 0.0), (0.1, 0.2, 0.0)))
_HOME = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))

HELD = {
    "held3": (3, AIR, Hold((FREEDOMS["yaw"], FREEDOMS["z"]), (0.1, 0.2, 0.3), *_HOME)),
    "hinge5": (5, AIR, Hold((Freedom("turn", (1.0, -2.0, 0.5)),), (0.1, 0.2, 0.3), *_HOME)),
    "clamped4": (4, STREAM, Hold((), (0.0, 0.0, 0.0), *_HOME)),
    "channel1": (1, replace(BARE, stream=True), Hold((FREEDOMS["pitch"],), *_HOME, _HOME[0])),
    "joint4": (4, STREAM, Hold(tuple(FREEDOMS[n] for n in ("roll", "pitch", "yaw")), (0.1, 0.2, 0.3), *_HOME)),
    "edge2": (
        2,
        AIR,
        Hold((Freedom("twist", twist=(1.0, 0.2, 0.0, 0.0, 0.0, 0.3)), FREEDOMS["yaw"]), *_HOME, _HOME[0]),
    ),
}
"""Random general stands whose carrier is held: name to flywheels, features and hold; a stream has TWO_STATIONS."""

NAMES = (*examples.names(), *GENERAL)


@cache
def stand(name: str) -> Stand:
    """An example stand, one of GENERAL, or one of HELD."""
    if name in HELD:
        flywheels, features, hold = HELD[name]
        example = random_stand(np.random.default_rng(3), flywheels, features, name)
        return replace(example, hold=hold, profile=TWO_STATIONS if features.stream else None)
    if name in GENERAL:
        flywheels, features = GENERAL[name]
        return random_stand(np.random.default_rng(list(name.encode())), flywheels, features, name)
    return load(examples.path(name))


@cache
def generated(name: str) -> Generated:
    """Program, numbers and C of a stand by name."""
    return generate_all(stand(name))


def float_texts(stand: Stand) -> tuple[Layout, Program, Values, dict[str, str]]:
    """Layout, program, numbers and C of a stand with float as element type."""
    made = generate_all(stand, "float")
    return made.layout, made.program, made.values, made.files


def write(files: dict[str, str], folder: Path) -> Path:
    """Writes files by name into a folder; returns the path of the source."""
    for name, text in files.items():
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text(text, encoding="ascii", newline="\n")
    return folder / next(name for name in files if name.endswith(".c"))


def other_numbers(stand: Stand, rng: np.random.Generator) -> Stand:
    """A stand of the same structure with other numbers, its bodies physical."""

    def vec(values: Iterable[float], size: float = 0.02) -> tuple[Any, ...]:
        return tuple(float(x + rng.normal() * size) for x in values)

    def scaled(rows: Any, factor: float) -> Any:
        return rows and tuple(tuple(x * factor for x in row) for row in rows)

    def body(old: Body) -> dict[str, Any]:
        k = float(rng.uniform(1.1, 1.5))  # the same shape of another density
        new: dict[str, Any] = {"mass": old.mass * k, "inertia": scaled(old.inertia, k)}
        laws: list[Law] = []
        if (buoyancy := old.law(Buoyancy)) is not None:
            laws.append(Buoyancy(buoyancy.displaced_mass * k, vec(buoyancy.center)))
        if (damping := old.law(Damping)) is not None:
            terms = tuple(replace(term, value=term.value * k) for term in damping.terms)
            laws.append(Damping(scaled(damping.linear, k), scaled(damping.quadratic, k), terms))
        new["laws"] = tuple(laws)
        if isinstance(old, Carrier | Instrument) and old.added_mass is not None:
            new["added_mass"] = scaled(old.added_mass, k)
        return new

    laws: list[Any] = [
        Legs(tuple(replace(leg, ground=vec(leg.ground), length=leg.length * 1.1) for leg in legs_of(stand)))
    ]
    if (law := stand.law(Suspension)) is not None:
        laws.append(replace(law, stiffness=scaled(law.stiffness, 1.5), position=vec(law.position)))
    return replace(
        stand.with_laws(*laws),
        gravity=(1.25 * stand.gravity[0], 1.25 * stand.gravity[1], 1.25 * stand.gravity[2]),
        stream=stand.stream and vec(stand.stream),
        carrier=replace(stand.carrier, **body(stand.carrier)),
        instruments=tuple(
            replace(p, **body(p), position=vec(p.position), angles=vec(p.angles, 0.5)) for p in stand.instruments
        ),
        flywheels=tuple(replace(s, **body(s), position=vec(s.position)) for s in stand.flywheels),
    )
