"""`mahovik completion`: completion of commands, options and names in a shell."""

from __future__ import annotations

import click

SHELLS = ("bash", "zsh", "fish")
VARIABLE = "_MAHOVIK_COMPLETE"


@click.command(short_help="Print the script for completion in a shell.")
@click.argument("shell", type=click.Choice(SHELLS))
@click.pass_context
def completion(ctx: click.Context, shell: str) -> None:
    """Print the script that completes commands, options, files and names of examples in a shell.

    \b
        eval "$(mahovik completion bash)"                                   in ~/.bashrc
        eval "$(mahovik completion zsh)"                                    in ~/.zshrc
        mahovik completion fish > ~/.config/fish/completions/mahovik.fish
    """
    from click.shell_completion import get_completion_class

    kind = get_completion_class(shell)
    assert kind is not None
    click.echo(kind(ctx.find_root().command, {}, "mahovik", VARIABLE).source())
