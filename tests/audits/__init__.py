"""Public models of others, written from their published formulas, and what the reference says about them."""
