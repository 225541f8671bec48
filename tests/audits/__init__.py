"""Public models of others, written anew from their published formulas, and what the reference says about them."""
