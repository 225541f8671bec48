"""End stops of the freedoms of a held carrier: one-sided springs whose damping grows with the depth."""
