"""The computation behind each endpoint of `gelenk.contract`: a module of the endpoint's name, with `run`.

- `run(robot, request, limits)`: computes the outcome; `run(request)` if the operation is about no robot.
- `is_heavy(request)`: whether a request of few bytes still takes more than a millisecond.
- `at_once(robot, request, limits)`: the same as `run` if little is asked, and all that it takes is known; else None.
- `attempt(robot, request, limits)`: the same as `run` if that is fast, else None.
- `WARM_UP`: what must be known about a robot before the event loop can answer.

`operation` finds these by the endpoint's name. `outcome`: what `run` returns. `rows`: numbers as JSON and CSV.
`ik_plain`: what most calls of `ik` want, at once.
`pose_arrays`: converts poses between payloads and arrays. `cells`: the bodies that may touch, for a call or a job.
The other modules read and build what several operations share.
"""
