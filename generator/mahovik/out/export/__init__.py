"""Projects of other tools around the emitted C."""
