"""FMUs as programs of the `eval` contract: a file says which of its variables is what."""
