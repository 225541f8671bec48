"""MuJoCo without its log: it writes MUJOCO_LOG.TXT into the folder that its user works in."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def unlogged() -> Iterator[None]:
    """MuJoCo's warnings go nowhere inside: what is wrong with a model is found and told by the reader."""
    import mujoco

    before = mujoco.get_mju_user_warning()
    mujoco.set_mju_user_warning(lambda _: None)
    try:
        yield
    finally:
        mujoco.set_mju_user_warning(before)
