"""`mahovik export fmu`: a stand as an FMU."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

import click

from mahovik.out.cli.arguments import given, load_stand, stand_argument
from mahovik.out.cli.progress import progress


@click.command()
@stand_argument
@click.option("--version", type=click.Choice(["2.0", "3.0"]), default="2.0", show_default=True, help="Version of FMI.")
@click.option(
    "--kind",
    type=click.Choice(["cs", "me"]),
    default="cs",
    show_default=True,
    help="cs: co-simulation, integrates itself; me: model exchange, the tool integrates.",
)
@click.option(
    "--inputs",
    type=click.Choice(["torque", "acceleration"]),
    default="torque",
    show_default=True,
    help="Inputs that drive the flywheels.",
)
@click.option("-o", "output", metavar="FILE.fmu", type=click.Path(), help="Default: ./NAME.fmu of the stand.")
@click.option("--start", metavar="STATE.json", type=click.Path(), help="Default: the static equilibrium.")
@click.option(
    "--dt", metavar="S", type=float, default=1e-4, show_default=True, help="For cs: longest internal step, s."
)
@click.option("--binary/--no-binary", default=True, help="Compile for this machine; sources are always included.")
def fmu(
    stand_file: str,
    version: str,
    kind: Literal["cs", "me"],
    inputs: Literal["torque", "acceleration"],
    output: str | None,
    start: str | None,
    dt: float,
    binary: bool,
) -> None:
    """Write an FMU: the stand for other simulators.

    The same C behind the Functional Mock-up Interface: units, names, start values, tunable parameters, sources, and a
    binary for this machine if it has a C compiler.
    """
    from mahovik.errors import UsageError
    from mahovik.out.export.fmu import export_fmu
    from mahovik.proof.verify.files import probe, write
    from mahovik.use.simulate.start import load

    stand = load_stand(stand_file)
    path = Path(output if output is not None else f"{stand.name}.fmu")
    if kind == "me" and given("dt"):
        raise UsageError("--dt: model exchange has no internal step, the tool integrates; remove it, or use --kind cs")
    if path.suffix != ".fmu":
        raise UsageError(f"-o {path}: expected a file whose name ends in .fmu")
    state = load(Path(start), stand) if start is not None else None
    probe(path)
    with progress(f"FMU of {stand.name}"):
        made = export_fmu(stand, version, kind, inputs, dt, state, binary)
    write(path, made.content)
    click.echo(click.format_filename(path))
    for line in made.lines:
        click.echo(line)
