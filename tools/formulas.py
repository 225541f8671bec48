"""Write the formulas that SymPy derives into the data file of the package, from which `generate` reads them.

python tools/formulas.py
"""

from __future__ import annotations

import argparse

from mahovik.core.formula.derived import FILE
from mahovik.core.formula.ordering import derive_all
from mahovik.writing import write

if __name__ == "__main__":
    argparse.ArgumentParser(description=__doc__, usage="python tools/formulas.py").parse_args()
    write(FILE, derive_all())
