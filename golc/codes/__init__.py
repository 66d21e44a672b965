"""A page about each code: what it means, an example that has the finding, and one that has not."""
