"""Where long lines break: at the outermost operator or comma that fits."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence

WIDTH = 110
"""Columns of a line."""

_OUTER = (" + ", " - ", " && ", " || ", " ? ", " : ")
_INNER = (" * ", " / ", " & ", " | ", " ^ ", " << ", " >> ", " < ", " <= ", " > ", " >= ", " == ", " != ")


def wrap_statement(text: str, indent: str) -> list[str]:
    """A statement as lines of at most WIDTH columns where it can be broken; later lines are indented further."""
    lines = []
    rest, lead = text, indent
    while len(lead) + len(rest) > WIDTH:
        at = _break(rest, WIDTH - len(lead))
        if at <= 0:
            break
        lines.append(lead + rest[:at].rstrip())
        rest, lead = rest[at:].lstrip(), indent + "    "
    return [*lines, lead + rest]


def _break(text: str, room: int) -> int:
    """Position of the best break: the least nested one of those in the last half of the room."""
    depth, best, best_depth = 0, -1, 10**6
    for i, character in enumerate(text[: room + 1]):
        if character in "([{":
            depth += 1
        elif character in ")]}":
            depth -= 1
        before_operator = text.startswith(_OUTER + _INNER, i)
        after_comma = character == " " and text[i - 1] == ","
        # a break in the first third is better than none
        weight = depth * 2 + text.startswith(_INNER, i) + (10**5 if i < room // 3 else 0)
        if (before_operator or after_comma) and weight <= best_depth:
            best, best_depth = i, weight
    return best


def hanging(head: str, arguments: Sequence[str], end: str = "") -> list[str]:
    """`head(` and its arguments, which continue under the opening parenthesis; after the last `)` and `end`."""
    lines = filled(arguments, " " * len(head), f"){end}")
    return [head + lines[0][len(head) :], *lines[1:]]


def filled(items: Sequence[str], indent: str, end: str) -> list[str]:
    """Lines of what stands between commas, and `end` after the last."""
    lines, line = [], indent
    for number, item in enumerate(items):
        text = item + (end if number == len(items) - 1 else ",")
        if line != indent and len(line) + 1 + len(text) >= WIDTH:  # room for a semicolon
            lines.append(line)
            line = indent + text
        else:
            line += text if line == indent else f" {text}"
    return [*lines, line]


def comment_lines(text: str, indent: str = "", later: str | None = None) -> list[str]:
    """Prose as a comment after `indent`; before its later lines `later`, if it differs."""
    lines = paragraph(text, f"{indent}/* ", f"{indent if later is None else later} * ")
    return [*lines[:-1], f"{lines[-1]} */"]


def paragraph(text: str, first: str, later: str) -> list[str]:
    """Prose as lines of at most WIDTH columns, with room for the end of a comment."""
    words = textwrap.TextWrapper(WIDTH - len(" */"), first, later, break_long_words=False, break_on_hyphens=False)
    return words.wrap(" ".join(text.split())) or [first.rstrip()]
