"""The derivation against the paper's factors: `exact` proves, `table` makes the row of a generic flywheel."""
