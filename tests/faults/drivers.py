"""Small C programs that the checks run: NULL for every pointer, and the static routines against libm."""

from __future__ import annotations

from mahovik.contract.status import STATUS_VALUES
from mahovik.core.program.function import Function, Program
from mahovik.core.program.types import Struct

NULLS = "nulls.c"


def nulls(program: Program, name: str) -> str:
    """Calls every public function with each of its pointers NULL in turn, and prints what does not refuse."""
    calls = [line for f in program.functions if f.public for line in _calls(f, name)]
    body = "\n".join(f"    {line}" for line in calls)
    return f"""#include "{name}.h"
#include <stddef.h>
#include <stdio.h>
static union {{ double align; unsigned char bytes[1 << 18]; }} room;
static void say(int status, const char *what)
{{
    if (status != {STATUS_VALUES["BAD_ARGUMENT"]}) {{ printf("%s: status %d\\n", what, status); }}
}}
int main(void)
{{
{body}
    return 0;
}}
"""


def _calls(f: Function, name: str) -> list[str]:
    """Calls of one function, a pointer NULL in each."""
    pointers = [i for i, a in enumerate(f.arguments) if a.shape or a.variable.pointer]
    found = []
    for null in [i for i in pointers if not f.arguments[i].optional]:
        given = []
        for i, a in enumerate(f.arguments):
            if i not in pointers:
                given.append("1")
            elif i == null:
                given.append("NULL")
            elif isinstance(a.type, Struct) or a.type.value == "real":
                given.append("(void *)room.bytes")
            else:
                given.append("(void *)room.bytes")
        found.append(f'say((int){name}_{f.name}({", ".join(given)}), "{f.name}, {f.arguments[null].name} NULL");')
    return found


def routines(name: str, real: str) -> str:
    """Includes the source, and prints the first argument at which a routine is not what libm says."""
    suffix = "" if real == "double" else "f"
    span, least = (2090, 1068) if real == "double" else (270, 145)  # of exponents, from subnormal numbers on
    return f"""#include "{name}.c"
#include <math.h>
#include <stdio.h>
static int off(double got, double expected, double tolerance, const char *what, double x)
{{
    if (fabs(got - expected) <= tolerance) {{ return 0; }}
    printf("%s(%.17g) = %.17g, libm %.17g\\n", what, x, got, expected);
    return 1;
}}
int main(void)
{{
    const double ulp = {"2.3e-16" if real == "double" else "1.2e-7"};
    unsigned long long bits = 88172645463325252ull;
    for (int i = 0; i < 200000; ++i) {{
        bits ^= bits << 13;  bits ^= bits >> 7;  bits ^= bits << 17;
        const {real} unit = ({real})((double)(bits >> 11) * 0x1p-53);
        const {real} x = ({real})((i % 2 == 0) ? 50.0 * (unit - 0.5) : 7.0 * (unit - 0.5));
        {real} s, c;
        {name}_sincos(x, &s, &c);
        if (off(s, sin(x), ulp * (fabs(sin(x)) + 1e-16), "sin", x)) {{ return 0; }}
        if (off(c, cos(x), ulp * (fabs(cos(x)) + 1e-16), "cos", x)) {{ return 0; }}
        const {real} y = ({real})ldexp(unit, (int)(bits % {span}u) - {least});
        if (off({name}_sqrt(y), sqrt{suffix}(y), 0.0, "sqrt", y)) {{ return 0; }}
        if (off({name}_atan2(x, y), atan2(x, y), 2.0 * ulp * fabs(atan2(x, y)) + 1e-300, "atan2", x)) {{ return 0; }}
        if (off({name}_atan2(-y, x), atan2(-y, x), 2.0 * ulp * fabs(atan2(-y, x)) + 1e-300, "atan2", x)) {{ return 0; }}
    }}
    return 0;
}}
"""
