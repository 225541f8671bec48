"""Cross-flow drag of a slender body, strip by strip along its first axis."""
