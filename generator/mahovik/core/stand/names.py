"""Names of stands, bodies and points: they become C identifiers, in a header that C++ may include."""

from __future__ import annotations

import re

from mahovik.core.stand.units import show

_IDENTIFIER = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")

# C99, then C11 and C23
_C = """
auto break case char const continue default do double else enum extern float for goto if inline int long
register restrict return short signed sizeof static struct switch typedef union unsigned void volatile while
_Bool _Complex _Imaginary
_Alignas _Alignof _Atomic _BitInt _Decimal128 _Decimal32 _Decimal64 _Generic _Noreturn _Static_assert
_Thread_local alignas alignof bool constexpr false nullptr static_assert thread_local true typeof typeof_unqual
"""
_CPP = """
alignas alignof and and_eq asm bitand bitor bool catch char16_t char32_t char8_t class co_await co_return
co_yield compl concept const_cast consteval constexpr constinit decltype delete dynamic_cast explicit export
false friend mutable namespace new noexcept not not_eq nullptr operator or or_eq private protected public
reinterpret_cast requires static_assert static_cast template this thread_local throw true try typeid typename
using virtual wchar_t xor xor_eq
"""
_HEADERS = """
assert complex ctype errno fenv float inttypes iso646 limits locale math setjmp signal stdarg stdbool stddef stdint
stdio stdlib string tgmath time wchar wctype windows
"""
C_HEADERS = frozenset(_HEADERS.split())
"""Standard headers and that of Windows: a stand of such a name would have a header that hides one of them."""

C_KEYWORDS = frozenset(_C.split())
CPP_KEYWORDS = frozenset(_CPP.split())


def name_problem(name: str) -> str | None:
    """Why `name` cannot be a name in generated C, or None."""
    if not _IDENTIFIER.fullmatch(name):
        return f"{show(name)} is not a C identifier (letters, digits, _; no digit first)"
    if name in C_KEYWORDS:
        return f"{show(name)} is a C keyword"
    if name in CPP_KEYWORDS:
        return f"{show(name)} is a C++ keyword"
    return None


def stand_name_problem(name: str) -> str | None:
    """Why `name` cannot be the name of a stand, hence of its files, or None."""
    if name in C_HEADERS:
        return f"{show(name)} is the name of a standard header of C: {name}.h would hide it"
    if name.startswith("_"):
        return f"{show(name)} begins with _: all names of the C would, and C reserves such names; begin with a letter"
    return name_problem(name)
