"""Write the table of public functions into docs/architecture.md, from the rows of the contract.

python tools/contract_page.py
"""

from __future__ import annotations

import campaign

from mahovik.contract.functions import CHOSEN, ROWS

PAGE = campaign.Block("docs/architecture.md", "functions: tools/contract_page.py")
HEAD = ("function", "equation", "gives", "want", "batch", "judges")


def table() -> str:
    """One line for each row of the contract; forms that take sines and cosines have the row of their function."""
    lines = []
    for row in (ROWS | CHOSEN).values():
        if not row.name.endswith("_at"):
            gives, judges = ", ".join(row.gives), ", ".join(row.judges)
            marks = ("yes" if row.want else "", "yes" if row.batch else "")
            lines.append([f"`{row.name}`", row.equation, gives, *marks, judges])
    return campaign.table(HEAD, lines, None)


if __name__ == "__main__":
    PAGE.write(table())
