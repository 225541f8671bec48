"""Random expression trees of every kind, and a program of one function a tree.

Kept away from what C leaves undefined: ints stay small, divisors of ints are not zero, shifts are below the width.
"""

from __future__ import annotations

import math
import random
from typing import Any

from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Convert as Converted
from mahovik.core.program.expression import (
    Expr,
    Not,
    and_,
    binary,
    bits_of,
    compare,
    integer,
    or_,
    real,
    real_of_bits,
    select,
    word,
)
from mahovik.core.program.function import Function, Program
from mahovik.core.program.types import Kind, Precision

REALS, WORDS, INTS = 5, 3, 3


class Trees:
    """Draws trees over the arguments x (reals), w (words) and n (ints)."""

    def __init__(self, rng: random.Random, precision: Precision) -> None:
        self.rng, self.precision = rng, precision
        self.x = Argument("x", Kind.REAL, (REALS,))
        self.w = Argument("w", Kind.WORD, (WORDS,))
        self.n = Argument("n", Kind.INT, (INTS,))

    def real(self, depth: int) -> Expr:
        """A tree whose value is a real."""
        pick = self.rng.random()
        if depth == 0 or pick < 0.1:
            return self._number() if self.rng.random() < 0.3 else self.rng.choice(list(self.x.place))
        less = depth - 1
        if pick < 0.7:
            return binary(self.rng.choice("+-*/+-"), self.real(less), self.real(less))
        if pick < 0.8:
            return -self.real(less)
        if pick < 0.88:
            return select(self.truth(less), self.real(less), self.real(less))
        if pick < 0.94:
            return real_of_bits(self.word(less))
        return Converted(self.word(less) if self.rng.random() < 0.5 else self.small_int(min(less, 2)), Kind.REAL)

    def word(self, depth: int) -> Expr:
        """A tree whose value is a word, modulo 2^width."""
        rng, less, pick = self.rng, depth - 1, self.rng.random()
        width = self.precision.width
        if depth == 0 or pick < 0.1:
            if rng.random() < 0.4:
                return word(rng.choice([0, 1, 2, 1023, 1024, rng.getrandbits(31), rng.getrandbits(width)]))
            return rng.choice(list(self.w.place))
        if pick < 0.65:
            return binary(rng.choice("+-*&|^"), self.word(less), self.word(less))
        if pick < 0.8:
            count = word(rng.randrange(width)) if rng.random() < 0.5 else self.word(less) & (width - 1)
            return binary(rng.choice(["<<", ">>"]), self.word(less), count)
        if pick < 0.87:
            return select(self.truth(less), self.word(less), self.word(less))
        if pick < 0.92:
            return -self.word(less)
        if pick < 0.96:
            return Converted(self.small_int(min(less, 2)), Kind.WORD)
        value = rng.choice(list(self.x.place))  # the bits of a NaN are no promise, those of an argument are
        return bits_of(-value if rng.random() < 0.5 else value)

    def small_int(self, depth: int) -> Expr:
        """A tree whose value is a small int."""
        rng, less = self.rng, depth - 1
        if depth == 0:
            return integer(rng.randint(-9, 9)) if rng.random() < 0.3 else rng.choice(list(self.n.place))
        pick = rng.random()
        if pick < 0.6:
            return binary(rng.choice("+-*"), self.small_int(less), self.small_int(less))
        if pick < 0.75:
            return binary("/", self.small_int(less), integer(rng.choice([-3, -2, 2, 3, 7])))
        if pick < 0.85:
            return Converted(self.word(less) & 0xFF, Kind.INT)
        return -self.small_int(less)

    def truth(self, depth: int) -> Expr:
        """A condition."""
        rng, less, pick = self.rng, max(depth - 1, 0), self.rng.random()
        if depth > 0 and pick < 0.3:
            return rng.choice([and_, or_])(self.truth(less), self.truth(less))
        if depth > 0 and pick < 0.4:
            return Not(self.truth(less))
        operator = rng.choice(["<", "<=", ">", ">="])
        if pick < 0.7:
            return compare(operator, self.real(less), self.real(less))
        operator = rng.choice([operator, "==", "!="])
        if pick < 0.85:
            return compare(operator, self.word(less), self.word(less))
        return compare(operator, self.small_int(min(less, 2)), self.small_int(min(less, 2)))

    def program(self, count: int, depth: int) -> Program:
        """`count` functions f0, f1, ... of (x, w, n), each the value of one tree."""
        functions = []
        for k in range(count):
            body = Body()
            kind = k % 3
            if kind == 0:
                body.ret(self.real(depth))
            elif kind == 1:
                body.ret(real_of_bits(self.word(depth)))
            else:
                body.ret(select(self.truth(depth), real(1), real(0)))
            arguments = (self.x, self.w, self.n)
            functions.append(Function(f"f{k}", "A tree.", arguments, body.statements, returns=Kind.REAL, public=True))
        return Program("t", self.precision, (), (), tuple(functions))

    def inputs(self) -> tuple[list[Any], list[int], list[int]]:
        """Arguments: numbers of every size, zeros with sign, infinities and subnormals."""
        rng, p = self.rng, self.precision
        tiny = 2.0 ** (2 - p.bias - p.significand)
        special = [0.0, -0.0, 1.0, -1.5, math.inf, -math.inf, p.largest, tiny, -3 * tiny, p.epsilon]
        x = [
            rng.choice(special) if rng.random() < 0.3 else rng.gauss(0, 1) * 10 ** rng.randint(-4, 4)
            for _ in range(REALS)
        ]
        x = [p.scalar(value) for value in x]
        return x, [rng.getrandbits(p.width) for _ in range(WORDS)], [rng.randint(-9, 9) for _ in range(INTS)]

    def _number(self) -> Expr:
        rng = self.rng
        return real(rng.choice([0.5, -2, 0.1, -1e-7, 3, 1e6, 0, -1, 1 / 3]))
