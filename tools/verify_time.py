"""How long the comparison of three takes: the example stands and random ones of all counts of flywheels that matter.

python tools/verify_time.py [--states 13]

These are the stands of tests/verify/test_stands_pass.py. Seconds of processor time, of this process and of the
compiler, so that other work on the machine does not count. Exit status 1 where the comparison takes over 20 s, or
disagrees.
"""

from __future__ import annotations

import os

import campaign
from random_stands import WHAT_MATTERS, random_stands, verify_random

from mahovik.core.stand import load
from mahovik.proof.verify.c_backend import CBackend
from mahovik.stands import names, path

MOST = 20.0
"""s, of the comparison of all stands."""


def spent() -> float:
    """Processor time so far, s."""
    now = os.times()
    return now.user + now.system + now.children_user + now.children_system


def main() -> None:
    """Run it, print one line per stand."""
    states = campaign.parser(__doc__, states=13).parse_args().states
    total_made = total_compared = 0.0
    passed = True
    print(f"{'stand':10} {'flywheels':>9} {'C made, s':>10} {'compared, s':>12}")
    for stand in (*random_stands(WHAT_MATTERS), *(load(path(name)) for name in names())):
        begin = spent()
        backend = CBackend(stand)
        made = spent()
        passed &= verify_random(stand, states, backend=backend).passed
        compared = spent()
        print(f"{stand.name:10} {len(stand.flywheels):9} {made - begin:10.2f} {compared - made:12.2f}", flush=True)
        total_made += made - begin
        total_compared += compared - made
    print(f"{'all':20} {total_made:10.2f} {total_compared:12.2f}   at most {MOST:g} s may be compared")
    raise SystemExit(0 if passed and total_compared <= MOST else 1)


if __name__ == "__main__":
    main()
