# SPDX-License-Identifier: BSD-3-Clause
"""Makes faulty copies of recordings and measures their effect on the odometry."""
