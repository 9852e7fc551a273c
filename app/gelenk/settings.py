"""The operator's settings, read once from the environment and passed down; no lower layer imports them."""

import os
import re
from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import TypeAlias

from platformdirs import user_data_path

from gelenk.logs import LEVELS
from gelenk.package_data import catalogue

_PREFIX = "GELENK_"
_OF_CLIENTS = {"GELENK_SERVER", "GELENK_KEY"}
"""Variables that `gelenk.client` reads; they may be set in the same environment."""


class InvalidSetting(Exception):
    """An environment variable with an invalid value."""


@dataclass(frozen=True, slots=True)
class Settings:
    """Settings of the service; defaults are safe on a laptop.

    Attributes:
        data_dir: Folder for uploaded robots, scenes and jobs (`GELENK_DATA_DIR`).
        catalogue_dir: Folder of the robots included in the project (`GELENK_CATALOGUE_DIR`).
        root_path: Path prefix under which a proxy serves the application; the proxy may keep or strip it
            (`GELENK_ROOT_PATH`).
        max_body_bytes: Largest request body (`GELENK_MAX_BODY_BYTES`).
        held_body_bytes: Total size of the large request bodies that each worker process holds, incoming or waiting for
            their answer; one of the largest always fits (`GELENK_HELD_BODY_BYTES`).
        max_answer_numbers: Most numbers in one answer (`GELENK_MAX_ANSWER_NUMBERS`).
        crew_processes: Processes of each worker process for long requests: its pool; up to half as many more, for
            clients that have none while others occupy all (`GELENK_CREW_PROCESSES`).
        crew_waiting: Requests that may wait for one of the pool; more are refused (`GELENK_CREW_WAITING`).
        connections: Open connections of each worker process; beyond that, those idle longest are closed; fewer if the
            system allows fewer open files (`GELENK_CONNECTIONS`).
        requests_waiting: Requests of each worker process that may wait to start (`GELENK_REQUESTS_WAITING`).
        client_requests: Requests of one client, identified by its key or else its address, that may wait for the pool
            or be in progress (`GELENK_CLIENT_REQUESTS`).
        client_robots: Uploaded robots that one client may store, identified by its key; all clients without a key count
            as one (`GELENK_CLIENT_ROBOTS`).
        client_robot_bytes: Bytes of all of them (`GELENK_CLIENT_ROBOT_BYTES`).
        client_scenes: Scenes that one client may store, likewise (`GELENK_CLIENT_SCENES`).
        client_scene_bytes: Bytes of all of them, files included (`GELENK_CLIENT_SCENE_BYTES`).
        crew_memory_bytes: Memory that each process of the pool may use beside the program itself
            (`GELENK_CREW_MEMORY_BYTES`).
        request_seconds: How long a request may wait for the pool, and may then run, [s]
            (`GELENK_REQUEST_SECONDS`).
        job_processes: Processes that the jobs of each worker process share, started when first needed
            (`GELENK_JOB_PROCESSES`).
        running_jobs: Jobs of each worker process that run at a time; up to half as many more, likewise
            (`GELENK_RUNNING_JOBS`).
        unfinished_jobs: Jobs of one client, in all worker processes, that may wait or run while no other client has
            any, otherwise half as many; of all clients together half as many more; further ones are refused
            (`GELENK_UNFINISHED_JOBS`).
        kept_jobs: Jobs that are stored; the oldest finished ones are removed first (`GELENK_KEPT_JOBS`).
        kept_job_bytes: Bytes of all stored jobs (`GELENK_KEPT_JOB_BYTES`).
        kept_job_days: How long a finished job is stored, [days] (`GELENK_KEPT_JOB_DAYS`).
        job_bytes: Bytes of the finished parts of one job, from which it resumes after a restart (`GELENK_JOB_BYTES`).
        job_seconds: How long a job may run at a time, [s] (`GELENK_JOB_SECONDS`).
        ray_address: Head of a Ray cluster that computes the jobs' parts, `host:port`; this machine must be one of its
            own. Empty for processes of this machine (`GELENK_RAY_ADDRESS`).
        ray_lost: What to do with jobs while the cluster has no machine: `wait`, which `/readyz` reports, or continue in
            processes of this machine, `local` (`GELENK_RAY_LOST`).
        max_job_samples: Most configurations of a workspace (`GELENK_MAX_JOB_SAMPLES`).
        api_keys: A file of keys, or the keys themselves as `./dev keys` writes them; empty if none are needed
            (`GELENK_API_KEYS`).
        open_access: Whether the service may listen beyond this machine without keys (`GELENK_OPEN_ACCESS`).
        course_secret: Decides the numbers of homework, unless a request brings its own; empty for a random one that is
            kept in the data folder (`GELENK_COURSE_SECRET`).
        log_level: Lowest level that is logged: `debug`, `info` (each request), `warning` (refusals) or `error`
            (`GELENK_LOG_LEVEL`).
        otlp_endpoint: Address for traces by OpenTelemetry's protocol, such as `http://127.0.0.1:4318`; empty for none
            (`GELENK_OTLP_ENDPOINT`).
        trusted_hosts: Host names that it accepts besides this machine's own, without ports: `lab.example.org`,
            `*.example.org`, or `*` for any (`GELENK_TRUSTED_HOSTS`).
        allowed_origins: Origins whose pages may call it, such as `https://lab.example.org` (`GELENK_ALLOWED_ORIGINS`).
        frame_ancestors: Origins whose pages may show a robot in a frame, by `/embed`: such as `http://localhost:8888`
            for a notebook, or `*` for any (`GELENK_FRAME_ANCESTORS`).
        trusted_proxies: Addresses or networks of proxies that are trusted to report a request's origin
            (`GELENK_TRUSTED_PROXIES`).
    """

    data_dir: Path = field(default_factory=lambda: user_data_path("gelenk", appauthor=False))
    catalogue_dir: Path = field(default_factory=catalogue)
    root_path: str = ""
    max_body_bytes: int = 64 * 1024 * 1024
    held_body_bytes: int = 512 * 1024 * 1024
    max_answer_numbers: int = 20_000_000
    crew_processes: int = field(default_factory=lambda: max(2, min(8, os.cpu_count() or 1)))
    crew_waiting: int = 160
    connections: int = 2000
    requests_waiting: int = 150
    client_requests: int = 16
    client_robots: int = 20_000
    client_robot_bytes: int = 10 * 1024**3
    client_scenes: int = 2_000
    client_scene_bytes: int = 2 * 1024**3
    crew_memory_bytes: int = 4 * 1024**3
    request_seconds: int = 60
    job_processes: int = field(default_factory=lambda: min(8, os.cpu_count() or 1))
    running_jobs: int = 2
    unfinished_jobs: int = 16
    kept_jobs: int = 100
    kept_job_bytes: int = 2 * 1024**3
    kept_job_days: int = 30
    job_bytes: int = 1024**3
    job_seconds: int = 600
    ray_address: str = ""
    ray_lost: str = "wait"
    max_job_samples: int = 10_000_000
    api_keys: str = ""
    open_access: bool = False
    course_secret: str = field(default="", repr=False)
    log_level: str = "warning"
    otlp_endpoint: str = ""
    trusted_hosts: tuple[str, ...] = ()
    allowed_origins: tuple[str, ...] = ()
    frame_ancestors: tuple[str, ...] = ()
    trusted_proxies: tuple[str, ...] = ()

    @classmethod
    def from_environment(cls, environment: Mapping[str, str]) -> "Settings":
        """Read the `GELENK_*` variables.

        Raises:
            InvalidSetting: A variable is unknown (a misspelt limit must not go unnoticed), or its value is invalid.
        """
        known = {_PREFIX + item.name.upper(): item.name for item in fields(cls)}
        values: dict[str, _Value] = {}
        for variable, text in environment.items():
            if not variable.startswith(_PREFIX) or variable in _OF_CLIENTS:
                continue
            if variable not in known:
                raise InvalidSetting(f"{variable} is not a setting; known are {', '.join(sorted(known))}")
            values[known[variable]] = _parse(variable, known[variable], text)
        return cls(**values)  # type: ignore[arg-type]


