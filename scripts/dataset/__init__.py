# SPDX-License-Identifier: BSD-3-Clause
"""The odometry over many recordings: finding them, running, comparing; see ../run_dataset.py."""
