"""From the derivation to the program: which structs and functions a stand gets, and the order of every operation."""
