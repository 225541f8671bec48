"""Which physical fault a foreign program has: its error against what each fault of a dictionary would give."""
