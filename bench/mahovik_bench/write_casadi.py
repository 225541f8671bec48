"""Writes CasADi's C of the literal equations: python -m mahovik_bench.write_casadi FOLDER N FORM.

FORM naive: (8) with `solve(K, b)`, no common subexpressions taken out. FORM ldl: `cse`, and CasADi's symbolic LDL^T;
coupled by the sparse LDL^T of the (N + 6) unknowns, flywheels first. FORM torque: that of it alone. FORM
jacobian: slopes of the latter forward. FORM table: harmonics of the phases found by hand, in place of the equations.
"""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path
from typing import Any

import casadi as ca

from mahovik_bench.cases import case
from mahovik_bench.harmonic import Harmonic, solved
from mahovik_bench.literal import Literal, inputs


def functions(N: int, form: str) -> list[Any]:
    """Text of one file."""
    symbols = inputs(N)
    if form == "table":
        told = Harmonic(case(N).stand, symbols)
        works = {"forward": told.forward(), "coupled": told.coupled(), "torque": told.torque()}
        return [ca.Function(name, symbols, [expression], {"cse": True}) for name, expression in works.items()]
    at = Literal(case(N).stand, symbols)
    if form == "naive":
        return [ca.Function("forward", symbols, [ca.solve(at.K, at.right())])]
    torque = at.of_flywheels(at.V_dot, at.phi_ddot)
    if form == "torque":
        return [ca.Function("torque", symbols, [torque], {"cse": True})]
    forward = solved(at.K, at.right())
    if form == "jacobian":
        slopes = ca.jacobian(forward, ca.vertcat(*symbols[:4]))
        return [ca.Function("forward_jacobian", symbols, [ca.densify(slopes)], {"cse": True})]
    answers = solved(*at.full())
    works = {
        "forward": forward,
        "coupled": ca.vertcat(answers[N:], answers[:N]),
        "torque": torque,
    }
    return [ca.Function(name, symbols, [expression], {"cse": True}) for name, expression in works.items()]


def main() -> None:
    """Writes casadi.c and what the adapter must know."""
    folder, N, form = Path(sys.argv[1]), int(sys.argv[2]), sys.argv[3]
    written = functions(N, form)
    generator = ca.CodeGenerator("casadi.c", {"with_header": False})
    for function in written:
        generator.add(function)
    os.chdir(folder)
    generator.generate()
    facts = {"work": max(entry.sz_w() for entry in written), "arguments": max(entry.sz_arg() for entry in written)}
    (folder / "facts.json").write_text(json.dumps(facts), encoding="utf-8")


if __name__ == "__main__":
    main()
