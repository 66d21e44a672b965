"""The words that NQC keeps for itself: a behaviour cannot be called by one of them."""

from __future__ import annotations

KEYWORDS = frozenset(
    """
    __event_src __nolist __res __sensor __taskid __type abs acquire asm break case catch const continue default do
    else false for goto if int monitor repeat return sign start stop sub switch task true void while
    """.split()  # noqa: SIM905
)
"""The reserved words of the compiler (nqc 3.1)."""

API = frozenset(
    """
    ACQUIRE_OUT_A ACQUIRE_OUT_B ACQUIRE_OUT_C ACQUIRE_SOUND ACQUIRE_USER_1 ACQUIRE_USER_2 ACQUIRE_USER_3
    ACQUIRE_USER_4 ActiveEvents AddToDatalog BatteryLevel CMD_FIRE_ELECTRONET CMD_FIRE_LASER CMD_FIRE_SPINNER
    CMD_FROM_RCX2 CMD_GAME_BLINK CMD_GAME_COMMAND CMD_GAME_GETVAR CMD_GAME_GIVE CMD_GAME_LOSE CMD_GAME_START
    CMD_GAME_TAKE CMD_GAME_VALUE CMD_GAME_WIN CMD_REACT_TO_GIGAMESH CMD_REACT_TO_SHADOWSTRIKE CMD_REACT_TO_SNAPTRAX
    CMD_REACT_TO_TECHNOJAW CMD_SMART_BOMB CMD_TELL_DIZZY CMD_TELL_FLASHBLIND CMD_TELL_FREEZE CMD_TELL_MAGNET
    CMD_TELL_REPULSE CMD_TELL_REVERSE CMD_TELL_SLOW CMD_TELL_TAKECONTROL CMD_TYPE_FIRE CMD_TYPE_GAME CMD_TYPE_MASK
    CMD_TYPE_REACT_TO CMD_TYPE_SPARE CMD_TYPE_USER CMD_TYPE_VLL CalibrateEvent ClearAllEvents
    ClearCounter ClearEvent ClearMessage ClearSensor ClearSound ClearTimer ClickCounter ClickTime Counter
    CreateDatalog CurrentEvents DISPLAY_OUT_A DISPLAY_OUT_B DISPLAY_OUT_C DISPLAY_SENSOR_1 DISPLAY_SENSOR_2
    DISPLAY_SENSOR_3 DISPLAY_USER DISPLAY_WATCH DatalogByte DatalogType DatalogValue DecCounter DisableOutput
    EVENT_MASK EVENT_TYPE_CLICK EVENT_TYPE_DOUBLECLICK EVENT_TYPE_EDGE EVENT_TYPE_FASTCHANGE EVENT_TYPE_HIGH
    EVENT_TYPE_LOW EVENT_TYPE_MESSAGE EVENT_TYPE_NORMAL EVENT_TYPE_PRESSED EVENT_TYPE_PULSE EVENT_TYPE_RELEASED
    EnableOutput Event EventState FastTimer FirmwareVersion Float Fwd GlobalOutputStatus Hysteresis ID_BOT_MAX
    ID_BOT_MIN ID_CTRL_1 ID_CTRL_2 ID_CTRL_3 ID_CTRL_4 ID_CTRL_5 ID_CTRL_6 ID_NONE ID_PC IncCounter Indirect
    InitRCComm InitSpybotComm InvertOutput LowerLimit MSG_BROADCAST MSG_DIRECT MSG_LINKCAST Message MuteSound OUT_A
    OUT_AB OUT_ABC OUT_AC OUT_B OUT_BC OUT_C OUT_FLOAT OUT_FULL OUT_FWD OUT_HALF OUT_LOW OUT_OFF OUT_ON OUT_REV
    OUT_TOGGLE ObvertOutput Off On OnFor OnFwd OnRev OutputStatus PlaySound PlayTone Program RC_CHANNEL_1
    RC_CHANNEL_2 RC_CHANNEL_3 RC_CMD_FLOAT RC_CMD_FWD RC_CMD_OFF RC_CMD_REV Random Rev S1 S2 S3 SENSOR_1 SENSOR_2
    SENSOR_3 SENSOR_CELSIUS SENSOR_EDGE SENSOR_FAHRENHEIT SENSOR_LIGHT SENSOR_MODE_BOOL SENSOR_MODE_CELSIUS
    SENSOR_MODE_EDGE SENSOR_MODE_FAHRENHEIT SENSOR_MODE_PERCENT SENSOR_MODE_PULSE SENSOR_MODE_RAW
    SENSOR_MODE_ROTATION SENSOR_PULSE SENSOR_ROTATION SENSOR_TOUCH SENSOR_TYPE_LIGHT SENSOR_TYPE_NONE
    SENSOR_TYPE_ROTATION SENSOR_TYPE_TEMPERATURE SENSOR_TYPE_TOUCH SERIAL_COMM_4800 SERIAL_COMM_76KHZ
    SERIAL_COMM_DEFAULT SERIAL_COMM_DUTY25 SERIAL_COMM_RC SERIAL_COMM_RCX SERIAL_COMM_SPYBOT SERIAL_PACKET_CHECKSUM
    SERIAL_PACKET_DEFAULT SERIAL_PACKET_NEGATED SERIAL_PACKET_PREAMBLE SERIAL_PACKET_RC SERIAL_PACKET_RCX
    SERIAL_PACKET_SPYBOT SOUND_CLICK SOUND_DOUBLE_BEEP SOUND_DOWN SOUND_FAST_UP SOUND_LOW_BEEP SOUND_UP
    SPY_CTRL_BTN_1 SPY_CTRL_BTN_2 SPY_CTRL_BTN_3 SPY_CTRL_BTN_4 SPY_CTRL_BTN_5 SPY_CTRL_RCX_1 SPY_CTRL_RCX_2
    SPY_CTRL_RCX_3 SPY_CTRL_RCX_4 SPY_CTRL_RCX_5 SPY_CTRL_RCX_6 SPY_CTRL_RCX_7 SPY_CTRL_RCX_8 SelectDisplay
    SelectProgram SendMessage SendRCMessage SendRCMsg SendSerial SendSpybotCtrlMessage SendSpybotCtrlMsg
    SendSpybotCtrlPingMessage SendSpybotCtrlPingMsg SendSpybotMessage SendSpybotMsg SendSpybotPing SendSpybotPingMsg
    SensorMode SensorType SensorValue SensorValueBool SensorValueRaw SerialComm SerialData SerialPacket Set
    SetClickCounter SetClickTime SetDirection SetEvent SetGlobalDirection SetGlobalOutput SetHysteresis
    SetIndirectVar SetLowerLimit SetMaxPower SetMessage SetOutput SetPower SetPriority SetRCMessage SetRandomSeed
    SetSensor SetSensorMode SetSensorType SetSerialComm SetSerialData SetSerialPacket SetSleepTime
    SetSpybotCtrlMessage SetSpybotCtrlPingMessage SetSpybotMessage SetSpybotPing SetTimer SetTxPower SetUpperLimit
    SetUserDisplay SetWatch SleepNow StopAllTasks T1 T2 T3 T4 TX_POWER_HI TX_POWER_LO Timer Toggle UART_BOT
    UART_CTRL UART_PING UART_RC UnmuteSound UploadDatalog UpperLimit Wait Watch until
    """.split()  # noqa: SIM905
)
"""The macros, functions and constants of the standard header (``nqc -api``) for both firmwares."""

HOOKS = frozenset({"initialize", "startBehaviour", "stopAllBehaviours", "panicAction"})
"""What the control program calls, under Legolog's names."""

GENERATED = frozenset({"main", "sensorVal", "exogAction", *HOOKS})
PREFIXES = ("golc_", "GOLC_", "NUMBER_", "LAST_", "EXOG_", "__")
LONGEST_NAME = 200
"""An identifier of 255 characters corrupts the symbols of the image; generated names add a prefix to this."""


def complaint(name: str) -> str | None:
    """Why a name cannot be that of a behaviour, as the end of a sentence about it; None if it can."""
    if name in KEYWORDS:
        return "is a word of NQC itself"
    if name in API:
        return "is a name of NQC's standard functions"
    if name in GENERATED:
        return "is a name of the control program"
    for prefix in PREFIXES:
        if name.startswith(prefix):
            return f"begins with `{prefix}`, as the names that are generated do"
    if len(name) > LONGEST_NAME:
        return f"is longer than {LONGEST_NAME} characters"
    return None
