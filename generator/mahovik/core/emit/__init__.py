"""C text of a program: the only place that knows C syntax. No mechanics here."""
