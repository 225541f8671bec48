"""MuJoCo's C library as a contestant."""

from __future__ import annotations

from pathlib import Path

from mahovik_bench.build import CACHE, NATIVE, Recipe
from mahovik_bench.cases import Case
from mahovik_bench.contestant import Peer


def peers(case: Case) -> list[Peer]:
    """Coupled by mj_forward, torque by mj_inverse; it has no forward for given phi''."""
    import mujoco

    from mahovik.proof.verify.judges import mujoco_spec

    CACHE.mkdir(parents=True, exist_ok=True)
    model, spec = CACHE / f"{case.stand.name}.mjb", mujoco_spec(case.stand)
    spec.worldbody.first_body().add_freejoint()
    mujoco.mj_saveModel(spec.compile(), str(model))
    package = Path(mujoco.__file__).parent
    (library,) = package.glob("libmujoco.so.*")
    flags = ("-std=c99", "-O2", f"-DFLYWHEELS={case.N}", f"-I{package / 'include'}")
    link = (str(library), f"-Wl,-rpath,{package}")
    files = {"adapter.c": (NATIVE / "mujoco_peer.c").read_text(encoding="utf-8")}
    recipe = Recipe("gcc", flags, files, link=link)
    return [Peer("mujoco", "its library", ("coupled", "torque"), recipe, str(model), counted=True)]
