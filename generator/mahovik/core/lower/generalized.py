"""generalized: A, D of (10), I0, J0 and q'' of (11); quaternion of angles. Public functions."""

from __future__ import annotations

from typing import Any

from mahovik.contract.quantities import SINGULAR_BELOW
from mahovik.core.derive.order import SEQUENCES
from mahovik.core.formula.derived import attitude as derived
from mahovik.core.lower.checks import check_vector
from mahovik.core.lower.flywheels import sine_and_cosine
from mahovik.core.lower.forward import STATE_STATUSES
from mahovik.core.lower.library import Library
from mahovik.core.lower.matrices import fill
from mahovik.core.lower.symbolic import assign, translate
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Expr, Place, magnitude, real
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind

_NAMES = ("psi", "theta", "phi")


def angles_argument(lib: Library) -> Argument:
    """psi, theta, phi in the sequence of the stand."""
    sequence = lib.layout.structure.angles
    axes = " ".join(f"C{axis}({name})" for axis, name in zip(SEQUENCES[sequence], _NAMES, strict=True))
    return Argument("angles", Kind.REAL, (3,), unit="rad", purpose=f"psi, theta, phi of C = {axes} ({sequence})")


def quaternion(lib: Library) -> Function:
    """Unit quaternion of three angles."""
    angles = angles_argument(lib)
    attitude = Argument("attitude", Kind.REAL, (4,), "out", purpose="unit quaternion, w first")
    body = Body()
    check_vector.put_into(body, lib, angles.place, lib.limits["MAX_PHASE"].expression)
    binding: dict[str, Expr] = {}
    for i, name in enumerate(_NAMES):
        s = body.local(f"s_{name}")
        c = body.local(f"c_{name}")
        body.call(lib["sincos"], real(0.5) * angles.place[i], s, c)
        binding |= {f"s_{name}": s, f"c_{name}": c}
    assign(body, list(attitude.place), derived.quaternion_of(lib.layout.structure.angles), binding)
    return body.checked_function(
        "quaternion", "Attitude quaternion of three angles.", (angles, attitude), statuses=STATE_STATUSES, public=True
    )


def products(lib: Library) -> Function:
    """I0 = K A and J0 = K D + M A."""
    m = Argument("m", lib.layout.matrices)
    out = Argument("out", lib.layout.generalized, (), "inout")
    body = Body()
    with body.loop("i", 6) as i, body.loop("j", 6) as j:
        I0 = body.local("I0")
        J0 = body.local("J0")
        body.set(I0, real(0))
        body.set(J0, real(0))
        with body.loop("k", 6) as k:
            body.add(I0, m.place.K[i][k] * out.place.A[k][j])
            body.add(J0, m.place.K[i][k] * out.place.D[k][j] + m.place.M[i][k] * out.place.A[k][j])
        body.set(out.place.I0[i][j], I0)
        body.set(out.place.J0[i][j], J0)
    return body.function("products", "I0 = K A, J0 = K D + M A.", (m, out), equation="(11)")


def generalized(lib: Library) -> Function:
    """The generalized-coordinate form at a state given by angles."""
    layout = lib.layout
    table = lib.table_argument()
    x = Argument("x", layout.state, purpose="state; its attitude is ignored, `angles` replaces it")
    angles = angles_argument(lib)
    phi_ddot, wrench = lib.phi_ddot_arguments(), lib.wrench_arguments()
    out = Argument("out", layout.generalized, (), "out", purpose="A, D, I0, J0, q_dot, q_ddot")
    body = Body()
    y = body.local("y", (), layout.state, "the state with the attitude of the angles")
    V_dot = body.local("V_dot", (6,))
    m = body.local("m", (), layout.matrices)
    body.copy(y, x.place)
    lib.check(body, "quaternion", angles.place, y.attitude)
    binding: dict[str, Expr] = {}
    for i, name in enumerate(_NAMES):
        turn = sine_and_cosine(lib, body, angles.place[i], f"_{name}")
        binding |= {f"s_{name}": turn["s"], f"c_{name}": turn["c"]}
    singular = body.let(
        "singular", translate(derived.singular(layout.structure.angles), binding), "A has no inverse where this is 0"
    )
    lib.check(body, "forward", table.place, y, *(a.place for a in (*phi_ddot, *wrench)), V_dot)
    lib.check(body, "matrices", table.place, y, *(a.place for a in wrench), m)
    lib.guard(body, magnitude(singular) < SINGULAR_BELOW, "SINGULAR_ATTITUDE")
    if layout.stream:
        body.note("J0 of (11) holds M at V itself, not relative to the stream")
        body.call(lib["velocity_matrix"], x.place.V, m)
    C = body.local("C", (9,))
    body.call(lib["rotation"], y.attitude, C)
    _kinematics(
        body,
        x.place.V,
        C,
        binding | {"singular_inv": body.let("singular_inv", 1 / singular)},
        V_dot,
        out.place,
        layout.structure.angles,
    )
    body.call(lib["products"], m, out.place)
    return body.checked_function(
        "generalized",
        "The equations in generalized coordinates: A, D, I0, J0, q', and q'' for given phi''.",
        (table, x, angles, *phi_ddot, *wrench, out),
        equation="(10), (11)",
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE", "SINGULAR_ATTITUDE"),
        public=True,
    )


def _kinematics(
    body: Body,
    V: Place,
    C: Place,
    binding: dict[str, Expr],
    V_dot: Place,
    out: Place,
    sequence: str,
) -> None:
    """q' = A^-1 V, A, D, and q'' = A^-1 (V* - D q'): (11) with K cancelled."""
    six = list(V)
    rate, acceleration = list(out.q_dot), list(out.q_ddot)
    rotate = derived.rotation_product()
    inverse = derived.angle_rates(sequence)
    body.note("q' = A^-1 V")
    assign(body, rate[:3], rotate, {"C": C, "a": six[:3]})
    assign(body, rate[3:], inverse, binding | {"a": six[3:]})
    names = dict(zip(("psi_dot", "theta_dot", "phi_dot"), rate[3:], strict=True))
    everything: dict[str, Any] = binding | names | {"C": C, "omega": six[3:]}
    A, D = derived.kinematics(sequence)
    fill(body, out.A, A, everything)
    fill(body, out.D, D, everything)
    rest = body.local("rest", (6,), comment="V* - D q'")
    with body.loop("i", 6) as i:
        total: Expr = V_dot[i]
        for j in range(6):
            total = total - out.D[i][j] * out.q_dot[j]
        body.set(rest[i], total)
    body.note("q'' = A^-1 (V* - D q')")
    assign(body, acceleration[:3], rotate, {"C": C, "a": list(rest)[:3]})
    assign(body, acceleration[3:], inverse, binding | {"a": list(rest)[3:]})
