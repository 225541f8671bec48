"""Parts of an FMU beside the C of its stand: its variables with units, and kinematics of the attitude and phases."""
