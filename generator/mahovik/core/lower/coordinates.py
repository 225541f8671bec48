"""state_from_coordinates: a wanted motion in generalized coordinates as the twist and its rate that inverse takes."""

from __future__ import annotations

from mahovik.contract.quantities import SINGULAR_BELOW
from mahovik.core.formula.derived import attitude as derived
from mahovik.core.formula.derived import motion as derived_motion
from mahovik.core.formula.derived import wrench as derived_wrench
from mahovik.core.lower.checks import check_vector
from mahovik.core.lower.flywheels import sine_and_cosine
from mahovik.core.lower.generalized import angles_argument
from mahovik.core.lower.library import Library
from mahovik.core.lower.symbolic import assign, translate
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Expr, magnitude
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind

_NAMES = ("psi", "theta", "phi")


def state_from_coordinates(lib: Library) -> Function:
    """V = A q', V* = A q'' + D q' (10)."""
    layout = lib.layout
    sequence = layout.structure.angles
    angles = angles_argument(lib)
    position = Argument("position", Kind.REAL, (3,), unit="m", purpose="position of O1, in E0")
    q_dot = Argument("q_dot", Kind.REAL, (6,), unit="m/s, rad/s", purpose="rates of position and of the angles")
    q_ddot = Argument("q_ddot", Kind.REAL, (6,), unit="m/s2, rad/s2", purpose="rates of q_dot")
    x = Argument(
        "x", layout.state, (), "inout", purpose="its position, attitude and V are written; phases and speeds are kept"
    )
    V_dot = Argument("V_dot", Kind.REAL, (6,), "out", "m/s2, rad/s2", "derivative of the components of V")
    body = Body()
    check_vector.put_into(body, lib, position.place, lib.limits["MAX_POSITION"].expression)
    lib.check(body, "within", q_dot.place, 6, lib.limits["MAX_SPEED"].expression)
    lib.check(body, "within", q_ddot.place, 6, lib.limits["MAX_ACCELERATION"].expression)
    attitude = body.local("attitude", (4,))
    C = body.local("C", (9,))
    v = body.local("v", (3,), comment="C^T r'")
    a = body.local("a", (3,), comment="C^T r''")
    omega = body.local("omega", (3,), comment="B (psi', theta', phi')")
    lib.check(body, "quaternion", angles.place, attitude)
    bound: dict[str, Expr] = {}
    for i, name in enumerate(_NAMES):
        turn = sine_and_cosine(lib, body, angles.place[i], f"_{name}")
        bound |= {f"s_{name}": turn["s"], f"c_{name}": turn["c"]}
    singular = body.let("singular", translate(derived.singular(sequence), bound))
    lib.guard(body, magnitude(singular) < SINGULAR_BELOW, "SINGULAR_ATTITUDE")
    rates, seconds = list(q_dot.place), list(q_ddot.place)
    body.call(lib["rotation"], attitude, C)
    back = derived_wrench.rotated_back()
    assign(body, list(v), back, {"C": C, "a": rates[:3]})
    assign(body, list(a), back, {"C": C, "a": seconds[:3]})
    named = bound | dict(zip(("psi_dot", "theta_dot", "phi_dot"), rates[3:], strict=True))
    assign(body, list(omega), derived.angular_velocity(sequence), named | {"a": rates[3:]})
    body.note("V* = A q'' + D q': v* = C^T r'' - omega x v")
    assign(body, list(V_dot.place)[:3], derived_motion.linear_rate(), {"r": a, "omega": omega, "O": v})
    assign(
        body, list(V_dot.place)[3:], derived.angular_acceleration(sequence), named | {"a": seconds[3:], "b": rates[3:]}
    )
    body.copy_array(x.place.position, position.place)
    body.copy_array(x.place.attitude, attitude)
    for i in range(3):
        body.set(x.place.V[i], v[i])
        body.set(x.place.V[i + 3], omega[i])
    return body.checked_function(
        "state_from_coordinates",
        "State and V* of a wanted motion in generalized coordinates: V = A q', V* = A q'' + D q'.",
        (position, angles, q_dot, q_ddot, x, V_dot),
        equation="(10)",
        statuses=("OK", "NOT_FINITE", "RANGE", "SINGULAR_ATTITUDE"),
        public=True,
    )
