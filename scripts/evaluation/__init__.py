# SPDX-License-Identifier: BSD-3-Clause
"""Comparison of trajectories: reading, metrics and plots; see ../evaluate.py."""
