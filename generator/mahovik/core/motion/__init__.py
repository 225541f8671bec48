"""What moves the flywheels and how the carrier is to move, as files say it: regimes, motions, programmes, servos."""
