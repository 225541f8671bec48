"""Servos on the rotors and the slow trim of a programme, as program data: what `core/emit/servo.py` prints."""
