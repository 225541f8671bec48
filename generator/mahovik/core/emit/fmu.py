"""The sources of an FMU: the C of its stand, the stand as values with references, the interface of FMI; descriptions.

`modelDescription.xml` describes its variables.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from mahovik.core.emit.calls import address, call
from mahovik.core.emit.code import Code
from mahovik.core.emit.generate import Generated, describe_bodies, generate_all
from mahovik.core.emit.layout import wrap_statement
from mahovik.core.emit.templates import source_text, template
from mahovik.core.lower.coordinates import Ways
from mahovik.core.lower.fmu import has_angle, lower_fmu
from mahovik.core.lower.fmu_variables import Form, Variable, measured_laws
from mahovik.core.lower.freedoms import scalar_coordinates, turns_about_point
from mahovik.core.lower.units import DISPLAY, NONE, Unit
from mahovik.core.program.types import Field, Kind, Struct
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import identities

HEADERS = ("fmi2FunctionTypes.h", "fmi2Functions.h", "fmi2TypesPlatform.h")
"""Headers of the FMI standard 2.0, unchanged."""


def compiled_sources(stand: Stand) -> tuple[str, ...]:
    """Names of the C files of an FMU, in the order in which they are compiled."""
    name = stand.name
    return (f"{name}.c", f"{name}_model.c", f"{name}_fmi2.c")


def fmu_sources(stand: Stand, generated: Generated, form: Form, token: str) -> dict[str, str]:
    """All sources of an FMU by file name in its folder `sources`; `token` ties the binary to its description."""
    printer = _Printer(stand, generated, form)
    files = _with_model(stand, generated, printer, {compiled_sources(stand)[-1]: printer.interface(token)})
    return files | {header: source_text(f"fmu/{header}") for header in HEADERS}


def block_sources(stand: Stand, generated: Generated, form: Form, tool: str) -> dict[str, str]:
    """All sources of a block of "simulink" or "basilisk", text by file name."""
    printer = _Printer(stand, generated, form)
    names = {"simulink": ("simulink.c",), "basilisk": ("basilisk.h", "basilisk.i")}[tool]
    return _with_model(stand, generated, printer, {f"{stand.name}_{name}": printer.block(name) for name in names})


def _with_model(stand: Stand, generated: Generated, printer: _Printer, interface: dict[str, str]) -> dict[str, str]:
    """An interface with the stand as values with references, and the C of what they call."""
    name = stand.name
    files = {
        f"{name}_model.h": printer.model("fmu/model.h.j2"),
        f"{name}_model.c": printer.model("fmu/model.c.j2"),
        **interface,
    }
    text = "".join(files.values())
    called = (f.name for f in generated.program.functions if f.public and f"{name}_{f.name}(" in text)
    return generate_all(stand, only=tuple(called)).files | files


class _Printer:
    """Collects the parts that the templates put in order."""

    def __init__(self, stand: Stand, generated: Generated, form: Form) -> None:
        self._stand, self._form, self._layout = stand, form, generated.layout
        self._code = Code(generated.program, identities(stand))
        self._names = self._code.names
        self._known = {
            "flywheels": self._layout.flywheels,
            "kind": form.kind,
            "inputs": form.inputs,
            "states": form.groups["STATE"].count,
            "freedoms": self._layout.freedoms,
            "held": self._layout.held,
            "coordinates": self._coordinates(),
        }

    def _coordinates(self) -> dict[str, Any] | None:
        """Arguments of `coordinates` by values that follow one another, and the places of an angle and its speed."""
        layout = self._layout
        if not layout.coordinates:
            return None
        count, ways = len(scalar_coordinates(layout.ways)), Ways(layout.ways)
        first = f"&model->value[{self._stand.name.upper()}_AT_COORDINATES"
        places = ([0] if count else []) + ([count] if turns_about_point(layout.ways) else [])
        places.append(count + (4 if turns_about_point(layout.ways) else 0))
        angle = ways.turns[0] if has_angle(layout.ways) else None
        return {
            "targets": [f"{first} + {place}]" if place else f"{first}]" for place in places],
            "angle": None if angle is None else ways.number(angle),
            "speed": angle,
            "count": count,
        }

    def model(self, name: str) -> str:
        """Header or source of the stand as values with references, and of what an integrator needs besides."""
        code = Code(lower_fmu(self._layout), identities(self._stand), word="model_word")
        groups, layout = self._form.groups, self._layout
        settable = self._form.variables[: groups["RATES"].first]
        return code.render(
            name,
            **self._known,
            public=code.public_declarations(code.public),
            functions=code.functions,
            tables=[],
            limits=[*code.limits, *code.constants],
            groups=[g for g in groups.values() if g.count or g.name in ("DRIVE", "STEP", "LAWS")],
            values=len(self._form.variables),
            variables=[self._row(v) for v in settable],
            readers=self._readers(),
            laws=groups["LAWS"].count > 0,
            suspects=list(self._suspects()),
            quaternions=[place for law in layout.law_tables for place in law.quaternions],
            members=[(f.name, self._names.length(f.shape[0])) for f in layout.state.fields],
            attitude=3,
            sensors=bool(layout.sensors),
            calls=self._calls(),
        )

    def interface(self, token: str) -> str:
        """The functions of FMI."""
        nominals = [max(1.0, abs(v.start or 0.0)) if v.unit.name == "rad/s" else 1.0 for v in self._form.group("STATE")]
        lines = wrap_statement(", ".join(map(self._code.real, nominals)), "")
        return self._code.render("fmu/fmi2.c.j2", **self._known, token=token, nominals=lines)

    def block(self, name: str) -> str:
        """The interface of a block of another simulator."""
        form, groups = self._form, self._form.groups
        return self._code.render(
            f"block/{name}.j2",
            **self._known,
            sources=compiled_sources(self._stand)[:-1],
            inputs_=form.variables[groups["DRIVE"].first : groups["STATE"].first],
            state=form.group("STATE"),
            calculated=form.variables[groups["RATES"].first :],
            dt=form.group("STEP")[0].start,
        )

    # -- parts ---------------------------------------------------------------------------------------------------------

    def _row(self, v: Variable) -> dict[str, Any]:
        """A value that can be set: name, unit, start, range."""
        most = self._code.precision.largest
        return {
            "name": v.name,
            "unit": "" if v.unit is NONE else f" {v.unit.name}",
            "start": v.start or 0.0,
            "least": -most if v.least is None else v.least,
            "most": most if v.most is None else v.most,
        }

    def _readers(self) -> list[dict[str, Any]]:
        """Functions that fill a struct with values: one a struct, inner ones first; then the laws of the table."""
        layout = self._layout
        types = [layout.parameters, *(f.type for f in measured_laws(layout))]
        rows = [row for f in measured_laws(layout) for row in _read(f)]
        if layout.local_damped:
            types.append(layout.damper)
            rows = [*_read(Field("frame", layout.frame, (len(layout.local_bodies),)), ".damper", layout.damper), *rows]
        structs = {
            s.name: s for type_ in types if isinstance(type_, Struct) for s in type_.inner_structs() if _reals(s)
        }
        readers = [(s.name, s, [row for f in s.fields if not f.of_hold for row in _read(f)]) for s in structs.values()]
        readers += [("laws", layout.table, rows)] if rows else []
        return [{"name": name, "type": self._names.type(struct), "rows": rows} for name, struct, rows in readers]

    def _suspects(self) -> Iterator[dict[str, Any]]:
        """Parts of the parameters that may be refused: name, place; have they axes, do they begin with a body?"""
        named = {
            "instrument": [p.name for p in self._stand.instruments],
            "flywheel": [s.name for s in self._stand.flywheels],
            "point": [p.name for p in self._stand.points],
        }
        for f in self._layout.parameters.fields:
            body = int(f.name not in ("point", "added_mass"))
            for k, name in enumerate(named.get(f.name, [f.name])):
                place = f"{f.name}[{k}]" if f.name in named else f.name
                yield {"name": name, "place": place, "body": body, "axes": f.name in named}

    # -- calls ---------------------------------------------------------------------------------------------------------

    def _calls(self) -> dict[str, Any]:
        """Calls of functions of the stand, by what they take."""
        NAME = self._stand.name.upper()
        torque, flywheels = self._form.inputs == "torque", bool(self._layout.flywheels)
        values = f"&model->value[{NAME}_AT_"
        V_dot, phi_ddot = "rates + 7", f"rates + 13 + {NAME}_N"
        common = {
            "table": "&model->table",
            "x": "&model->x",
            "locked": "locked",
            "wrench": f"{values}WRENCH]",
            "mounting": "&model->mounting",
        }
        drive = {"tau": f"{values}DRIVE]", "phi_ddot": f"{values}DRIVE]"}
        texts = common | {"V_dot": V_dot, "phi_ddot": phi_ddot, "out": "&momenta"}
        outputs = [("momentum", texts)]
        if flywheels:
            outputs += [] if torque else [("torque", texts | {"tau": f"{values}TORQUE]"})]
            outputs.append(("mounts", texts | {"mount_wrench": f"{values}LOADS]"}))
        if self._layout.sensors:
            outputs.append(("points", texts | {"out": "readings"}))
        if self._layout.held:
            outputs.append(("reaction", texts | {"reaction": f"{values}REACTION]"}))
        coupled = flywheels and torque
        rates = common | {"u_dot": "u_dot"} | {"V_dot": V_dot} | drive | ({"phi_ddot": phi_ddot} if coupled else {})
        step = common | drive | {"dt": "h", "order": "4", "next": "&model->x"}
        return {
            "rates": self._call("coupled" if coupled else "forward", rates),
            "step": self._call("step_driven" if flywheels and not torque else "step", step),
            "outputs": [self._call(name, inputs) for name, inputs in outputs],
        }

    def _call(self, function: str, known: dict[str, str]) -> dict[str, str]:
        """Name and text of a call."""
        text = call(self._names, self._code.program.function(function), known)
        return {"name": self._names.function(function), "text": text}


def _read(f: Field, member: str = "", inner: Struct | None = None) -> list[tuple[int, str]]:
    """Number of iterations and the line that reads a member with reals, or one member of each struct of an array."""
    type_, place = inner or f.type, f"to->{f.name}"
    loops = f.shape if isinstance(type_, Struct) else f.shape[:-1]
    place += "[i]" if loops else ""
    if isinstance(type_, Struct):
        text = f"read_{type_.name}(from, &{place}{member})"
    else:
        text = f"copied(from, {address(place, f.shape)}, {int(f.shape[-1]) if f.shape else 1})"
    return [(int(loops[0]) if loops else 0, text)] if _reals(type_) else []


def _reals(type_: Kind | Struct) -> bool:
    """Is it a real, or has it any, or structs that have?"""
    return any(_reals(f.type) for f in type_.fields) if isinstance(type_, Struct) else type_ is Kind.REAL


KINDS = {"cs": "CoSimulation", "me": "ModelExchange"}


@dataclass(frozen=True)
class Description:
    """Text of `modelDescription.xml`, and the token in it: a hash of all its other content."""

    text: str
    token: str


def fmu_description(stand: Stand, form: Form, step: float) -> Description:
    """The description of an FMU; `step`: the default communication step, s."""
    render = template("fmu/modelDescription.xml.j2").render
    known = _facts(stand, form, step)
    digest = hashlib.sha256(render(**known, token="").encode("utf-8")).hexdigest()
    token = f"{{{'-'.join((digest[:8], digest[8:12], digest[12:16], digest[16:20], digest[20:32]))}}}"
    return Description(render(**known, token=token), token)


def _facts(stand: Stand, form: Form, step: float) -> dict[str, Any]:
    hashes = identities(stand)
    shown = [(reference, v) for reference, v in enumerate(form.variables) if v.shown]
    number = {v.name: k + 1 for k, (_, v) in enumerate(shown)}
    used = {v.unit.name: v.unit for _, v in shown if v.unit is not NONE}
    measured = {v.unit.quantity: v.unit for _, v in shown if v.unit.quantity}
    return {
        "name": stand.name,
        "described": describe_bodies(stand),
        "structure": hashes.structure,
        "physics": hashes.physics,
        "kind": KINDS[form.kind],
        "cs": form.kind == "cs",
        "compiled": compiled_sources(stand),
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
