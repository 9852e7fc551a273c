"""Import of jobs from earlier versions, which kept the record of each job in a file `job.json` in its folder."""

from contextlib import suppress
from dataclasses import replace
from pathlib import Path

import orjson

from gelenk.jobs.database import NAMED, Database
from gelenk.jobs.job import JobRecord
from gelenk.store import folders

_FILE = "job.json"


def import_earlier(root: Path, database: Database) -> None:
    """Move the records of the jobs below a folder into the table; requests, parts and results stay where they are."""
    jobs = [job for path in root.glob(f"*/{_FILE}") if (job := _read(path)) is not None]
    if jobs:
        with database.transaction():
            for job in sorted(jobs, key=lambda job: (job.number, job.created)):
                if not database.read(NAMED, job.id):  # else an earlier import ended before it removed the file
                    database.put(replace(job, number=0))
    for job in jobs:
        folders.sweep(root / job.id)
        folders.discard(root / job.id / _FILE)


def _read(path: Path) -> JobRecord | None:
    with suppress(OSError, ValueError, TypeError, KeyError):
        row = orjson.loads(folders.read_plain(path))
        job = JobRecord.from_row({**row, "failure": row["failure"] and orjson.dumps(row["failure"])})
        return job if job.id == path.parent.name else None
    return None
