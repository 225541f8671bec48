"""The command line: what it prints, and every exit status."""
