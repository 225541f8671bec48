"""From each equation of the paper to its derivations, to program functions, to lines of C, to tests."""
