"""The suspension in the program of a stand."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from mahovik.core.lower import units
from mahovik.core.lower.freedoms import rows_of
from mahovik.core.lower.function_set import FunctionSet
from mahovik.core.lower.law import ATTITUDE, WRENCH, CarrierProgram, Run, declared
from mahovik.core.lower.units import Member, matrix, vector
from mahovik.core.program.expression import Place
from mahovik.core.program.kernel import Reals, Record, argument, body, reals, result
from mahovik.core.program.types import Field, Kind, Struct, member
from mahovik.core.program.vector import dot
from mahovik.core.stand.model import Stand, Structure
from mahovik.laws.suspension.law import Suspension

SUSPENSION = Struct(
    "suspension",
    "Suspension of the carrier to E0.",
    (*declared(Suspension), Field("attitude", Kind.REAL, (4,), "", "quaternion of the equilibrium attitude")),
)


class SuspensionProgram(CarrierProgram):
    """The one suspension that a stand may have."""

    words = "suspension"
    quaternions = ("suspension.attitude",)

    def present(self, structure: Structure) -> bool:
        """Whether there is one."""
        return bool(structure.law("suspension"))

    def fields(self, structure: Structure) -> list[Field]:
        """One struct."""
        return [Field("suspension", SUSPENSION)]

    def values(self, stand: Stand, run: Run) -> dict[str, object]:
        """Numbers of the suspension; the equilibrium attitude as the program's own quaternion of the angles."""
        law = stand.law(Suspension)
        assert law is not None
        attitude = run("quaternion", {"angles": law.angles})[1]["attitude"]
        numbers = {"stiffness": law.stiffness, "damping": law.damping, "position": law.position}
        return {"suspension": numbers | {"attitude": attitude}}

    def members(self, stand: Stand, field: Field, value: Sequence[object]) -> Iterator[Member]:
        """Elements of both matrices and of the equilibrium."""
        stiffness, damping, position, _ = SUSPENSION.fields
        for f, unit in ((stiffness, units.stiffness), (damping, lambda i, j: units.law(i, (j,)))):
            text = f"{f.name} of the suspension, wrench on the carrier at O1 in E1"
            yield from matrix(f"suspension.{f.name}", f, member(value, f.name), unit, text)
        place = member(value, "position")
        yield from vector("suspension.position", position, place, f"suspension: {position.comment}")
        for i, number in enumerate(member(value, "attitude")):
            text = f"equilibrium attitude of the suspension, unit quaternion, {'wxyz'[i]}"
            yield Member(f"suspension.attitude[{i + 1}]", units.NONE, text, float(number))

    def add_functions(self, lib: FunctionSet) -> None:
        """The rotation vector, and the wrench."""
        small = lib.thresholds.small_square

        @lib.kernel()
        def rotation_vector(q: Reals = argument("", 4), r: Reals = result("", 3, unit="rad")) -> None:
            """Rotation vector of a quaternion of about unit length; its length is at most pi."""
            u = q[1:4]
            side = -1.0 if q[0] < 0 else 1.0  # q and -q are the same rotation: take the one of the smaller angle
            square = dot(u, u)
            ratio = reals()  # rotation angle, then divided by the length of the vector part
            divisor = reals()
            if square > small:
                divisor = lib["sqrt"](square)
                ratio = 2 * lib["atan2"](divisor, side * q[0])
            else:
                # |w| is near 1 here; the test only prevents a division by zero for other q
                divisor = side * q[0] if side * q[0] > 0.5 else 1.0
                ratio = 2
            ratio = ratio / divisor
            r[:] = side * ratio * u

        self._add_suspend(lib, "suspend")
        if hold := lib.layout.structure.hold:
            self._add_suspend(lib, "suspend_along", rows_of(hold))

    def _add_suspend(self, lib: FunctionSet, name: str, rows: Sequence[int] = ()) -> None:
        """The wrench; `rows`: these components of it alone, which the freedoms of the hold take."""
        words = "-(stiffness x + damping V), x: C^T (O1 - position), rotation vector of C_eq^T C"

        @lib.kernel(name, equation="(7)", purpose=f"Adds the suspension: {words}.")
        def suspend(
            law: Record = argument(struct=SUSPENSION), x: Record = lib.x, C: Reals = ATTITUDE, F: Reals = WRENCH
        ) -> None:
            """Adds the suspension."""
            shift = reals(3)
            shift1 = reals(3)  # C^T (O1 - position)
            turn = reals(4)  # quaternion of C_eq^T C
            angle = reals(3)  # its rotation vector
            shift[:] = x.position - law.position
            lib["rotate_back"](C, shift, shift1)
            q = x.attitude
            p = law.attitude
            turn[0] = q[0] * p[0] + q[1] * p[1] + q[2] * p[2] + q[3] * p[3]
            turn[1] = q[1] * p[0] + q[2] * p[3] - q[0] * p[1] - q[3] * p[2]
            turn[2] = q[2] * p[0] + q[3] * p[1] - q[0] * p[2] - q[1] * p[3]
            turn[3] = q[1] * p[2] + q[3] * p[0] - q[0] * p[3] - q[2] * p[1]
            lib["rotation_vector"](turn, angle)
            if rows:
                for i in rows:
                    F[i] -= dot([*x.V, *law.stiffness[i]], [*law.damping[i], *shift1, *angle])
            else:
                for i in range(6):
                    F[i] -= dot([*x.V, *law.stiffness[i]], [*law.damping[i], *shift1, *angle])

    def act(
        self, lib: FunctionSet, table: Record, x: Record, C: Place, F: Place, along: bool = False, **more: Place
    ) -> None:
        """Adds the wrench."""
        name = "suspend_along" if along else "suspend"
        body().do(lib[name](table.suspension, x, C, F))


LAW = SuspensionProgram()
