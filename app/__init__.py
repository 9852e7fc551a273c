"""Gelenk: robot kinematics over HTTP, every answer recomputed before it is sent.

- `main`: wires the parts into the application; `serve` runs it; `settings` is read once, there. `keys`: makes API keys.
- `supervisor`: starts the worker processes, and replaces them.
- `connections`: HTTP connections with bounds on time, size and number.
- `preload`: what is loaded before any other process is started; `processes`: copies of the one that has loaded it.
- `logs`: the log, as lines of JSON.
- `prune`: takes from a container image what the service never opens.
- `api`: HTTP only. `schemas`: what travels. `store`: robots on disk. `jobs`: long work in processes of its own.
- `crew`: processes that answer what may take long or go wrong.
- `plots`: pictures. `trajectory`: motions in time. `course`: the course's calculators, which need no robot.
- `kinematics`: what a robot does. `model`: what a robot is. Both know neither HTTP nor settings.

Arrows point down only; `./dev lint` checks it.
"""
