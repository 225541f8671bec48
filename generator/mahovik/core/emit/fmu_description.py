"""`modelDescription.xml` of an FMU, and `buildDescription.xml` of its sources."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from mahovik.core.emit.generate import describe_bodies
from mahovik.core.emit.templates import template
from mahovik.core.lower.fmu_variables import Form, Variable, unique
from mahovik.core.lower.units import DISPLAY, NONE, Unit
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand

KINDS = {"cs": "CoSimulation", "me": "ModelExchange"}

OPTIONS = "-std=c99 -O2 -ffp-contract=off"
"""Compiler options with which every processor gives the same bits."""


@dataclass(frozen=True)
class Description:
    """Text of `modelDescription.xml`, and the token in it: a hash of all its other content."""

    text: str
    token: str


def fmu_description(stand: Stand, form: Form, version: str, compiled: Sequence[str], step: float) -> Description:
    """The description of an FMU of this FMI version; `step`: the default communication step, s."""
    render = template(f"fmu/modelDescription{version[0]}.xml.j2").render
    known = _facts(stand, form, version, compiled, step)
    digest = hashlib.sha256(render(**known, token="").encode("utf-8")).hexdigest()
    token = f"{{{'-'.join((digest[:8], digest[8:12], digest[12:16], digest[16:20], digest[20:32]))}}}"
    return Description(render(**known, token=token), token)


def fmu_build(stand: Stand, compiled: Sequence[str]) -> str:
    """How the sources are compiled: `buildDescription.xml` of FMI 3.0."""
    return template("fmu/buildDescription.xml.j2").render(name=stand.name, compiled=compiled, options=OPTIONS)


def _facts(stand: Stand, form: Form, version: str, compiled: Sequence[str], step: float) -> dict[str, Any]:
    found = identities(stand)
    shown = [(reference, v) for reference, v in enumerate(form.variables) if v.shown]
    references = unique(form.variables)
    index = {v.name: k + 1 for k, (_, v) in enumerate(shown)}
    number = index if version == "2.0" else references  # how the structure names variables
    used = {v.unit.name: v.unit for _, v in shown if v.unit is not NONE}
    measured = {v.unit.quantity: v.unit for _, v in shown if v.unit.quantity}
    return {
        "name": stand.name,
        "described": describe_bodies(stand),
        "structure": found.structure,
        "physics": found.physics,
        "kind": KINDS[form.kind],
        "cs": form.kind == "cs",
        "compiled": compiled,
        "step": step,
        "text": _text,
        "units": [(unit, DISPLAY.get(unit.name, ())) for unit in used.values()],
        "types": [(unit.quantity, unit.name, _display(unit)) for unit in measured.values()],
        "variables": [(reference, v, _initial(v), number.get(v.derivative or "")) for reference, v in shown],
        "outputs": [_unknown(v, number, True) for _, v in shown if v.causality == "output"],
        "derivatives": [_unknown(v, number, True) for _, v in shown if v.derivative is not None],
        "unknowns": [_unknown(v, number, v.direct) for _, v in shown if _unknown_at_first(v)],
    }


def _unknown_at_first(v: Variable) -> bool:
    """Is it calculated in Initialization Mode?"""
    return v.start is None and v.causality in ("output", "local")


def _display(unit: Unit) -> str:
    """Angles are shown in degrees, speeds in turns a minute: SI for all else."""
    return DISPLAY[unit.name][0][0] if unit.name in ("rad", "rad/s") else ""


def _initial(v: Variable) -> str:
    """Is the value at first given, or calculated?"""
    return "" if v.causality in ("independent", "input") else "calculated" if v.start is None else "exact"


def _unknown(v: Variable, number: Mapping[str, int], known: bool) -> dict[str, Any]:
    """A calculated variable, with what it depends on where that is known."""
    if v.depends is None or not known:
        return {"number": number[v.name], "dependencies": None}
    numbers = sorted(number[name] for name in v.depends)
    return {"number": number[v.name], "dependencies": " ".join(map(str, numbers))}


def _text(value: float) -> str:
    """The shortest decimal that reads back to the same number."""
    return repr(float(value) + 0.0)
