"""What an FMU has beside the C of its stand: its variables with units, and kinematics of the attitude and phases."""
