def shake_it() -> None:
    pass


def toll(b: int) -> int:
    return 2 * b
