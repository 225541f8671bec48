"""The sources of an FMU: the C of its stand, the stand as values with references, the interface of FMI."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from mahovik import __version__
from mahovik.core.emit.calls import call
from mahovik.core.emit.declaration import null_check, prototype, public_declarations, summary
from mahovik.core.emit.expression import Expressions
from mahovik.core.emit.generate import Generated
from mahovik.core.emit.layout import wrapped
from mahovik.core.emit.literal import real_literal
from mahovik.core.emit.names import Names
from mahovik.core.emit.statement import Statements
from mahovik.core.emit.templates import source_text, template
from mahovik.core.lower.fmu.program import lower_fmu
from mahovik.core.lower.fmu.units import NONE
from mahovik.core.lower.fmu.variables import Form, Variable
from mahovik.core.lower.layout import Layout
from mahovik.core.program.function import Function
from mahovik.core.program.restrictable import restrictable
from mahovik.core.program.types import Field, Kind, Struct
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand

HEADERS = {
    "2.0": ("fmi2FunctionTypes.h", "fmi2Functions.h", "fmi2TypesPlatform.h"),
    "3.0": ("fmi3FunctionTypes.h", "fmi3Functions.h", "fmi3PlatformTypes.h"),
}
"""Headers of the FMI standard, unchanged, by version."""

SPELLING = {
    "2.0": {
        "token_name": "guid",
        "logger": "fmi2CallbackLogger",
        "component": "fmi2Component",
        "state": "FMUstate",
        "deserialize": "DeSerialize",
        "derivatives": "GetDerivatives",
        "number": "Real",
    },
    "3.0": {
        "token_name": "instantiationToken",
        "logger": "fmi3LogMessageCallback",
        "component": "fmi3Instance",
        "state": "FMUState",
        "deserialize": "Deserialize",
        "derivatives": "GetContinuousStateDerivatives",
        "number": "Float64",
    },
}
"""How the versions spell what both have."""


@dataclass(frozen=True)
class Sources:
    """Text by file name in the folder `sources`, and which of them are compiled."""

    files: dict[str, str]
    compiled: tuple[str, ...]


def compiled_sources(stand: Stand, version: str) -> tuple[str, ...]:
    """Names of the C files of an FMU, in the order in which they are compiled."""
    name = stand.name
    return (f"{name}.c", f"{name}_pose.c", f"{name}_model.c", f"{name}_fmi{version[0]}.c")


def fmu_sources(stand: Stand, generated: Generated, form: Form, version: str, token: str) -> Sources:
    """All sources of an FMU; `token`: what its description and its binary must agree on."""
    printer = _Printer(stand, generated, form)
    name, compiled = stand.name, compiled_sources(stand, version)
    files = dict(generated.files) | {
        f"{name}_pose.h": printer.pose("fmu/pose.h.j2"),
        f"{name}_pose.c": printer.pose("fmu/pose.c.j2"),
        f"{name}_model.h": printer.model("fmu/model.h.j2"),
        f"{name}_model.c": printer.model("fmu/model.c.j2"),
        compiled[-1]: printer.interface(version, token),
    }
    files |= {header: source_text(f"fmu/{header}") for header in HEADERS[version]}
    return Sources(files, compiled)


class _Printer:
    """Collects the parts that the templates put in order."""

    def __init__(self, stand: Stand, generated: Generated, form: Form) -> None:
        self._stand, self._generated, self._form = stand, generated, form
        self._layout: Layout = generated.layout
        self._names = Names(stand.name)
        found = identities(stand)
        self._known: dict[str, Any] = {
            "name": stand.name,
            "NAME": stand.name.upper(),
            "version": __version__,
            "structure": found.structure,
            "physics": found.physics,
            "flywheels": self._layout.flywheels,
            "kind": form.kind,
            "inputs": form.inputs,
            "states": form.groups["STATE"].count,
        }

    def pose(self, name: str) -> str:
        """Header or source of the functions beside those of the stand."""
        program = lower_fmu(self._layout)
        statements = Statements(self._names, Expressions(self._names, program.precision))
        if name.endswith(".h.j2"):
            public = [f for f in program.functions if f.public]
            return template(name).render(**self._known, functions=public_declarations(public, program, self._names))

        def printed(f: Function) -> dict[str, Any]:
            body = [*(null_check(f, self._names) if f.returns else []), *statements.block(f.body, "    ")]
            return {"comment": summary(f), "prototype": prototype(f, self._names, restrictable(program)), "body": body}

        return template(name).render(**self._known, functions=[printed(f) for f in program.functions])

    def model(self, name: str) -> str:
        """Header or source of the stand as values with references."""
        groups = self._form.groups
        settable = self._form.variables[: groups["RATES"].first]
        return template(name).render(
            **self._known,
            groups=[g for g in groups.values() if g.count or g.name in ("DRIVE", "STEP", "LAWS")],
            values=len(self._form.variables),
            variables=[self._row(v) for v in settable],
            readers=list(self._readers()),
            laws=groups["LAWS"].count > 0,
            suspects=self._suspects(),
            mounted=any(f.shape for f in self._layout.parameters.fields if f.name != "added_mass"),
            quaternions=[place for law in self._layout.law_tables for place in law.quaternions],
            members=[(f.name, self._count(f)) for f in self._layout.state.fields],
            attitude=3,
            sensors=bool(self._layout.sensors),
            calls=self._calls(),
            functions={"rates": self._names.function(self._rates()), "step": self._names.function(self._step())},
        )

    def interface(self, version: str, token: str) -> str:
        """The functions of FMI."""
        nominals = [max(1.0, abs(v.start or 0.0)) if v.unit.name == "rad/s" else 1.0 for v in self._form.group("STATE")]
        fmi = f"fmi{version[0]}"
        return template(f"fmu/{fmi}.c.j2").render(
            **self._known,
            fmi=fmi,
            token=token,
            **SPELLING[version],
            nominals=wrapped(", ".join(real_literal(n, self._layout.precision) for n in nominals), ""),
        )

    # -- parts ---------------------------------------------------------------------------------------------------------

    def _row(self, v: Variable) -> str:
        numbers = [v.start or 0.0, self._bound(v.least, -1), self._bound(v.most, 1)]
        literals = ", ".join(real_literal(float(x), self._layout.precision) for x in numbers)
        unit = "" if v.unit is NONE else f" {v.unit.name}"
        return f'{{ "{v.name}", "{unit}", {literals} }},'

    def _bound(self, given: float | None, sign: int) -> float:
        return sign * self._layout.precision.largest if given is None else given

    def _count(self, f: Field) -> str:
        return self._names.constant("N") if f.name in ("phi", "phi_dot") else str(int(f.shape[0]))

    def _readers(self) -> Iterator[list[str]]:
        """Functions that fill a struct with values: one a struct, inner ones first; then the laws of the table."""
        seen: list[Struct] = []

        def visit(struct: Struct) -> Iterator[list[str]]:
            for f in struct.fields:
                if isinstance(f.type, Struct) and _reals(f.type):
                    yield from visit(f.type)
            if struct not in seen:
                seen.append(struct)
                yield self._reader(struct.name, struct, [line for f in struct.fields for line in self._read(f)])

        yield from visit(self._layout.parameters)
        laws = self._layout.laws
        for f in laws:
            if isinstance(f.type, Struct) and _reals(f.type):
                yield from visit(f.type)
        lines = [line for f in laws for line in self._read(f)]
        if self._layout.own_damped and _reals(self._layout.damper):
            if self._layout.damper not in seen:
                yield from visit(self._layout.damper)
            own = Field("frame", self._layout.frame, (len(self._layout.own),))
            lines = [*self._read(own, "damper", self._layout.damper), *lines]
        if lines:
            yield self._reader("laws", self._layout.table, lines)

    def _reader(self, name: str, struct: Struct, lines: list[str]) -> list[str]:
        head = [f"/* Members of {struct.name} by values that follow one another; returns the value behind them. */"]
        head += [f"static const double *read_{name}(const double *from, {self._names.type(struct)} *to)", "{"]
        if any("[i]" in line for line in lines):
            head += ["    int i;", ""]
        return [*head, *lines, "    return from;", "}"]

    def _read(self, f: Field, member: str = "", inner: Struct | None = None) -> list[str]:
        """Statements that read one member; of an array of structs perhaps one member of each."""
        struct = inner or f.type
        if isinstance(struct, Struct):
            if not _reals(struct):
                return []
            if not f.shape:
                return [f"    from = read_{struct.name}(from, &to->{f.name});"]
            place = f"&to->{f.name}[i]" + (f".{member}" if member else "")
            return [f"    {self._loop(f)} {{ from = read_{struct.name}(from, {place}); }}"]
        if f.type is not Kind.REAL:
            return []
        if not f.shape:
            return [f"    from = copied(from, &to->{f.name}, 1);"]
        if len(f.shape) == 1:
            return [f"    from = copied(from, to->{f.name}, {int(f.shape[0])});"]
        return [f"    {self._loop(f)} {{ from = copied(from, to->{f.name}[i], {int(f.shape[1])}); }}"]

    @staticmethod
    def _loop(f: Field) -> str:
        return f"for (i = 0; i < {int(f.shape[0])}; ++i)"

    def _suspects(self) -> list[str]:
        """Statements that try the parameters of one body after the other."""
        named = {
            "instrument": [p.name for p in self._stand.instruments],
            "flywheel": [s.name for s in self._stand.flywheels],
            "point": [p.name for p in self._stand.points],
        }
        OK, RANGE = self._names.constant("OK"), self._names.constant("RANGE")
        lines = []
        for f in self._layout.parameters.fields:
            if f.name == "added_mass":
                lines += self._tried("memcpy(one.added_mass, given->added_mass, sizeof one.added_mass);")
                lines += [f"if (status != {OK}) {{", "    (void)snprintf(model->message, sizeof model->message,"]
                lines += ['                   "added_mass: expected a symmetric, positive semidefinite matrix");']
                lines += ["    return 0;", "}"]
            for k, name in enumerate(named.get(f.name, [f.name] if f.name == "carrier" else [])):
                place = f"{f.name}[{k}]" if f.shape else f.name
                body = f"given->{place}.body" if f.shape else f"given->{place}"
                lines += self._tried(f"one.{place} = given->{place};")
                if f.shape:
                    axes = f"given->{place}.axis, given->{place}.zero"
                    lines += [f"if (status == {RANGE}) {{", f'    return no_axes(model, "{name}", {axes});', "}"]
                if f.name != "point":
                    found = f"{body}.mass, {body}.inertia"
                    lines += [f"if (status != {OK}) {{", f'    return no_body(model, "{name}", {found});', "}"]
        return lines

    def _tried(self, change: str) -> list[str]:
        """Statements: the stand file's parameters but for one change, and what prepare says to them."""
        return [f"one = {self._names.function('default_parameters')};", change, "status = tried(&one);"]

    # -- calls ---------------------------------------------------------------------------------------------------------

    def _rates(self) -> str:
        return "coupled" if self._layout.flywheels and self._form.inputs == "torque" else "forward"

    def _step(self) -> str:
        return "step_driven" if self._layout.flywheels and self._form.inputs == "acceleration" else "step"

    def _calls(self) -> dict[str, Any]:
        """Calls of functions of the stand, by what they take."""
        NAME = self._stand.name.upper()
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
        given = common | {"V_dot": V_dot, "phi_ddot": phi_ddot, "out": "&momenta"}
        outputs = [("momentum", given)]
        if self._layout.flywheels:
            if self._form.inputs == "acceleration":
                outputs.append(("torque", given | {"tau": f"{values}TORQUE]"}))
            outputs.append(("mounts", given | {"mount_wrench": f"{values}LOADS]"}))
        if self._layout.sensors:
            outputs.append(("points", given | {"out": "readings"}))
        rates = common | {"V_dot": V_dot}
        rates |= drive if self._rates() == "forward" else drive | {"phi_ddot": phi_ddot}
        step = common | drive | {"dt": "h", "order": "4", "next": "&model->x"}
        return {
            "rates": self._call(self._rates(), rates, 17),
            "step": self._call(self._step(), step, 45),
            "outputs": [{"name": self._names.function(n), "text": self._call(n, inputs, 17)} for n, inputs in outputs],
        }

    def _call(self, function: str, known: dict[str, str], column: int) -> str:
        lines = wrapped(call(self._names, self._generated.program.function(function), known), " " * column)
        return "\n".join(lines).strip()


def _reals(struct: Struct) -> bool:
    """Has it any reals, or structs that have?"""
    return any(_reals(f.type) if isinstance(f.type, Struct) else f.type is Kind.REAL for f in struct.fields)
