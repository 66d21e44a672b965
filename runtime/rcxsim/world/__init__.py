"""A floor with lines, patches and walls, a robot that drives on it, and people who press its buttons."""
