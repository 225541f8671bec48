"""Spring-damper legs between a point of E0 and a point of the carrier."""
