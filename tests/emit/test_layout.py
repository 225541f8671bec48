"""Breaking of long lines: never a token changed, never too wide where a break is possible."""

import random
import re

from hypothesis import example, given
from hypothesis import strategies as st

from emit.trees import Trees
from mahovik.core.emit.expression import Expressions
from mahovik.core.emit.layout import WIDTH, paragraph, wrap_statement
from mahovik.core.emit.names import Names
from mahovik.core.emit.statement import Statements
from mahovik.core.program.build import Body
from mahovik.core.program.expression import Variable
from mahovik.core.program.statement import Set, When
from mahovik.core.program.types import DOUBLE, FLOAT, Kind

TOKEN = re.compile(
    r"/\*.*?\*/|(?:\d+\.?\d*(?:e[-+]?\d+)?|0x[0-9a-f]+)[uF]?|\w+|->|<<|>>|[<>=!+*/&|^-]=|&&|\|\||\+\+|\S", re.S
)
SEEDS = st.integers(0, 2**32 - 1)


def tokens(text: str) -> list[str]:
    """C tokens, a comment as one."""
    return [re.sub(r"\s+", " ", token) for token in TOKEN.findall(text)]


def tree_text(seed: int, depth: int = 7) -> str:
    """A long expression."""
    rng = random.Random(seed)
    trees = Trees(rng, rng.choice([DOUBLE, FLOAT]))
    return Expressions(Names("t"), trees.precision).text(trees.real(depth))


@given(SEEDS, st.integers(0, 12))
def test_wrapping_keeps_every_token(seed: int, depth: int) -> None:
    text = f"const t_real value = {tree_text(seed)};"
    lines = wrap_statement(text, "    " * depth)
    assert tokens("\n".join(lines)) == tokens(text)
    assert all(line == line.rstrip() and line.strip() for line in lines)


@given(SEEDS)
def test_wrapped_lines_fit(seed: int) -> None:
    lines = wrap_statement(f"const t_real value = {tree_text(seed)};", "    ")
    assert max(len(line) for line in lines) <= WIDTH


@given(SEEDS)
def test_conditions_with_comments_keep_their_tokens(seed: int) -> None:
    """The head of an if carries its comment when it is broken."""
    trees = Trees(random.Random(seed), DOUBLE)
    names = Names("t")
    expressions = Expressions(names, DOUBLE)
    condition = trees.truth(6)
    body = Body()
    a = Variable("a", Kind.REAL).place
    with body.when(condition, comment="why, as a reader would ask - in some words"):
        body.set(a, trees.real(5), comment="what it is")
    lines = Statements(names, expressions).block(body.statements, "    ")
    found = [t for t in tokens("\n".join(lines)) if not t.startswith("/*")]
    (when,) = body.statements
    assert isinstance(when, When)
    (assigned,) = when.body
    assert isinstance(assigned, Set)
    value = expressions.text(assigned.value)
    assert found == tokens(f"if ({expressions.text(condition)}) {{ a = {value}; }}")
    assert "\n".join(lines).count("/*") == "\n".join(lines).count("*/") == 2


WORDS = st.lists(st.text("abcxyz,.()'+-=", min_size=1, max_size=30), min_size=1, max_size=60)


@given(WORDS)
@example(["x"] * 200)
def test_paragraphs_keep_every_word_and_fit(words: list[str]) -> None:
    lines = paragraph(" ".join(words), "/* ", " * ")
    assert [w for line in lines for w in line[3:].split()] == words
    assert max(len(line) for line in lines) <= WIDTH


@given(st.text("abc", min_size=150, max_size=300))
def test_what_cannot_be_broken_stays_whole(word: str) -> None:
    assert wrap_statement(word, "    ") == [f"    {word}"]
