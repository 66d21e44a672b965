"""The brick that a theory drives: it does what actions mean, without a program."""
