"""Vectors and matrices of expressions: each element is one sum, whose order of operations the text decides.

A sum of vectors, a product of matrices and what `cross` and `dot` give are single sums of products: terms that are
added first, in the order of the text, then those that are subtracted. So `v + cross(omega, O)` has elements like
`v[0] + omega[1]*O[2] - omega[2]*O[1]`. Terms with a factor 0 of Python are left out, and so are its factors 1.

Arrays of a program take part as they are: `C @ a` is a product with a square matrix if C has nine or 36 numbers, row
by row, and with a symmetric one if it has six (11 22 33 12 13 23), whose sums begin with the diagonal.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from math import isqrt
from typing import Any, TypeAlias

from mahovik.core.program.expression import Binary, Expr, Negate, Place, numbers_of, paired
from mahovik.core.program.types import Kind, ProgramError

Scalar: TypeAlias = "Expr | int | float"
Term: TypeAlias = tuple[bool, Scalar]
"""Whether it is subtracted, and what."""

DIAGONAL = ((0, 3, 4), (3, 1, 5), (4, 5, 2))
"""Where the elements of a symmetric matrix are among its six numbers."""


class Vector(Sequence[Any]):
    """Expressions with the operators of a vector; 0 and 1 of Python stay what they are."""

    def __init__(self, elements: Iterable[Scalar]) -> None:
        self.elements = tuple(elements)

    def __repr__(self) -> str:
        return f"a vector of {len(self)}, which is no array,"

    def __len__(self) -> int:
        return len(self.elements)

    def __bool__(self) -> bool:
        raise ProgramError("a condition is a comparison, not a vector")

    def __iter__(self) -> Iterator[Any]:
        return iter(self.elements)

    def __getitem__(self, index: Any) -> Any:
        if isinstance(index, slice):
            return Vector(self.elements[i] for i in numbers_of(index, len(self)))
        if not -len(self) <= index < len(self):
            raise ProgramError(f"{len(self)} numbers have no number [{index}]")
        return self.elements[index]

    def __setitem__(self, index: Any, value: Any) -> None:
        raise ProgramError("a vector is no array: none of its numbers changes")

    @property
    def square(self) -> Matrix:
        """The square matrix of the numbers, row by row."""
        n = isqrt(len(self))
        if n * n != len(self):
            raise ProgramError(f"{len(self)} numbers are no square matrix")
        return Matrix(self[n * i : n * i + n] for i in range(n))

    @property
    def T(self) -> Matrix:
        """The square matrix, transposed."""
        return self.square.T

    def __add__(self, other: Any) -> Vector:
        return _sum_of_vectors(self, other, False)

    def __radd__(self, other: Any) -> Vector:
        return _sum_of_vectors(other, self, False)

    def __sub__(self, other: Any) -> Vector:
        return _sum_of_vectors(self, other, True)

    def __rsub__(self, other: Any) -> Vector:
        return _sum_of_vectors(other, self, True)

    def __neg__(self) -> Vector:
        return Vector(_sum(_terms(a, True)) for a in self)

    def __mul__(self, factor: Scalar) -> Vector:
        return Vector(_product(a, factor) for a in self)

    def __rmul__(self, factor: Scalar) -> Vector:
        return Vector(_product(factor, a) for a in self)

    def __truediv__(self, divisor: Scalar) -> Vector:
        return Vector(a / divisor for a in self)

    def __matmul__(self, other: Any) -> Any:
        return dot(self, other) if not _is_matrix(self, other) else _matrix(self, other) @ other

    def __rmatmul__(self, other: Any) -> Any:
        return _matrix(other, self) @ self if _is_matrix(other, self) else dot(other, self)


class Matrix:
    """Rows of expressions. `symmetric`: sums of its products begin with the diagonal."""

    def __init__(self, rows: Iterable[Iterable[Scalar]], symmetric: bool = False) -> None:
        self.rows = tuple(Vector(row) for row in rows)
        self.symmetric = symmetric

    def __len__(self) -> int:
        return len(self.rows)

    def __iter__(self) -> Iterator[Vector]:
        return iter(self.rows)

    def __getitem__(self, index: Any) -> Any:
        if isinstance(index, slice):
            return [self.rows[i] for i in numbers_of(index, len(self))]
        return self.rows[index]

    @property
    def T(self) -> Matrix:
        """The transposed matrix."""
        return Matrix(zip(*self.rows, strict=True), self.symmetric)

    @property
    def flat(self) -> Vector:
        """All elements, row by row."""
        return Vector(a for row in self.rows for a in row)

    @property
    def six(self) -> Vector:
        """11 22 33 12 13 23 of a symmetric 3x3 matrix."""
        places = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
        return Vector(self.rows[i][j] for i, j in places)

    def __add__(self, other: Any) -> Matrix:
        return Matrix(map(Vector.__add__, self.rows, _rows(other, self)))

    def __sub__(self, other: Any) -> Matrix:
        return Matrix(map(Vector.__sub__, self.rows, _rows(other, self)))

    def __rsub__(self, other: Any) -> Matrix:
        return Matrix(map(Vector.__sub__, _rows(other, self), self.rows))

    def __neg__(self) -> Matrix:
        return Matrix([-row for row in self.rows])

    def __mul__(self, factor: Scalar) -> Matrix:
        return Matrix([row * factor for row in self.rows], self.symmetric)

    def __rmul__(self, factor: Scalar) -> Matrix:
        return Matrix([row.__rmul__(factor) for row in self.rows], self.symmetric)

    def __matmul__(self, other: Any) -> Any:
        if _is_matrix(other, self) or (isinstance(other, Place) and len(other.shape) == 2):
            columns = _matrix(other, self).T
            return Matrix(self._times(column) for column in columns).T
        return self._times(other)

    def __rmatmul__(self, other: Any) -> Any:
        return _matrix(other, self) @ self

    def _times(self, column: Iterable[Scalar]) -> Vector:
        """The product with a vector."""
        factors = tuple(column)
        if not self.symmetric:
            return Vector(dot(row, factors) for row in self.rows)
        orders = [[i, *(j for j in range(len(factors)) if j != i)] for i in range(len(factors))]
        return Vector(
            dot([row[j] for j in order], [factors[j] for j in order])
            for row, order in zip(self.rows, orders, strict=True)
        )


def cross(a: Any, b: Any) -> Vector:
    """a x b."""
    pairs = ((1, 2), (2, 0), (0, 1))
    products = ((_product(a[i], b[j]), _product(a[j], b[i])) for i, j in pairs)
    return Vector(_sum([*_terms(one, False), *_terms(other, True)]) for one, other in products)


def skew(a: Any) -> Matrix:
    """<a>: <a> b = a x b."""
    return Matrix([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])


def dot(a: Iterable[Any], b: Iterable[Any]) -> Any:
    """a . b, from the first element to the last."""
    return _sum([term for x, y in paired(a, b) for term in _terms(_product(x, y), False)])


def symmetric(six: Any) -> Matrix:
    """The symmetric matrix of 11 22 33 12 13 23."""
    return Matrix(([six[k] for k in row] for row in DIAGONAL), symmetric=True)


def vector_of(value: Any) -> Vector | Matrix:
    """An array of a program, or a sequence, as a vector; of two indices as a matrix."""
    if isinstance(value, Vector | Matrix):
        return value
    if isinstance(value, Place) and len(value.shape) == 2:
        return Matrix(value)
    return Vector(value)


Place.vector_of = staticmethod(vector_of)


def _is_matrix(value: Any, beside: Any) -> bool:
    """Is the value in a product a matrix?"""
    if isinstance(value, Matrix) or (isinstance(value, Place) and len(value.shape) == 2):
        return True
    return len(value) in (6, 9, 36) and len(value) != len(beside)


def _matrix(value: Any, beside: Any) -> Matrix:
    """A factor of a product as a matrix."""
    if isinstance(value, Matrix):
        return value
    if isinstance(value, Place) and len(value.shape) == 2:
        return Matrix(value)
    return symmetric(value) if len(value) == 6 and len(beside) == 3 else Vector(value).square


def _rows(value: Any, beside: Matrix) -> tuple[Vector, ...]:
    """The rows of a summand."""
    return _matrix(value, beside).rows


def _sum_of_vectors(left: Any, right: Any, subtract: bool) -> Vector:
    return Vector(_sum([*_terms(a, False), *_terms(b, subtract)]) for a, b in paired(left, right))


def _terms(value: Scalar, subtract: bool) -> Iterator[Term]:
    """The terms of a sum."""
    match value:
        case 0:
            return
        case Binary(operator="+" | "-" as operator, left=left, right=right) if value.kind is Kind.REAL:
            yield from _terms(left, subtract)
            yield from _terms(right, subtract is (operator == "+"))
        case Negate(operand=operand):
            yield from _terms(operand, not subtract)
        case _:
            positive = _without_sign(value)
            yield (subtract, value) if positive is None else (not subtract, positive)


def _sum(terms: Iterable[Term]) -> Any:
    """The terms that are added, less those that are subtracted; 0 of none."""
    whole = list(terms)
    added = [value for subtract, value in whole if not subtract]
    subtracted = [value for subtract, value in whole if subtract]
    if not whole:
        return 0
    total = added[0] if added else _negative(subtracted.pop(0))
    for value in added[1:]:
        total = total + value
    for value in subtracted:
        total = total - value
    return total


def _product(a: Scalar, b: Scalar) -> Scalar:
    """a b; 0 and 1 of Python are no factors."""
    for one, other in ((a, b), (b, a)):
        if isinstance(one, int) and one in (0, 1, -1):
            return 0 if one == 0 else other if one == 1 else _negative(other)
    return a * b


def _negative(value: Scalar) -> Scalar:
    """-a; of a product by its first factor."""
    if isinstance(value, Binary) and value.operator == "*":
        return Binary("*", _expression(_negative(value.left)), value.right)
    return -value


def _without_sign(value: Scalar) -> Scalar | None:
    """a of -a, where the first factor of a product is negated."""
    if isinstance(value, Negate):
        return value.operand
    if isinstance(value, Binary) and value.operator == "*":
        first = _without_sign(value.left)
        return None if first is None else Binary("*", _expression(first), value.right)
    return None


def _expression(value: Scalar) -> Expr:
    assert isinstance(value, Expr)
    return value
