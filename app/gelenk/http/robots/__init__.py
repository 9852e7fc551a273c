"""Robots as resources.

- `robots`: the collection and its members. `info`: what the service says about a robot. `meshes`: its files.
"""
