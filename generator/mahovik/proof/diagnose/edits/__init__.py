"""Changes that faults are made of, by stage of the reference, which gives the right terms that they need."""
