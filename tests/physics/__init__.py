"""Invariants of the model over random general stands; `general` draws them, `motions` moves them."""
