"""`mahovik export cmake`: the C of a stand as a CMake project."""

from __future__ import annotations

from pathlib import Path

import click

from mahovik.out.cli.arguments import echo_delivery, load_stand, real_option, stand_argument


@click.command()
@stand_argument
@click.option("-o", "output", metavar="DIR", type=click.Path(), help="Folder; default ./NAME-cmake of the stand.")
@real_option
@click.option("--batch", is_flag=True, help="Also a target for many states at once, with OpenMP if wanted.")
def cmake(stand_file: str, output: str | None, real: str, batch: bool) -> None:
    """Write a CMake project with the target mahovik::NAME.

    For add_subdirectory, or installed for find_package: the C of the stand with the flags that keep its bits, a header
    for C++17, self-test and example for ctest, README. Never overwrites files of others, nor a folder of
    `mahovik generate`.
    """
    from mahovik.out.export.cmake import cmake_project
    from mahovik.proof.verify.delivery import deliver

    stand = load_stand(stand_file)
    done = deliver(Path(output or f"{stand.name}-cmake"), stand, real, cmake_project(stand, real, batch), "cmake")
    echo_delivery(done)
