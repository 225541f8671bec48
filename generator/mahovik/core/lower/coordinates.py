"""Generalized coordinates of a free carrier: quaternion of angles; A, D of (10), I0, J0 and q_ddot of (11); and back.

state_from_coordinates gives a wanted motion in generalized coordinates as the twist and its rate that inverse takes.
"""

from __future__ import annotations

from typing import Any

from mahovik.contract.quantities import SINGULAR_BELOW
from mahovik.core.derive.order import SEQUENCES
from mahovik.core.formula.derived import attitude as derived
from mahovik.core.lower.checks import check_vector
from mahovik.core.lower.forward import STATE_STATUSES
from mahovik.core.lower.library import Library
from mahovik.core.lower.symbolic import formula
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Expr, Status
from mahovik.core.program.function import Function
from mahovik.core.program.kernel import OK, Reals, argument, body, changed, kernel, let, reals, record, result
from mahovik.core.program.types import Kind
from mahovik.core.program.vector import cross, dot

ANGLES = ("psi", "theta", "phi")
SINGULAR_ATTITUDE = Status("SINGULAR_ATTITUDE")


def angles_argument(lib: Library) -> Argument:
    """psi, theta, phi in the sequence of the stand."""
    sequence = lib.layout.structure.angles
    axes = " ".join(f"C{axis}({name})" for axis, name in zip(SEQUENCES[sequence], ANGLES, strict=True))
    return Argument("angles", Kind.REAL, (3,), unit="rad", purpose=f"psi, theta, phi of C = {axes} ({sequence})")


def sines_and_cosines(lib: Library, angles: list[Any]) -> dict[str, Expr]:
    """Locals s_psi, c_psi, ... of three angles."""
    numbers: dict[str, Expr] = {}
    for name, angle in zip(ANGLES, angles, strict=True):
        s, c = numbers[f"s_{name}"], numbers[f"c_{name}"] = body().local(f"s_{name}"), body().local(f"c_{name}")
        body().do(lib["sincos"](angle, s, c))
    return numbers


def quaternion(lib: Library) -> Function:
    """Unit quaternion of three angles."""
    given: Any = angles_argument(lib)

    @kernel(statuses=STATE_STATUSES, public=True)
    def quaternion(angles: Reals = given, attitude: Reals = result("unit quaternion, w first", 4)) -> Status:
        """Attitude quaternion of three angles."""
        check_vector(lib, angles, lib.limit("MAX_PHASE"))
        numbers = sines_and_cosines(lib, [0.5 * angle for angle in angles])
        attitude[:] = formula(derived.quaternion_of(lib.layout.structure.angles), **numbers)
        return OK

    return quaternion


def add_state_from_coordinates(lib: Library) -> None:
    """Adds V = A q_dot, V_dot = A q_ddot + D q_dot (10)."""
    layout, sequence = lib.layout, lib.layout.structure.angles
    given: Any = angles_argument(lib)

    @lib.kernel(equation="(10)", statuses=(*STATE_STATUSES, "SINGULAR_ATTITUDE"), public=True)
    def state_from_coordinates(
        position: Reals = argument("position of O1, in E0", 3, unit="m"),
        angles: Reals = given,
        q_dot: Reals = argument("rates of position and of the angles", 6, unit="m/s, rad/s"),
        q_ddot: Reals = argument("rates of q_dot", 6, unit="m/s2, rad/s2"),
        x: Any = changed("its position, attitude and V are written; phases and speeds are kept", struct=layout.state),
        V_dot: Reals = result("derivative of the components of V", 6, unit="m/s2, rad/s2"),
    ) -> Status:
        """State and V_dot of a wanted motion in generalized coordinates: V = A q_dot, V_dot = A q_ddot + D q_dot."""
        check_vector(lib, position, lib.limit("MAX_POSITION"))
        lib["within"](q_dot, 6, lib.limit("MAX_SPEED"))
        lib["within"](q_ddot, 6, lib.limit("MAX_ACCELERATION"))
        attitude = reals(4)
        C = reals(9)
        v = reals(3)  # C^T r_dot
        a = reals(3)  # C^T r_ddot
        omega = reals(3)  # B (psi_dot, theta_dot, phi_dot)
        lib["quaternion"](angles, attitude)
        numbers = sines_and_cosines(lib, list(angles))
        singular = let("singular", formula(derived.singular(sequence), **numbers))
        if abs(singular) < SINGULAR_BELOW:
            return SINGULAR_ATTITUDE
        lib["rotation"](attitude, C)
        v[:] = C.T @ q_dot[0:3]
        a[:] = C.T @ q_ddot[0:3]
        rates = dict(zip(("psi_dot", "theta_dot", "phi_dot"), q_dot[3:6], strict=True))
        omega[:] = formula(derived.angular_velocity(sequence), **numbers, a=q_dot[3:6])
        # V_dot = A q_ddot + D q_dot: v_dot = C^T r_ddot - omega x v
        V_dot[0:3] = cross(v, omega) + a
        turning = derived.angular_acceleration(sequence)
        V_dot[3:6] = formula(turning, **numbers, **rates, a=q_ddot[3:6], b=q_dot[3:6])
        x.position[:] = position
        x.attitude[:] = attitude
        for i in list(range(3)):
            x.V[i] = v[i]
            x.V[i + 3] = omega[i]
        return OK


