SYSTEM_SOUNDS: tuple[tuple[object, ...], ...] = ()
