"""The table of usual units is pint's, and usual stand files need no pint."""

from __future__ import annotations

import subprocess
import sys
from itertools import product

import pytest

from mahovik.core.stand.units import _registry, _root
from mahovik.core.stand.usual_units import UNITS
from mahovik.stands import names, path

FORMS = (
    "{0}",
    "{0}^2",
    "{0}^-2",
    "1/{0}",
    "{0}/{1}/{2}",
    "{0}/{1} {2}",
    "{0}*{1}/({2} {0}^2)",
    "({0}/{1})^2 {2}",
    "{0} {1}",
    "{0} {1}^2",
    "{0} {1}/{2}",
    "{0}/{1}^2",
    "{0} {1} {2}/{0}",
    "{0}^3  {1} / {2}^2",
)


@pytest.mark.parametrize("form", FORMS)
def test_the_table_is_pints(form: str) -> None:
    registry = _registry()
    names = list(UNITS)
    for k, (first, second) in enumerate(product(names, names)):
        unit = form.format(first, second, names[k % len(names)])
        scale, root = registry.get_root_units(registry.parse_units(unit))
        assert _root(unit) == (scale, {name: int(power) for name, power in root._units.items()}), unit


@pytest.mark.parametrize("name", names())
def test_example_stands_need_no_pint(name: str) -> None:
    code = "import sys; from mahovik.core.stand import load; load(sys.argv[1]); sys.exit('pint' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code, path(name)], check=False).returncode == 0
