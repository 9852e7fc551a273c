"""Imports the jobs of earlier versions, which kept each in a file `job.json` of its folder."""

from contextlib import suppress
from dataclasses import replace
from pathlib import Path

import orjson

from gelenk.jobs.database import NAMED, Database
from gelenk.jobs.job import JobRecord
from gelenk.store import folders

_FILE = "job.json"


def import_earlier(root: Path, database: Database) -> None:
    """Move the jobs below a folder into the table; requests, parts and results stay where they are."""
    jobs = [job for path in root.glob(f"*/{_FILE}") if (job := _read(path)) is not None]
    if jobs:
        with database.transaction():
            for job in sorted(jobs, key=lambda job: (job.number, job.created)):
                if not database.read(NAMED, job.id):  # else its file was to be removed, and the machine stopped
                    database.put(replace(job, number=0))
    for job in jobs:
        folders.sweep(root / job.id)
        folders.discard(root / job.id / _FILE)


def _read(path: Path) -> JobRecord | None:
    """Return the job of a file; None if it has none."""
    with suppress(OSError, ValueError, TypeError, KeyError):
        row = orjson.loads(folders.read_plain(path))
        job = JobRecord.from_row({**row, "failure": row["failure"] and orjson.dumps(row["failure"])})
        return job if job.id == path.parent.name else None
    return None
