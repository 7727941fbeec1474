# SPDX-License-Identifier: BSD-3-Clause
"""Parts of kalibr_to_config.py that read Kalibr's files."""
