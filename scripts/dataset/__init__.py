# SPDX-License-Identifier: BSD-3-Clause
"""Finds recordings, runs the odometry over them and compares the results; see ../run_dataset.py."""
