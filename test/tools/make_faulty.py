#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes a faulty copy of a recording: of a bag, an ASL folder or a feature file."""

import argparse
import os
import sys

from stress.faults import FAULTS


def parse_arguments(arguments):
    faults = "\n".join(f"  {name:18} {fault.what}" for name, fault in FAULTS.items())
    parser = argparse.ArgumentParser(description=__doc__, epilog="faults:\n" + faults,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("source", help="a .bag, an ASL folder, or a file of --save-features")
    parser.add_argument("target", help="the same kind, with the fault; a file is overwritten,"
                        " a folder must be new or empty")
    parser.add_argument("--fault", required=True, choices=FAULTS, metavar="NAME")
    parser.add_argument("--begin", type=float, default=24.0, metavar="S",
                        help="begin of the fault after the first image [s] (default: 24)")
    return parser.parse_args(arguments)


def adapter_of(source):
    """Returns the module that can make `source` faulty."""
    if os.path.isdir(source):
        from stress import asl_folder
        return asl_folder
    if source.endswith(".bag"):
        from stress import bag  # needs ROS, the others do not
        return bag
    from stress import feature_file
    return feature_file


def main(arguments=None):
    options = parse_arguments(arguments)
    fault = FAULTS[options.fault]
    try:
        adapter = adapter_of(options.source)
        if os.path.exists(options.target) and os.path.samefile(options.source, options.target):
            raise ValueError("source and target are the same file")
        if fault.needs_features and not adapter.__name__.endswith("feature_file"):
            raise ValueError(f"{options.fault} needs a file of --save-features as its source")
        adapter.make_faulty(options.source, options.target, fault.apply, options.begin)
    except (OSError, ValueError, ImportError) as error:
        print(f"make_faulty.py: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
