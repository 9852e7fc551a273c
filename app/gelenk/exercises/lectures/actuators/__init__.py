"""Motor, gear, pulse width modulation and encoder.

- `motor`: a motor and its pulses. `drive`: gear and encoder, and an exam with all of them.
"""
