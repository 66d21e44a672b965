from golc.runtime.rcxsim.surroundings import Tone

SYSTEM_SOUNDS = (
    (Tone(2000, 4),),
    (Tone(2000, 10), Tone(2000, 10)),
    tuple(Tone(frequency, 8) for frequency in (1320, 1100, 880, 660, 440)),
    tuple(Tone(frequency, 8) for frequency in (440, 660, 880, 1100, 1320)),
    (Tone(100, 50),),
    tuple(Tone(frequency, 4) for frequency in (440, 660, 880, 1100, 1320)),
)
