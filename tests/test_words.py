"""Plain English, as far as a program can see it: openings of docstrings, and phrases that nobody uses elsewhere."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parents[1]

OPENINGS = (
    r"Of\b",
    r"By\b",
    r"As\b",
    r"It;",
    r"So many\b",
    r"Whose\b",
    r"Which\b",
    r"Than\b",
    r"And\b",
    r"Or\b",
    r"But\b",
    r"Those\b",
    r"Said\b",
    r"Told\b",
    r"In turn\b",
    r"Its\b",
    r"The same( (as|at|by|for|from|in|of|on|to|where|with|without)\b|[.,;:])",
    r"For (the|all|many|one)\b.{0,12}\.$",
    r"What (is|are|was|has|it|they|one|all|every|any|each|a|an|the|this|that|may|can|must|other|others)\b",
    r"(All that|Where|Who)\b.* (has|have|is|are|does|do) not\b(?! \w+ed\b)",
    r"How .* (is|are) (called|named|said|told|spelt)\b",
    r"(At|In|On|To|For|From|With|Without|Over|Into|Whether|Per)( [^\s,:;]+){0,2}\.$",
    r"(\w+ly )?\w+(ed|wn|ught)\.$",
)
"""Ways in which a docstring must not begin: it says what the thing is or does, with a subject or a verb."""

PHRASES = (
    r"(?<!who )(?<!which )\b(has|have|had) not\b(?! (yet|been|only|changed|to)\b)(?! \w+(ed|en|un|ad|et)\b)",
    r"\b(is|are|was|were|be) told\b",
    r"\b(goes|go|knows|know|acts|lies|takes|gives|makes|holds|says|fits|comes|stands|needs|sees|reads|moves) not\b",
    r"\beach (second|third|fourth|fifth|sixth|eighth|tenth)\b",
    r"\bthat (are|is) there\b",
    r"\bof the clock\b",
    r"\b(s|seconds|times?) of the processor\b",
    r"\bby heart\b",
    r"\bby Ctrl-C\b",
    r"\bsays? of (it|them)sel(f|ves)\b",
    r"\bso many\b",
    r"\b(is|are|was|were) (not )?meant by\b",
    r"\bas soon as it is through\b",
    r"\bas (the|a|an) \w+ (has|have) (it|them)\b",
    r"\bwho else\b",
    r"\bof our own\b",
    r"\bin spite of\b",
    r"\bto begin with\b",
    r"\btakes? off\b|\btaken off\b",
    r"\bforetells?\b|\bdear(er|est)\b",
    r"\bnames what is\b",
    r"\b(a|one) (line|row|number|struct|table|file|column|folder|key|record|comment|reading|value|page|case|point)"
    r" an? (?!time\b)\w+",
    r"\b(counts|rows|nodes|intervals|ticks|windings|harmonics|samples) an? (turn|period|flywheel|state|second|row)\b",
    r"\bturns a period\b",
    r"\b(thereof|therein|wherein|whereof|anew|naught|nought|ere|whence|thence|hither|thither)\b",
)
"""Phrases of nobody's English but a poet's; the usual words say the same."""

NAMES = (
    r"_?(afloat|across|after|along|among|apart|around|at|away|before|beneath|beside|between|beyond|both|by|drawn|each|"
    r"gone|heaviness|held|kept|known|left|meant|near|of|off|on|over|passed|said|seen|taken|told|turned|ways|weighed|"
    r"within|without|wishes)"
)
"""Names that no function, class or method may have: a function is a verb, or a noun for what it returns."""

PARTICIPLES = (
    r"_?(?!coupled$|generalized$|re?ad$|need$|feed$|speed$|seed$|embed$|proceed$)"
    r"([a-z]+ed|bound|broken|chosen|driven|found|given|heard|hidden|lost|made|met|shown|worn|written)"
)
"""Names that say of what is there no more than what was done to it: no function of the package or of a tool may have
one, but for properties, whose values they tell, and the functions of the C `coupled` and `generalized`."""

METHOD_NAMES = r"_?(at|of)"
"""Names that methods may have nevertheless, as they are read with an argument: `motion.at(t)`, `Problem.of(stand)`."""

PROPERTY_NAMES = r"passed"
"""Names that properties may have nevertheless: the verdict of a report."""

PROGRAM_NAMES = "generator/mahovik/core/lower/"
"""Functions here are named like the functions of the emitted C that they make; PARTICIPLES holds here too."""

FORMULA_NAMES = "generator/mahovik/core/derive/"
"""Functions here are named like what a formula is called after an operation: `rotated`."""

SOURCES = sorted(
    path
    for pattern in (
        "generator/**/*.py",
        "tests/**/*.py",
        "tools/**/*.py",
        "bench/**/*.py",
        "templates/**/*.*",
        "docs/**/*.md",
        "*.md",
        "Makefile",
    )
    for path in REPOSITORY.glob(pattern)
    if path != Path(__file__) and "old_release" not in path.parts
)


def name_of(path: Path) -> str:
    """Path of a file from the root of the repository."""
    return path.relative_to(REPOSITORY).as_posix()


def nodes_of(text: str) -> list[ast.AST]:
    """All nodes of the syntax tree of a module."""
    return list(ast.walk(ast.parse(text)))


def docstrings(nodes: Sequence[ast.AST]) -> Iterator[tuple[int, str]]:
    """Line and text of every docstring: of modules, classes, functions, and of values (a string after the value)."""
    bodies = (getattr(node, "body", None) for node in nodes)
    for statement in (each for body in bodies if isinstance(body, list) for each in body):
        value = statement.value if isinstance(statement, ast.Expr) else None
        if isinstance(value, ast.Constant) and isinstance(value.value, str):
            yield value.lineno, value.value


def names(nodes: Sequence[ast.AST]) -> Iterator[tuple[int, str]]:
    """Line and name of every function, class and method of a module, also inside functions, but for METHOD_NAMES."""
    methods = {each for node in nodes if isinstance(node, ast.ClassDef) for each in node.body}
    for node in nodes:
        if isinstance(node, ast.FunctionDef | ast.ClassDef) and not (
            node in methods and isinstance(node, ast.FunctionDef) and re.fullmatch(_names_allowed(node), node.name)
        ):
            yield node.lineno, node.name


def participles(path: Path, nodes: Sequence[ast.AST]) -> Iterator[tuple[int, str]]:
    """Line and name of every function of the package or of a tool, but for properties, that is a lone participle."""
    if not name_of(path).startswith(("generator/", "tools/")) or name_of(path).startswith(FORMULA_NAMES):
        return
    for node in nodes:
        if isinstance(node, ast.FunctionDef) and not _is_property(node) and re.fullmatch(PARTICIPLES, node.name):
            yield node.lineno, node.name


def _names_allowed(method: ast.FunctionDef) -> str:
    return PROPERTY_NAMES if _is_property(method) else METHOD_NAMES


def _is_property(method: ast.FunctionDef) -> bool:
    return any(ast.unparse(each).endswith("property") for each in method.decorator_list)


def faults(path: Path) -> list[str]:
    """Breaches of the rules in one file: line, and the words."""
    text = path.read_text()
    found = []
    if path.suffix == ".py":
        nodes = nodes_of(text)
        for line, docstring in docstrings(nodes):
            first = docstring.strip().partition("\n")[0]
            found += [f"{line}: opens with {first!r}" for rule in OPENINGS if re.match(rule, first)]
        if not name_of(path).startswith(PROGRAM_NAMES):
            found += [
                f"{line}: named {name!r}" for line, name in names(nodes) if re.fullmatch(NAMES, name, re.IGNORECASE)
            ]
        found += [f"{line}: named {name!r}, a participle" for line, name in participles(path, nodes)]
    if path.name == "CHANGELOG.md":
        text = re.sub(r"`[^`\n]*`", "``", text)  # names and messages of earlier versions
    lower = text.lower()  # quicker than a search that ignores case
    if any(re.search(rule, lower) for rule in PHRASES):
        for line, words in enumerate(lower.splitlines(), 1):
            found += [f"{line}: {hit.group()!r}" for rule in PHRASES for hit in re.finditer(rule, words)]
    return found


METHODS = """
class Motion:
    def at(self, t): ...
    def seen(self): ...
    @cached_property
    def passed(self): ...
    @property
    def near(self): ...
def at(t): ...
"""


def test_names_of_methods_are_seen() -> None:
    found = [line for line, name in names(nodes_of(METHODS)) if re.fullmatch(NAMES, name)]
    assert sorted(found) == [4, 8, 9]


def test_participles_are_seen() -> None:
    text = (
        "def rendered(): ...\ndef coupled(): ...\ndef _given(): ...\nclass A:\n    @property\n    def held(self): ..."
    )
    nodes = nodes_of(text)
    assert [name for _, name in participles(REPOSITORY / "tools/tool.py", nodes)] == ["rendered", "_given"]
    assert list(participles(REPOSITORY / FORMULA_NAMES / "module.py", nodes)) == []


@pytest.mark.parametrize("folder", sorted({path.parent for path in SOURCES}), ids=name_of)
def test_plain_english(folder: Path) -> None:
    found = {name_of(path): faults(path) for path in SOURCES if path.parent == folder}
    assert {name: lines for name, lines in found.items() if lines} == {}
