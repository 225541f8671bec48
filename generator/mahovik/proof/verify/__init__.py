"""The harness: generated C, and any other program that speaks the `eval` contract, against the literal reference."""
