"""A broken term is a failed verification: each mutation of the derivation or of its numbers is caught where it acts."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import pytest
import sympy as sp

from mahovik.core.derive import accumulate, attitude, carrier, carrying, flywheel, order, symbols, wrench
from mahovik.core.derive.symbols import matrix, vector
from mahovik.core.lower import forward, values, wrenches
from mahovik.core.lower.thresholds import THRESHOLDS
from mahovik.core.stand.model import MountingAngles, Stand
from mahovik.laws.buoyancy.data import Buoyancy
from mahovik.laws.damping import lower as damping_lowering
from mahovik.laws.leg import derive as leg_formulas
from mahovik.laws.leg.data import Legs, legs_of
from mahovik.laws.suspension import derive as suspension_formulas
from mahovik.laws.suspension.data import Suspension
from toolchain.quick import quick
from verify.build import everything, failing, generated

Patch = Callable[[pytest.MonkeyPatch], None]


def derivation(module: Any, name: str, changed: Callable[..., Any]) -> Patch:
    """A function of a module replaced by `changed(original)(...)`."""

    def patch(monkeypatch: pytest.MonkeyPatch) -> None:
        original = getattr(module, name)
        monkeypatch.setattr(module, name, changed(original))

    return patch


def taken_as_a_body(patch: Patch) -> Patch:
    """With a prepare that takes what no body has: the comparison must find the fault by itself."""

    def patch_both(monkeypatch: pytest.MonkeyPatch) -> None:
        patch(monkeypatch)
        monkeypatch.setitem(THRESHOLDS, "double", replace(THRESHOLDS["double"], unphysical=1e6))

    return patch_both


def zeroed(original: Callable[..., sp.Matrix]) -> Callable[..., sp.Matrix]:
    return lambda *arguments: original(*arguments) * 0


def substituted(**old_to_new: Any) -> Callable[..., Any]:
    """Fields of a result with symbols replaced: `field=(old, new)`."""

    def change(original: Callable[..., Any]) -> Callable[..., Any]:
        def found(*arguments: Any) -> Any:
            result = original(*arguments)
            if isinstance(result, dict):
                return result | {name: result[name].subs(*pair) for name, pair in old_to_new.items()}
            return replace(result, **{name: getattr(result, name).subs(pair) for name, pair in old_to_new.items()})

        return found

    return change


t_s = vector("t_s")
NEGATED_T_S = {symbol: -symbol for symbol in t_s}


def without_remainder(term: Callable[[], sp.Matrix]) -> Callable[..., Any]:
    return lambda original: lambda: original() + term()


def lost_difference(original: Callable[..., Any]) -> Callable[..., Any]:
    """J22 and J33 both their mean."""
    J = vector("J", 6)

    def found(generic: Any) -> Any:
        mean = {J[1]: (J[1] + J[2]) / 2, J[2]: (J[1] + J[2]) / 2}
        return {k: replace(part, J=part.J.subs(mean, simultaneous=True)) for k, part in original(generic).items()}

    return found


def hub_weight(original: Callable[..., None]) -> Callable[..., None]:
    """The weight along the constant part of the first moment."""

    def found(lib: Any, body: Any, stand: Any, x: Any, turns: Any, sums: Any, g: Any, F: Any) -> None:
        original(lib, body, stand, x, turns, SimpleNamespace(mu=stand.first_moment), g, F)

    return found


def no_fluid(original: Callable[..., sp.Matrix]) -> Callable[..., sp.Matrix]:
    """Z without the added mass: it is left out of Phi K V."""
    return lambda added: original(False)


def reversed_signs(original: Callable[..., Any]) -> Callable[..., Any]:
    def found(self: Any, body: Any) -> Any:
        made = original(self, body)
        return made | {"inertia": [*made["inertia"][:3], *(-x for x in made["inertia"][3:])]}

    return found


def no_lower_left(original: Callable[..., sp.Matrix]) -> Callable[..., sp.Matrix]:
    """Phi(V) without <v>."""

    def found(V: sp.Matrix) -> sp.Matrix:
        made = original(V)
        made[3:, :3] = sp.zeros(3)
        return made

    return found


def no_flywheel_rate(original: Callable[..., None]) -> Callable[..., None]:
    """A flywheel's damping sees the twist of its mount: no f phi'."""

    def found(lib: Any, body: Any, stand: Any, frame: Any, x: Any, *rest: Any) -> None:
        members = {"layout": SimpleNamespace(own_turning=False), "arguments_of": lib.arguments_of}
        of_lib = {"__getitem__": lambda _, name: lib[name], "__contains__": lambda _, name: name in lib}
        blind = type("Blind", (), members | of_lib)()
        original(blind, body, stand, frame, x, *rest)

    return found


def still_theta(original: Callable[..., Any]) -> Callable[..., Any]:
    def found(sequence: str) -> Any:
        A, D = original(sequence)
        return A, D.subs(sp.Symbol("theta_dot"), 0)

    return found


DERIVATION: dict[str, tuple[Patch, set[str]]] = {
    "K* dropped from the right-hand side": (
        derivation(carrier, "remainder", without_remainder(lambda: carrier.mass_matrix_rate() * carrier.V)),
        {"V_dot"},
    ),
    "K* dropped altogether": (derivation(carrier, "mass_matrix_rate", zeroed), {"K_dot", "M", "V_dot"}),
    "phi' not squared": (
        derivation(accumulate, "weights", substituted(ddc=(accumulate.ds, accumulate.c))),
        {"V_dot", "q_ddot"},
    ),
    "harmonic 2 turns at phi'": (
        derivation(accumulate, "weights", substituted(dc2=(accumulate.phi_dot, accumulate.phi_dot / 2))),
        {"K_dot", "V_dot"},
    ),
    "cosine of the double phase": (
        derivation(accumulate, "weights", lambda original: lambda: original() | {"c2": 1 - accumulate.s**2}),
        {"K"},
    ),
    "mounting by C2 C3 C1": (
        derivation(carrying, "elementary", lambda original: lambda axis, angle: original((0, 1, 3, 2)[axis], angle)),
        {"K", "I"},
    ),
    "weight of a flywheel at its hub": (derivation(wrenches, "_weight", hub_weight), {"F", "V_dot"}),
    "added mass left out of Phi K": (derivation(carrier, "momentum", no_fluid), {"V_dot", "Z"}),
    "J22 - J33 lost": (derivation(flywheel, "spun_inertia", lost_difference), {"K", "K_dot"}),
    "products of inertia with the other sign": (
        taken_as_a_body(derivation(values._Parameters, "_body", reversed_signs)),
        {"K", "I"},
    ),
    "inertia about the mass centre taken for that about the origin": (
        taken_as_a_body(derivation(flywheel, "central_to_origin", lambda original: lambda m, b, J: symbols.six_of(J))),
        {"K"},
    ),
    "moment of inertia taken about Os": (
        derivation(
            flywheel,
            "shifted_inertia",
            lambda original: lambda m, b, J, O: (original(m, b, J, O)[0], symbols.six_of(J)),
        ),
        {"K"},
    ),
    "t_s with the other sign": (
        derivation(accumulate, "sums", substituted(h_rel=NEGATED_T_S, g_rel=NEGATED_T_S)),
        {"Z", "V_dot"},
    ),
    "t_s with the other sign in I": (
        derivation(accumulate, "columns", substituted(I=NEGATED_T_S)),
        {"I", "J", "energy"},
    ),
    "I_s' left out of J_s": (
        derivation(accumulate, "columns", lambda original: lambda: replace(original(), I_prime=sp.zeros(6, 1))),
        {"J"},
    ),
    "first moment's rate left out of the momentum": (
        derivation(
            carrier,
            "momentum",
            lambda original: lambda added: original(added) - carrier.mu_dot.col_join(sp.zeros(3, 1)),
        ),
        {"Z", "V_dot"},
    ),
    "quadratic damping without |V|": (
        derivation(damping_lowering, "magnitude", lambda original: lambda x: x),
        {"F", "V_dot"},
    ),
    "flywheel damping without f phi'": (derivation(wrenches, "_own_damping", no_flywheel_rate), {"F"}),
    "a flywheel's own wrench does not turn": (
        derivation(wrench, "turned_axes", lambda original: lambda: matrix("R")),
        {"F"},
    ),
    "arm of a body's wrench dropped": (derivation(wrench, "moment_of_force", zeroed), {"F"}),
    "suspension turned the other way": (
        derivation(suspension_formulas, "relative_quaternion", lambda found: lambda: sp.diag(1, -1, -1, -1) * found()),
        {"F", "V_dot"},
    ),
    "leg damping with the other sign": (
        derivation(leg_formulas, "leg", lambda original: lambda: replace(original(), rate=-original().rate)),
        {"F"},
    ),
    "stream ignored in V*": (
        derivation(forward, "derived", lambda original: SimpleNamespace(turning_velocity=lambda: sp.zeros(3, 1))),
        {"V_dot", "q_ddot"},
    ),
    "v x p dropped": (derivation(carrier, "Phi", no_lower_left), {"V_dot", "M"}),
    "D without theta'": (derivation(attitude, "kinematics", still_theta), {"D", "J0", "q_ddot"}),
    "Z0 not shifted to the origin of E0": (
        derivation(carrier, "momentum_in_E0", lambda original: lambda: original().subs(dict.fromkeys(vector("r"), 0))),
        {"Z0"},
    ),
    "energy of spin not halved": (
        derivation(carrier, "kinetic_energy", lambda original: lambda: original() + sp.Symbol("spin") / 2),
        {"energy"},
    ),
    "moment of the reduced system with the other sign": (
        derivation(carrier, "reduced_moment", lambda original: lambda added: 2 * vector("n") - original(added)),
        {"V_dot"},
    ),
    "angles of another sequence": (
        lambda monkeypatch: monkeypatch.setitem(order.SEQUENCES, "ship", (2, 3, 1)),
        {"A", "q_dot"},
    ),
    "moment of I about Os": (
        derivation(flywheel, "spin_momentum", lambda original: lambda b, J, O: original(b, J, sp.zeros(3, 1))),
        {"I", "Z"},
    ),
}


@pytest.mark.parametrize("name", quick(1, DERIVATION))
def test_a_mutated_derivation_is_caught(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    patch, expected = DERIVATION[name]
    patch(monkeypatch)
    stand = everything()
    found = failing(stand, generated(stand))
    assert expected <= found


@pytest.mark.parametrize("angles", quick(1, ["ship", "aircraft", "euler"]))
def test_what_is_right_passes(angles: Any) -> None:
    stand = everything(angles)
    assert failing(stand, generated(stand), states=40) == set()


def wheel(stand: Stand, **changes: Any) -> Stand:
    """The stand with its first flywheel changed."""
    return replace(stand, flywheels=(replace(stand.flywheels[0], **changes), *stand.flywheels[1:]))


def floats_at_mass_centre(stand: Stand) -> Stand:
    first = stand.flywheels[0]
    buoyancy = first.law(Buoyancy)
    assert buoyancy is not None
    return wheel(stand, laws=first.with_laws(replace(buoyancy, center=first.center_of_mass)).laws)


def mounted_on_the_carrier(stand: Stand) -> Stand:
    wheels = tuple(replace(w, mount="carrier") for w in stand.flywheels)
    assert wheels != stand.flywheels
    return replace(stand, flywheels=wheels)


def counted_from_elsewhere(stand: Stand) -> Stand:
    wheels = [
        replace(w, mounting=replace(w.mounting, zero=0.0)) if isinstance(w.mounting, MountingAngles) else w
        for w in stand.flywheels
    ]
    assert tuple(wheels) != stand.flywheels
    return replace(stand, flywheels=tuple(wheels))


def instruments_without_fluid(stand: Stand) -> Stand:
    return replace(stand, instruments=tuple(replace(p, added_mass=None) for p in stand.instruments))


def stress_free_legs(stand: Stand) -> Stand:
    return stand.with_laws(Legs(tuple(replace(leg, length=0.0) for leg in legs_of(stand))))


def against_the_stream(stand: Stand) -> Stand:
    x, y, z = stand.stream or (0.0, 0.0, 0.0)
    return replace(stand, stream=(-x, -y, -z))


def untilted(stand: Stand) -> Stand:
    law = stand.law(Suspension)
    assert law is not None
    return stand.with_laws(replace(law, angles=(0.0, 0.0, 0.0)))


NUMBERS: dict[str, tuple[Callable[[Stand], Stand], set[str]]] = {
    "an instrument's added mass dropped": (instruments_without_fluid, {"K", "M", "V_dot"}),
    "buoyancy of a flywheel at its mass centre": (floats_at_mass_centre, {"F", "V_dot"}),
    "flywheel on an instrument placed as if on the carrier": (mounted_on_the_carrier, {"K", "I"}),
    "zero of the phase dropped": (counted_from_elsewhere, {"K", "I"}),
    "unstretched length dropped": (stress_free_legs, {"F"}),
    "equilibrium attitude dropped": (untilted, {"F"}),
    "stream reversed": (against_the_stream, {"F", "V_dot", "M"}),
}


@pytest.mark.parametrize("name", quick(1, NUMBERS))
def test_lost_numbers_are_caught(name: str) -> None:
    change, expected = NUMBERS[name]
    stand = everything()
    assert expected <= failing(stand, generated(stand, numbers_of=change(stand)))


def test_a_wrong_inertia_about_the_spin_axis_is_caught() -> None:
    def double(table: dict[str, Any]) -> None:
        table["flywheel"][1]["spin"] *= 2

    stand = everything()
    assert failing(stand, generated(stand, table=double)) == {"energy", "tau"}


def test_a_wrong_root_of_the_inertia_about_the_spin_axis_is_caught() -> None:
    def double(table: dict[str, Any]) -> None:
        table["flywheel"][1]["spin_root_inv"] *= 2

    stand = everything()
    assert "sigma" in failing(stand, generated(stand, table=double))


def test_one_number_of_the_table_off_by_1e_8_is_caught() -> None:
    def nudge(table: dict[str, Any]) -> None:
        table["flywheel"][0]["J_2c"][3] *= 1 + 1e-8  # of a small number: 1e-12 is asked of whole quantities

    stand = everything()
    assert "K_dot" in failing(stand, generated(stand, table=nudge))
