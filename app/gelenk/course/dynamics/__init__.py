"""Worked solutions of dynamics: the terms of the equations of motion from the bodies, and the equations solved."""