_Value: TypeAlias = Path | str | int | tuple[str, ...]
_HOST = re.compile(r"\*|(\*\.)?[a-z0-9]([a-z0-9.-]*[a-z0-9])?|\[[0-9a-f:.]+\]")
_ORIGIN = re.compile(r"\*|https?://([a-z0-9]([a-z0-9.-]*[a-z0-9])?|\[[0-9a-f:.]+\])(:\d{1,5})?")
_HEAD = re.compile(r"([A-Za-z0-9.-]+|\[[0-9A-Fa-f:.]+\]):\d{1,5}")
_ENDPOINT = re.compile(r"https?://[A-Za-z0-9.\[\]:-]+(/[\x21-\x7e]*)?")
_LISTS = {
    "trusted_hosts": (_HOST, "lab.example.org or *.example.org, without a port"),
    "allowed_origins": (_ORIGIN, "https://lab.example.org, without a path"),
    "frame_ancestors": (_ORIGIN, "https://lab.example.org, without a path"),
    "trusted_proxies": (re.compile(r"\*|[0-9a-f:.]+(/\d{1,3})?"), "10.0.0.5 or 10.0.0.0/8"),
}
"""Settings with several values: what each must be, and an example."""
_TEXTS = {
    "api_keys": (re.compile(".*", re.DOTALL), ""),
    "root_path": (re.compile("(/.*)?", re.DOTALL), "must start with a slash, such as /gelenk"),
    "course_secret": (re.compile(r"[\x20-\x7e]{16,256}"), "must have 16 to 256 printable ASCII characters"),
    "open_access": (re.compile("yes|no"), "must be yes or no"),
    "log_level": (re.compile("|".join(LEVELS)), f"must be one of {', '.join(LEVELS)}"),
    "ray_lost": (re.compile("wait|local"), "must be one of wait, local"),
    "otlp_endpoint": (_ENDPOINT, "must be a URL such as http://127.0.0.1:4318"),
    "ray_address": (_HEAD, "must be the host and the port of a cluster's head, such as 10.0.0.5:6379"),
}
"""Settings with one value that is neither a folder nor a number: what it must be, in two ways."""


def _parse(variable: str, name: str, text: str) -> _Value:
    if not text and name != "root_path":
        raise InvalidSetting(f"{variable} is empty: leave it out for the default")
    if name.endswith("_dir"):
        return Path(text).expanduser()
    if name in _LISTS:
        return _parse_list(variable, text, *_LISTS[name])
    if name in _TEXTS:
        pattern, rule = _TEXTS[name]
        if not pattern.fullmatch(text):
            raise InvalidSetting(f"{variable} {rule}")
        return text == "yes" if name == "open_access" else text.rstrip("/") if name == "root_path" else text
    if not text.isdecimal() or int(text) == 0:
        raise InvalidSetting(f"{variable} must be a whole number greater than zero; it is {text!r}")
    return int(text)


def _parse_list(variable: str, text: str, allowed: re.Pattern[str], example: str) -> tuple[str, ...]:
    words = tuple(text.lower().replace(",", " ").split())
    for word in words:
        if not allowed.fullmatch(word):
            raise InvalidSetting(f"{variable} lists values such as {example}; {word[:80]!r} is none")
    return words
