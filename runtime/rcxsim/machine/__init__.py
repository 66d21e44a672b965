"""A simulated RCX that executes byte code, in simulated time: integer microseconds since it was made."""
