"""Where exogenous actions come from: the terminal, a schedule, TCP, the bricks."""
