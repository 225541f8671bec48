"""An audited model as a program for `mahovik judge --with`: python -m audits NAME < states.jsonl.

`--stand` prints its stand file instead.
"""

from __future__ import annotations

import json
import sys

from audits.measure import AUDITS, ask
from mahovik.core.stand.stand_file import dumps
from mahovik.errors import StateError
from mahovik.proof.verify.states import Request, read_line


def main() -> None:
    """Answers every line."""
    audit = AUDITS[sys.argv[1]]
    if "--stand" in sys.argv:
        print(dumps(audit.stand), end="")
        return
    for line in filter(str.strip, sys.stdin):
        name = json.loads(line).get("id")
        try:
            request = read_line(audit.stand, line)
            if not set(request.want) <= set(audit.wants):
                raise StateError(f"want: {', '.join(request.want)} not offered, expected {', '.join(audit.wants)}")
            values = {"id": name}
            for want in request.want:
                values |= ask(audit, Request(name, request.state, (want,)))
        except StateError as error:
            values = {"id": name, "error": str(error)}
        print(json.dumps(values))


if __name__ == "__main__":
    main()
