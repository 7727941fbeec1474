# SPDX-License-Identifier: BSD-3-Clause
"""Faulty recordings made of good ones, and what they do to the odometry."""
