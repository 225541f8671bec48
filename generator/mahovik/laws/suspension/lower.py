"""The suspension in the program of a stand."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from mahovik.core.formula.derived import FormulaModule
from mahovik.core.lower import units
from mahovik.core.lower.function_set import FunctionSet
from mahovik.core.lower.law import LawLowering
from mahovik.core.lower.member import Member, matrix, member, vector
from mahovik.core.lower.symbolic import assign, translate
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Expr, Place, real, select
from mahovik.core.program.function import Function
from mahovik.core.program.types import Field, Kind, Struct
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure_facts import Structure
from mahovik.laws.suspension.law import Suspension as Data

REAL = Kind.REAL
SUSPENSION = Struct(
    "suspension",
    "Suspension of the carrier to E0.",
    (
        Field("stiffness", REAL, (6, 6), "SI", "wrench -= stiffness x"),
        Field("damping", REAL, (6, 6), "SI", "wrench -= damping V"),
        Field("position", REAL, (3,), "m", "equilibrium of O1, in E0"),
        Field("attitude", REAL, (4,), "", "quaternion of the equilibrium attitude"),
    ),
)

if TYPE_CHECKING:
    from mahovik.laws.suspension import derive as formulas
else:
    formulas = FormulaModule("laws.suspension.derive")


class Suspension(LawLowering):
    """The one suspension that a stand may have."""

    words = "suspension"
    quaternions = ("suspension.attitude",)

    def present(self, structure: Structure) -> bool:
        """Whether there is one."""
        return bool(structure.law("suspension"))

    def fields(self, structure: Structure) -> list[Field]:
        """One struct."""
        return [Field("suspension", SUSPENSION)]

    def values(self, stand: Stand, run: Any) -> dict[str, Any]:
        """Numbers of the suspension; the equilibrium attitude as the program's own quaternion of the angles."""
        law = stand.law(Data)
        assert law is not None
        attitude = run("quaternion", {"angles": law.angles})[1]["attitude"]
        numbers = {"stiffness": law.stiffness, "damping": law.damping, "position": law.position}
        return {"suspension": numbers | {"attitude": attitude}}

    def members(self, stand: Stand, field: Field, value: Any) -> Iterator[Member]:
        """Elements of both matrices and of the equilibrium."""
        for f in SUSPENSION.fields:
            given = member(value, f.name)
            name = f"suspension.{f.name}"
            if f.name == "stiffness":
                text = "stiffness of the suspension, wrench on the carrier at O1 in E1"
                yield from matrix(name, f, given, lambda i, j: units.law(i, (j,), rate=False), text)
            elif f.name == "damping":
                text = "damping of the suspension, wrench on the carrier at O1 in E1"
                yield from matrix(name, f, given, lambda i, j: units.law(i, (j,)), text)
            elif f.name == "attitude":
                for i, number in enumerate(given):
                    text = f"equilibrium attitude of the suspension, unit quaternion, {'wxyz'[i]}"
                    yield Member(f"{name}[{i + 1}]", units.NONE, text, float(number))
            else:
                yield from vector(name, f, given, f"suspension: {f.comment}")

    def add_functions(self, lib: FunctionSet) -> None:
        """The rotation vector, and the wrench."""
        lib.add(rotation_vector(lib))
        lib.add(suspend(lib))

    def act(self, lib: FunctionSet, body: Body, table: Place, x: Place, C: Place, F: Place) -> None:
        """Adds the wrench."""
        body.call(lib["suspend"], table.suspension, x, C, F)


LOWERING = Suspension()


def rotation_vector(lib: FunctionSet) -> Function:
    """Rotation vector of a quaternion, of length at most pi."""
    q = Argument("q", Kind.REAL, (4,))
    r = Argument("r", Kind.REAL, (3,), "out", "rad")
    body = Body()
    w = q.place[0]
    u = list(q.place)[1:]
    side = body.let(
        "side", select(w < 0, real(-1), real(1)), "q and -q are the same rotation: take the one of the smaller angle"
    )
    square = body.let("square", u[0] * u[0] + u[1] * u[1] + u[2] * u[2])
    ratio = body.local("ratio", comment="rotation angle, then divided by the length of the vector part")
    divisor = body.local("divisor")
    with body.when(square > lib.thresholds.small_square):
        body.set(divisor, lib["sqrt"](square))
        body.set(ratio, 2 * lib["atan2"](divisor, side * w))
    with body.otherwise():
        body.note("|w| is near 1 here; the test only prevents a division by zero for other q")
        body.set(divisor, select(side * w > 0.5, side * w, real(1)))
        body.set(ratio, real(2))
    body.set(ratio, ratio / divisor)
    for target, component in zip(r.place, u, strict=True):
        body.set(target, side * ratio * component)
    return Function(
        "rotation_vector",
        "Rotation vector of a quaternion of about unit length; its length is at most pi.",
        (q, r),
        body.statements,
    )


def suspend(lib: FunctionSet) -> Function:
    """Wrench of the 6x6 suspension, added to F."""
    law = Argument("law", SUSPENSION)
    x = lib.state_argument()
    C = Argument("C", Kind.REAL, (9,), purpose="attitude of the carrier")
    F = Argument("F", Kind.REAL, (6,), "inout", "N, N m", "wrench; this law is added to it")
    body = Body()
    shift = body.local("shift", (3,))
    body_shift = body.local("shift1", (3,), comment="C^T (O1 - position)")
    turn = body.local("turn", (4,), comment="quaternion of C_eq^T C")
    angle = body.local("angle", (3,), comment="its rotation vector")
    for k in range(3):
        body.set(shift[k], x.place.position[k] - law.place.position[k])
    body.call(lib["rotate_back"], C.place, shift, body_shift)
    binding = {"q_eq": law.place.attitude, "q": x.place.attitude}
    assign(body, list(turn), formulas.relative_quaternion(), binding)
    body.call(lib["rotation_vector"], turn, angle)
    displacement: list[Expr] = [*body_shift, *angle]
    with body.loop("i", 6) as i:
        row = formulas.wrench_row()
        bound = {
            "stiffness": law.place.stiffness[i],
            "damping": law.place.damping[i],
            "x": displacement,
            "V": x.place.V,
        }
        body.add(F.place[i], -translate(row, bound))
    return Function(
        "suspend",
        "Adds the suspension: -(stiffness x + damping V), x = (C^T (O1 - position), rotation vector of C_eq^T C).",
        (law, x, C, F),
        body.statements,
        equation="(7)",
    )
