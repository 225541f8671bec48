"""Each piece of the reference against facts found another way."""
