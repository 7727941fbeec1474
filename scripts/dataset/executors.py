# SPDX-License-Identifier: BSD-3-Clause
"""Where runs are carried out: in threads of this program, or by the workers of a Dask cluster. Each
is a concurrent.futures.Executor, whose thread waits for a process of its own."""

import concurrent.futures
import contextlib

from .errors import DatasetError

CONNECT_TIMEOUT = 10  # [s]


@contextlib.contextmanager
def open_executor(scheduler, jobs):
    """An executor, and where it works, in words. `scheduler`: address of a Dask scheduler, or None
    for this machine, which then carries out `jobs` runs at a time."""
    if scheduler is None:
        with concurrent.futures.ThreadPoolExecutor(jobs) as executor:
            yield executor, f"{jobs} at a time"
    else:
        with _connect(scheduler) as client:
            workers = len(client.scheduler_info()["workers"])
            # Not pure: the same run may be wanted again. A run whose worker dies goes to another.
            yield client.get_executor(pure=False), f"by {workers} workers of {scheduler}"


def _connect(scheduler):
    try:
        import distributed  # takes a second to load, and only here
    except ImportError:
        raise DatasetError("--scheduler needs Dask: install python3-distributed") from None
    try:
        return distributed.Client(scheduler, timeout=CONNECT_TIMEOUT)
    except (OSError, ValueError) as error:
        raise DatasetError(f"--scheduler {scheduler}: no Dask scheduler there ({error})") from None
