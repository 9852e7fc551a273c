"""The readers of what comes from outside, fed with mutations of good and bad inputs.

`targets` judges, `mutation` makes inputs out of `seeds`. `test_fuzz` does so for some seconds; `./dev fuzz` for as long
as one likes, led by what the inputs reach in our code.
"""

NAMES = ("urdf", "dh", "npy", "zip")
"""Of the targets."""
