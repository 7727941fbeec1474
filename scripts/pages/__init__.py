# SPDX-License-Identifier: BSD-3-Clause
"""HTML pages on results, for any browser, without a network; see ../show_run.py."""