def add_generalized(lib: Library) -> None:
    """Adds the generalized-coordinate form at a state given by angles."""
    layout, sequence = lib.layout, lib.layout.structure.angles
    given: Any = angles_argument(lib)

    @lib.kernel(equation="(11)")
    def products(m: Any = argument(struct=layout.matrices), out: Any = changed(struct=layout.generalized)) -> None:
        """I0 = K A, J0 = K D + M A."""
        for i in range(6):
            for j in range(6):
                I0 = reals()
                J0 = reals()
                I0 = 0
                J0 = 0
                for k in range(6):
                    I0 += m.K[i][k] * out.A[k][j]
                    J0 += m.K[i][k] * out.D[k][j] + m.M[i][k] * out.A[k][j]
                out.I0[i][j] = I0
                out.J0[i][j] = J0

    statuses = (*STATE_STATUSES, "NOT_POSITIVE_DEFINITE", "SINGULAR_ATTITUDE")

    @lib.kernel(equation="(10), (11)", statuses=statuses, public=True)
    def generalized(
        table: Any = lib.table,
        x: Any = argument("state; its attitude is ignored, `angles` replaces it", struct=layout.state),
        angles: Reals = given,
        phi_ddot: Any = lib.phi_ddot,
        wrench: Any = lib.wrench,
        out: Any = result("A, D, I0, J0, q_dot, q_ddot", struct=layout.generalized),
    ) -> Status:
        """The equations in generalized coordinates: A, D, I0, J0, q_dot, and q_ddot for given phi_ddot."""
        y = record(layout.state)  # the state with the attitude of the angles
        V_dot = reals(6)
        m = record(layout.matrices)
        y = x
        lib["quaternion"](angles, y.attitude)
        numbers = sines_and_cosines(lib, list(angles))
        singular = let("singular", formula(derived.singular(sequence), **numbers), "A has no inverse where this is 0")
        lib["forward"](table, y, None, None, phi_ddot, wrench, V_dot, None)
        lib["matrices"](table, y, wrench, m)
        if abs(singular) < SINGULAR_BELOW:
            return SINGULAR_ATTITUDE
        if layout.stream:
            # J0 of (11) holds M at V itself, not relative to the stream
            lib["velocity_matrix"](x.V, m)
        C = reals(9)
        lib["rotation"](y.attitude, C)
        singular_inv = 1 / singular
        inverse = derived.angle_rates(sequence)
        # q_dot = A^-1 V
        out.q_dot[0:3] = C @ x.V[0:3]
        out.q_dot[3:6] = formula(inverse, **numbers, singular_inv=singular_inv, a=x.V[3:6])
        rates = dict(zip(("psi_dot", "theta_dot", "phi_dot"), out.q_dot[3:6], strict=True))
        A, D = derived.kinematics(sequence)
        out.A[:] = formula(A, **numbers, **rates, C=C, omega=x.V[3:6]).square
        out.D[:] = formula(D, **numbers, **rates, C=C, omega=x.V[3:6]).square
        rest = reals(6)  # V_dot - D q_dot
        for i in range(6):
            rest[i] = dot((1, *-out.D[i]), (V_dot[i], *out.q_dot))
        # q_ddot = A^-1 (V_dot - D q_dot)
        out.q_ddot[0:3] = C @ rest[0:3]
        out.q_ddot[3:6] = formula(inverse, **numbers, singular_inv=singular_inv, a=rest[3:6])
        products(m, out)
        return OK
