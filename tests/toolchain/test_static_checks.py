"""Static checks: a new deviation and a stale one are reported; the emitted C has none."""

from collections import Counter
from pathlib import Path

import pytest

from emit.stands import stand, write
from mahovik.core.emit.delivery import delivery
from mahovik.core.toolchain.static_checks import (
    DEVIATIONS,
    STANDING_FINDINGS,
    Finding,
    count_by_rule,
    findings,
    warnings_of,
)
from mahovik.stands import names
from toolchain.tools import require


def test_a_rule_that_is_not_listed_is_told() -> None:
    assert Finding("15.5", "a.c", 1).is_accepted
    assert not Finding("21.3", "a.c", 1).is_accepted
    assert count_by_rule([Finding("15.5", "a.c", 1), Finding("15.5", "a.c", 2)]) == Counter({"15.5": 2})


def test_every_reason_is_a_sentence() -> None:
    for rule, reason in {**DEVIATIONS, **STANDING_FINDINGS}.items():
        assert len(reason) > 10, rule
        assert not reason.endswith("."), rule
    assert "demo3" in names()


@pytest.mark.slow
def test_new_deviations_and_warnings_are_seen(tmp_path: Path) -> None:
    require("cppcheck", "cppcheck")
    require("clang", "clang")
    files = delivery(stand("demo3"), only=("forward",))
    write(files, tmp_path)
    assert warnings_of(tmp_path, ["demo3.c"]) == []
    known = findings(tmp_path, ["demo3.c"])
    assert all(each.is_accepted for each in known)
    assert count_by_rule(known)["15.5"] > 0
    with_goto = files["demo3.c"].replace("    demo3_sums sum;\n", "    demo3_sums sum;\n    goto on;\non:\n", 1)
    unused = with_goto.replace("const demo3_real z2 =", "const float lost = 1.0; const demo3_real z2 =", 1)
    (tmp_path / "demo3.c").write_text(unused, encoding="ascii")
    assert warnings_of(tmp_path, ["demo3.c"]) != []
    assert not all(each.is_accepted for each in findings(tmp_path, ["demo3.c"]))


@pytest.mark.slow
def test_a_file_that_is_not_read_is_not_clean(tmp_path: Path) -> None:
    """The text ends in #error: the findings say so."""
    require("cppcheck", "cppcheck")
    (tmp_path / "a.c").write_text("#if NOWHERE < 1\n#error no\n#endif\n", encoding="ascii")
    assert not all(each.is_accepted for each in findings(tmp_path, ["a.c"]))
