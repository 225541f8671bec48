"""Wrench laws of one body: damping, suspension, legs. Each is one function of the program."""

from __future__ import annotations

from mahovik.core.formula.derived import wrench as derived
from mahovik.core.lower.library import Library
from mahovik.core.lower.symbolic import assign, translate
from mahovik.core.program.build import Body, call
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Expr, Place, Status, magnitude, real, select
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind


def damp(lib: Library) -> Function:
    """Damping of one body in its own frame, added to a wrench."""
    layout = lib.layout
    damper = Argument("damper", layout.damper)
    V = Argument("V", Kind.REAL, (6,), purpose="twist relative to the fluid, in the body's frame")
    P = Argument("P", Kind.REAL, (6,), "inout", "N, N m", "wrench that is added to")
    table = lib.table_argument()
    body = Body()
    factors: Place | None = None
    if layout.terms or layout.quadratic_damping:
        factors = body.local("x", (12,), comment="u v w p q r and their magnitudes")
        for k in range(6):
            body.set(factors[k], V.place[k])
        for k in range(6):
            body.set(factors[k + 6], magnitude(V.place[k]))
    if layout.linear_damping:
        with body.loop("i", 6) as i:
            row = derived.row_times("linear", "V")
            body.add(P.place[i], -translate(row, {"linear": damper.place.linear[i], "V": V.place}))
    if layout.quadratic_damping:
        assert factors is not None
        with body.loop("i", 6) as i, body.loop("j", 6) as j:
            drag = damper.place.quadratic[i][j] * (factors[j] * factors[j + 6])
            body.add(P.place[i], -drag)
    if layout.terms:
        assert factors is not None
        first, last = damper.place.first_term, damper.place.last_term
        with body.loop("t", last, start=first, most=layout.terms) as t:
            term = table.place.term[t]
            body.add(P.place[term.wrench], term.value * factors[term.first] * factors[term.second])
    return Function(
        "damp",
        "Adds the damping of one body to its wrench, both in the body's own frame.",
        (table, damper, V, P),
        body.statements,
        equation="(7)",
    )


def rotation_vector(lib: Library) -> Function:
    """Rotation vector of a quaternion, of length at most pi."""
    q = Argument("q", Kind.REAL, (4,))
    r = Argument("r", Kind.REAL, (3,), "out", "rad")
    body = Body()
    w = q.place[0]
    u = list(q.place)[1:]
    side = body.let("side", select(w < 0, real(-1), real(1)), "q and -q are the same rotation: take the shorter way")
    square = body.let("square", u[0] * u[0] + u[1] * u[1] + u[2] * u[2])
    ratio = body.local("ratio", comment="angle over the length of the vector part")
    body.set(ratio, real(2))
    with body.when(square > lib.thresholds.small_square):
        length = body.let("length", call(lib["sqrt"], square))
        body.set(ratio, 2 * call(lib["atan2"], length, side * w) / length)
    with body.otherwise():
        body.note("as it must be; the test keeps zero out of the division whatever q is")
        with body.when(side * w > 0.5):
            body.set(ratio, 2 / (side * w))
    for target, component in zip(r.place, u, strict=True):
        body.set(target, side * ratio * component)
    return Function(
        "rotation_vector",
        "Rotation vector of a quaternion of about unit length; its length is at most pi.",
        (q, r),
        body.statements,
    )


def suspend(lib: Library) -> Function:
    """Wrench of the 6x6 suspension, added to F."""
    law = Argument("law", lib.layout.suspension)
    x = lib.state_argument()
    C = Argument("C", Kind.REAL, (9,), purpose="attitude of the carrier")
    F = Argument("F", Kind.REAL, (6,), "inout", "N, N m", "wrench that is added to")
    body = Body()
    shift = body.local("shift", (3,))
    body_shift = body.local("shift1", (3,), comment="C^T (O1 - position)")
    turn = body.local("turn", (4,), comment="quaternion of C_eq^T C")
    angle = body.local("angle", (3,), comment="its rotation vector")
    for k in range(3):
        body.set(shift[k], x.place.position[k] - law.place.position[k])
    body.call(lib["rotate_back"], C.place, shift, body_shift)
    binding = {"q_eq": law.place.attitude, "q": x.place.attitude}
    assign(body, list(turn), derived.relative_quaternion(), binding)
    body.call(lib["rotation_vector"], turn, angle)
    displacement: list[Expr] = [*body_shift, *angle]
    with body.loop("i", 6) as i:
        row = derived.suspension_row()
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


def add_leg(lib: Library) -> Function:
    """Force of one leg, added to F."""
    law = Argument("leg", lib.layout.leg)
    x = lib.state_argument()
    C = Argument("C", Kind.REAL, (9,), purpose="attitude of the carrier")
    F = Argument("F", Kind.REAL, (6,), "inout", "N, N m", "wrench that is added to")
    body = Body()
    point = law.place.carrier
    span = body.local("span", (3,))
    span1 = body.local("span1", (3,), comment="in E1, from O1")
    reach = body.local("reach", (3,), comment="from the carrier's end to the ground's, in E1")
    direction = body.local("direction", (3,))
    velocity = body.local("velocity", (3,), comment="of the carrier's end, in E1")
    force = body.local("force", (3,))
    for i in range(3):
        body.set(span[i], law.place.ground[i] - x.place.position[i])
    body.call(lib["rotate_back"], C.place, span, span1)
    for i in range(3):
        body.set(reach[i], span1[i] - point[i])
    square = reach[0] * reach[0] + reach[1] * reach[1] + reach[2] * reach[2]
    distance = body.let("distance", call(lib["sqrt"], square))
    with body.when(distance < lib.thresholds.zero_length, comment="no direction"):
        body.ret(Status("RANGE"))
    inverse = body.let("inverse", 1 / distance)
    for i in range(3):
        body.set(direction[i], reach[i] * inverse)
    six = list(x.place.V)
    assign(body, list(velocity), derived.twist_at(), {"v": six[:3], "omega": six[3:], "O": point})
    formulas = derived.leg()
    rate = body.let("rate", translate(formulas.rate, {"direction": direction, "velocity": velocity}), "of its length")
    bound = {
        "stiffness": law.place.stiffness,
        "damping": law.place.damping,
        "distance": distance,
        "length": law.place.length,
        "rate": rate,
    }
    tension = body.let("tension", translate(formulas.tension, bound))
    for i in range(3):
        body.set(force[i], tension * direction[i])
    add_force(body, list(F.place), point, list(force), None)
    body.ret(Status("OK"))
    return Function(
        "add_leg",
        "Adds the force of one leg; RANGE where its ends meet, for then it has no direction.",
        (law, x, C, F),
        body.statements,
        equation="(7)",
        returns=Kind.STATUS,
        statuses=("OK", "RANGE"),
    )


def add_force(body: Body, target: list[Place], origin: Place, force: list[Place], moment: list[Place] | None) -> None:
    """F += T (force; moment): a wrench at `origin`, in axes of E1."""
    for t, f in zip(target[:3], force, strict=True):
        body.add(t, f)
    formula = derived.moment_of_force() if moment is None else derived.moved_moment()
    binding = {"O": origin, "f": force, "n": moment}
    assign(body, target[3:], formula, binding, add=True)
