"""Questions about a stand: where it rests, what its C costs, which fault a program of it has."""
