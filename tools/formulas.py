"""Write the formulas that SymPy derives into the data file of the package, from which `generate` reads them.

python tools/formulas.py

SymPy sorts sums and products by rules that may change with its version; here terms are ordered by the names in
them, positive ones first, so that the same derivation always gives the same operations, hence the same bits.
"""

from __future__ import annotations

import argparse
import json
import re
from collections.abc import Sequence
from dataclasses import fields, is_dataclass
from functools import lru_cache, reduce
from importlib import import_module
from inspect import signature
from itertools import product
from typing import Any

import sympy as sp

from mahovik.core.derive import SEQUENCES
from mahovik.core.formula.derived import FILE, MODULES, Formula, Matrix, key
from mahovik.writing import write

VARIANTS = {"displaces": (False, True), "sequence": tuple(SEQUENCES)}
"""Parameters of the functions of derive/ that give formulas, and all that they can be."""


def derive_all() -> str:
    """The data file: every formula of derive/, a line each, by the call that derives it."""
    lines = []
    for module in (f"core.derive.{name}" for name in MODULES):
        for name, function in vars(import_module(f"mahovik.{module}")).items():
            if name.startswith("_") or getattr(function, "__module__", "") != f"mahovik.{module}":
                continue
            if (parameters := signature(function).parameters).keys() <= VARIANTS.keys():
                for arguments in product(*(VARIANTS[parameter] for parameter in parameters)):
                    value = json.dumps(to_formulas(function(*arguments)), default=vars, separators=(",", ":"))
                    lines.append(f'"{key(module, name, *arguments)}":{value}')
    return "{\n" + ",\n".join(lines) + "\n}\n"


def to_formulas(value: Any) -> Any:
    """Result of a function of derive/ as formulas: each element of matrices, tuples, dicts and data classes."""
    if isinstance(value, sp.MatrixBase):
        rows, columns = value.shape
        return Matrix(rows, columns, [_formula(x) for x in value])
    if isinstance(value, tuple):
        return [to_formulas(element) for element in value]
    if isinstance(value, dict):
        return {name: to_formulas(element) for name, element in value.items()}
    if is_dataclass(value):
        return {"record": {f.name: to_formulas(getattr(value, f.name)) for f in fields(value)}}
    return _formula(sp.sympify(value))


@lru_cache(maxsize=4096)
def _formula(e: sp.Expr) -> Formula:
    """One expression. Raises TypeError for what has no form in a program."""
    if e.is_Symbol:
        return str(e.name)
    if e.is_Number:
        return float(e)
    if e.is_Add:
        return _sum(e)
    if e.is_Mul:
        return _product(e)
    if e.is_Pow and e.exp.is_Integer and e.exp > 1:
        return _chain([_formula(e.base)] * int(e.exp))
    raise TypeError(f"{e} has no form in a program")


def _sum(e: sp.Add) -> Formula:
    terms = sorted(e.args, key=lambda t: (_negative(t), _key(t)))
    total = _formula(terms[0])
    for term in terms[1:]:
        total = ["-", total, _formula(-term)] if _negative(term) else ["+", total, _formula(term)]
    return total


def _chain(factors: Sequence[Formula]) -> Formula:
    return reduce(lambda product, factor: ["*", product, factor], factors)


def _product(e: sp.Mul) -> Formula:
    coefficient, rest = e.as_coeff_Mul()
    factors = [_formula(a) for a in sorted(sp.Mul.make_args(rest), key=_key)]
    if coefficient == -1:
        factors[0] = ["-", factors[0]]
    elif coefficient != 1:
        factors.insert(0, float(coefficient))
    return _chain(factors)


def _negative(term: sp.Expr) -> bool:
    return bool(term.as_coeff_Mul()[0] < 0)


_LAST = frozenset(("c", "s", "c2", "s2", "dc", "ds", "dc2", "ds2", "ddc", "dds", "two_c2", "two_s2"))
"""Weights of a row's columns: a column is named before its weight."""


@lru_cache(maxsize=4096)
def _key(e: sp.Expr) -> tuple[object, ...]:
    """Names in natural order ([2] before [10]), then the text: the same in every run and version."""
    text = str(e)
    if text in _LAST:
        return (["~"], text)
    text = re.sub(r"\d+", lambda m: m[0].zfill(4), text.replace("-", ""))
    return (sorted(re.findall(r"[a-zA-Z_]\w*(?:\[\d+\])?", text)), text)


if __name__ == "__main__":
    argparse.ArgumentParser(description=__doc__, usage="python tools/formulas.py").parse_args()
    write(FILE, derive_all())
