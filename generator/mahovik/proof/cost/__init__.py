"""What the emitted C costs on a processor: instructions, stack, code, constants."""
