"""Attitude: C, B, A, D of the three sequences, their inverses, and quaternions, exactly."""

from __future__ import annotations

import pytest
import sympy as sp

from derive.exact import remainders, rotation
from mahovik.core.derive import SEQUENCES as BY_NAME
from mahovik.core.derive import attitude as derived
from mahovik.core.derive.screw import cross, matrix, vector

SEQUENCES = tuple(BY_NAME)
ANGLES = sp.symbols("psi theta phi")
TIME = sp.Symbol("t")
CIRCLES = tuple(sp.Symbol(f"c_{n}") ** 2 + sp.Symbol(f"s_{n}") ** 2 - 1 for n in derived.ANGLES)


def about(axis: int, angle: sp.Expr) -> sp.Matrix:
    """Rotation about a coordinate axis by Rodrigues' formula: E + sin <e> + (1 - cos) <e><e>."""
    e = cross(sp.Matrix([1 if k == axis else 0 for k in (1, 2, 3)]))
    return sp.eye(3) + sp.sin(angle) * e + (1 - sp.cos(angle)) * e * e


def product(sequence: str, angles: tuple[sp.Expr, ...] = ANGLES) -> sp.Matrix:
    """C of model.md, written out: ship C3 C2 C1, aircraft C2 C3 C1, Euler C3 C1 C3."""
    psi, theta, phi = angles
    if sequence == "ship":
        return about(3, psi) * about(2, theta) * about(1, phi)
    if sequence == "aircraft":
        return about(2, psi) * about(3, theta) * about(1, phi)
    return about(3, psi) * about(1, theta) * about(3, phi)


def named(expression: sp.Matrix) -> sp.Matrix:
    """cos psi by c_psi, and so on."""
    names: dict[sp.Expr, sp.Expr] = {}
    for angle in ANGLES:
        names |= {sp.cos(angle): sp.Symbol(f"c_{angle}"), sp.sin(angle): sp.Symbol(f"s_{angle}")}
    return expression.subs(names)


def along_the_motion(expression: sp.Matrix) -> sp.Matrix:
    """d/dt of a matrix of the angles, with the rates by their names."""
    moving = {angle: sp.Function(angle.name)(TIME) for angle in ANGLES}
    rates = {moving[a].diff(TIME): rate for a, rate in zip(ANGLES, derived.rates, strict=True)}
    back = {value: key for key, value in moving.items()}
    return named(expression.subs(moving).diff(TIME).subs(rates).subs(back))


def unnamed(expression: sp.Matrix) -> sp.Matrix:
    """c_psi by cos psi, and so on."""
    names: dict[sp.Expr, sp.Expr] = {}
    for angle in ANGLES:
        names |= {sp.Symbol(f"c_{angle}"): sp.cos(angle), sp.Symbol(f"s_{angle}"): sp.sin(angle)}
    return expression.subs(names)


@pytest.mark.parametrize("sequence", SEQUENCES)
def test_C_is_the_product_of_three_rotations(sequence: str) -> None:
    """C = C_i(psi) C_j(theta) C_k(phi), active."""
    assert remainders(derived.attitude(sequence).C - named(product(sequence)), CIRCLES) == []


@pytest.mark.parametrize("sequence", SEQUENCES)
def test_B_gives_omega(sequence: str) -> None:
    """<B (psi', theta', phi')> = C^T C' in E1."""
    C = product(sequence)
    omega = derived.attitude(sequence).B * sp.Matrix(derived.rates)
    assert remainders(cross(omega) - named(C).T * along_the_motion(C), CIRCLES) == []


@pytest.mark.parametrize("sequence", SEQUENCES)
def test_D_is_the_rate_of_A(sequence: str) -> None:
    """D = A' of (10) along the motion, with omega = B (psi', theta', phi')."""
    formulas = derived.attitude(sequence)
    A, D = derived.kinematics(sequence)
    omega = formulas.B * sp.Matrix(derived.rates)
    known = {sp.Symbol(f"omega[{i}]"): omega[i] for i in range(3)}
    known |= {sp.Symbol(f"C[{i}]"): x for i, x in enumerate(named(product(sequence)))}
    rate = along_the_motion(unnamed(A.xreplace(known)))
    assert remainders(D.xreplace(known) - rate, CIRCLES) == []


