"""The answer to each operation of `gelenk.contract`: a module of the endpoint's name, whose `run` computes it.

- `run(robot, request, limits)`: the outcome; `run(request)` where the operation is about no robot.
- `is_heavy(request)`: whether a request of few bytes is still work of more than a millisecond.
- `attempt(robot, request, limits)`: the same as `run` where that is fast, else None.
- `WARM_UP`: what has to be known about a robot before the event loop can answer.

`operation` finds these by the endpoint's name. `outcome`: what `run` returns. `rows`: numbers as JSON and CSV.
`pose_arrays`: poses on the wire as arrays.
The other modules read and shape what several of these share.
"""
