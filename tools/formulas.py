"""Write the formulas that SymPy derives into the data file of the package, from which `generate` reads them.

python tools/formulas.py
"""

from __future__ import annotations

from mahovik.core.formula.derived import FILE
from mahovik.core.formula.ordering import derive_all
from mahovik.writing import write

if __name__ == "__main__":
    write(FILE, derive_all())
