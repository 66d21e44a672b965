def shake_it() -> None:
    pass
