"""The motion of the flywheels that makes free numbers of a stand as well determined as possible."""
