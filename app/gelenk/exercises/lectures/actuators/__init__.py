"""Motor, gear, pulse width modulation and encoder.

- `motor`, `gear`, `pulses`, `encoder`: one of them each. `drive`: an exam with all of them.
"""
