"""Cost of the emitted C on a processor: instructions, stack, code, constants."""
