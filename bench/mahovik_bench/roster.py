"""Who takes part, and what is missing."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from importlib import import_module

from mahovik.errors import ToolchainError
from mahovik_bench.build import Built
from mahovik_bench.cases import Case
from mahovik_bench.peer import Peer

MODULES = {
    "mahovik": "own",
    "casadi": "casadi_peer",
    "pinocchio": "pinocchio_peer",
    "mujoco": "mujoco_peer",
    "sympy": "sympy_peer",
    "symforce": "symforce_peer",
}
"""Program to module; each has `peers(case)`."""
JOBS = 2


class Roster:
    """Peers by case, built; `absent` says who does not take part and why."""

    def __init__(self, cases: Sequence[Case], programs: Sequence[str], budget: float, say: Callable[[str], None]):
        self.absent: dict[str, str] = {}
        self.built: dict[int, list[tuple[Peer, Built]]] = {case.N: [] for case in cases}
        self._deadline = time.monotonic() + budget
        self._say = say
        wanted = [(case, program) for program in programs for case in reversed(cases)]
        with ThreadPoolExecutor(max_workers=JOBS) as pool:
            listed = list(pool.map(lambda pair: self._peers(*pair), wanted))
            pairs = [(case, peer) for (case, _), peers in zip(wanted, listed, strict=True) for peer in peers]
            deque(pool.map(lambda pair: self._build(*pair), self._in_order(pairs)), maxlen=0)
        for case, peer in sorted(pairs, key=lambda pair: programs.index(pair[1].program)):
            if peer.recipe.made():
                self.built[case.N].append((peer, peer.recipe.build()))

    @staticmethod
    def _in_order(pairs: Sequence[tuple[Case, Peer]]) -> list[tuple[Case, Peer]]:
        """One of those that share a library: ours, Pinocchio (the longest), the others; last what is only counted."""
        by_folder = {peer.recipe.folder(): (case, peer) for case, peer in pairs}

        def place(pair: tuple[Case, Peer]) -> tuple[bool, bool, bool]:
            peer = pair[1]
            return (peer.program != "mahovik", not peer.timed, peer.program != "pinocchio")

        return sorted(by_folder.values(), key=place)

    def _peers(self, case: Case, program: str) -> list[Peer]:
        try:
            found: list[Peer] = import_module(f"mahovik_bench.{MODULES[program]}").peers(case)
        except (ImportError, OSError, ToolchainError) as error:
            self.absent[program] = str(error)
            return []
        return found

    def _build(self, case: Case, peer: Peer) -> None:
        if not peer.recipe.made() and time.monotonic() > self._deadline:
            self.absent[f"{peer.name}, N = {case.N}"] = "the budget was over before it was compiled"
            return
        fresh = not peer.recipe.made()
        try:
            built = peer.recipe.build()
        except ToolchainError as error:
            self.absent[f"{peer.name}, N = {case.N}"] = str(error)
            return
        if fresh:
            self._say(f"N = {case.N}: {peer.name} compiled in {built.compiled.seconds:.1f} s")
