"""`mahovik completion`: completion of commands, options and names in a shell."""

from __future__ import annotations

import click

from mahovik.out.cli.options import argument, command

SHELLS = ("bash", "zsh", "fish")
VARIABLE = "_MAHOVIK_COMPLETE"


@command(short_help="Print the script for completion in a shell.")
def completion(shell: str = argument(None, type=click.Choice(SHELLS))) -> None:
    """Print the script that completes commands, options, files and names of examples in a shell.

    \b
        eval "$(mahovik completion bash)"                                   in ~/.bashrc
        eval "$(mahovik completion zsh)"                                    in ~/.zshrc
        mahovik completion fish > ~/.config/fish/completions/mahovik.fish
    """
    from click.shell_completion import get_completion_class

    kind = get_completion_class(shell)
    assert kind is not None
    click.echo(kind(click.get_current_context().find_root().command, {}, "mahovik", VARIABLE).source())