@pytest.mark.parametrize("sequence", SEQUENCES)
def test_A_maps_rates_to_the_twist(sequence: str) -> None:
    """V = A q': v = C^T O1', omega = B (psi', theta', phi')."""
    A, _ = derived.kinematics(sequence)
    position = vector("O1_dot")
    V = matrix("C").T * position
    V = V.col_join(derived.attitude(sequence).B * sp.Matrix(derived.rates))
    assert remainders(A * position.col_join(sp.Matrix(derived.rates)) - V) == []


@pytest.mark.parametrize("sequence", SEQUENCES)
def test_B_inverse(sequence: str) -> None:
    """B B^-1 = B^-1 B = E where the singular function is not 0, and det B = +-1 times that function."""
    formulas = derived.attitude(sequence)
    relations = (*CIRCLES, sp.Symbol("singular_inv") * formulas.singular - 1)
    assert remainders(formulas.B * formulas.B_inverse - sp.eye(3), relations) == []
    assert remainders(formulas.B_inverse * formulas.B - sp.eye(3), relations) == []
    assert remainders([formulas.B.det() ** 2 - formulas.singular**2], CIRCLES) == []


@pytest.mark.parametrize("sequence", SEQUENCES)
def test_quaternion_of_angles(sequence: str) -> None:
    """The rotation of the quaternion of half angles is C of the whole angles; its length is 1."""
    q = derived.quaternion_of(sequence)
    assert remainders([q.dot(q) - 1], CIRCLES) == []
    C = derived.rotation_of_quaternion().subs({sp.Symbol(f"q[{i}]"): q[i] for i in range(4)} | {sp.Symbol("k"): 2})
    whole = derived.attitude(sequence).C
    doubled: dict[sp.Expr, sp.Expr] = {}
    for name in derived.ANGLES:
        c, s = sp.Symbol(f"c_{name}"), sp.Symbol(f"s_{name}")
        doubled |= {c: c * c - s * s, s: 2 * s * c}
    assert remainders(C - whole.xreplace(doubled), CIRCLES) == []


def test_rotation_of_a_quaternion_of_any_length() -> None:
    """It is a rotation for k = 2 / (q . q), the same for every length, and C a = q a q~ / (q . q)."""
    q, k, a = vector("q", 4), sp.Symbol("k"), vector("a")
    C = derived.rotation_of_quaternion()
    relations = (k * q.dot(q) - 2,)
    assert remainders(rotation(C), relations) == []
    length = sp.Symbol("length")
    longer = C.xreplace({q[i]: length * q[i] for i in range(4)} | {k: sp.Symbol("k_longer")})
    both = (*relations, sp.Symbol("k_longer") * length**2 - k)
    assert remainders(longer - C, both) == []
    conjugate = sp.Matrix([q[0], -q[1], -q[2], -q[3]])
    turned = derived.quaternion_product(derived.quaternion_product(q, sp.Matrix([0, *a])), conjugate)
    assert remainders([turned[0]]) == []
    assert remainders(2 * C * a - k * turned[1:, :], relations) == []


def test_quaternion_product_is_the_product_of_rotations() -> None:
    """C(a b) = C(a) C(b) for unit quaternions, and the product keeps lengths."""
    a, b, k = vector("a", 4), vector("b", 4), sp.Symbol("k")
    ab = derived.quaternion_product(a, b)
    units = (a.dot(a) - 1, b.dot(b) - 1)

    def turn(q: sp.Matrix) -> sp.Matrix:
        return derived.rotation_of_quaternion().subs({sp.Symbol(f"q[{i}]"): q[i] for i in range(4)} | {k: 2})

    assert remainders(turn(ab) - turn(a) * turn(b), units) == []
    assert remainders([ab.dot(ab) - a.dot(a) * b.dot(b)]) == []
