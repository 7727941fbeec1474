# SPDX-License-Identifier: BSD-3-Clause
"""Executors of runs: threads of this program, or the workers of a Dask cluster. Both are
concurrent.futures.Executor; each of their threads waits for a separate process."""

import concurrent.futures
import contextlib

from .errors import DatasetError

CONNECT_TIMEOUT = 10  # [s]


@contextlib.contextmanager
def open_executor(scheduler, jobs):
    """Yields an executor and a description of it. `scheduler` is the address of a Dask scheduler,
    or None for this machine, which then executes `jobs` runs at a time."""
    if scheduler is None:
        with concurrent.futures.ThreadPoolExecutor(jobs) as executor:
            yield executor, f"{jobs} at a time"
    else:
        with _connect(scheduler) as client:
            workers = len(client.scheduler_info()["workers"])
            # Not pure, since a run may be repeated. If a worker dies, its run is given to another.
            yield client.get_executor(pure=False), f"by {workers} workers of {scheduler}"


def _connect(scheduler):
    try:
        import distributed  # only here, since loading takes a second
    except ImportError:
        raise DatasetError("--scheduler needs Dask: install python3-distributed") from None
    try:
        return distributed.Client(scheduler, timeout=CONNECT_TIMEOUT)
    except (OSError, ValueError) as error:
        raise DatasetError(f"--scheduler {scheduler}: no Dask scheduler there ({error})") from None
