#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks the rules in CONTRIBUTING.md that a script can check: layers, ROS, sizes, headers, paths
and links.

Usage: check_structure.py [ROOT]. Prints one line per problem; exit code 1 if there are any.
"""

import ast
import json
import pathlib
import re
import shutil
import subprocess
import sys

# The layers of each part, from bottom to top, each with the layers of its part that it may include
# besides itself; these must precede it. Files outside the folders of a part are above its layers,
# and ros/ is above those.
COMMON_LAYERS = {
    "append.h": "",
    "format.h": "",
    "finding.h": "format.h",
    "measurements.h": "",
    "statistics.h": "",
    "recent_time.h": "",
    "stopwatch.h": "",
    "geometry": "",
    "camera": "",
    "streams": "format.h measurements.h statistics.h",
    "imu": "format.h measurements.h statistics.h streams",
    "features": "measurements.h",
    "io": "format.h measurements.h",
    "config": "format.h measurements.h geometry camera imu",
}
TRACKING_LAYERS = {
    "images": "",
    "stereo": "images",
}
POINT_TRACKER_LAYERS = {
    "detection": "",
    "following": "",
    "stereo": "detection following",
}
LINE_TRACKER_LAYERS = {
    "segments": "",
    "detection": "segments",
    "following": "segments",
    "stereo": "segments following",
}
ESTIMATOR_LAYERS = {
    "state": "",
    "failure": "state",
    "geometry": "state",
    "imu": "state",
    "input": "imu",
    "map": "state geometry imu",
    "factors": "state geometry imu",
    "monitoring": "state imu map factors",
    "bridging": "state imu factors",
    "equations": "state geometry factors",
    "solver": "factors equations",
    "problem": "state geometry imu map factors equations",
    "uncertainty": "state geometry imu monitoring map factors equations problem",
    "marginalization": "state map equations problem",
    "manhattan": "state geometry map",
    "recall": "state geometry map",
    "merging": "state geometry map manhattan recall",
    "structure_from_motion": "state geometry",
    "rotation_calibration": "imu structure_from_motion",
    "initialization": "state geometry imu factors equations solver uncertainty "
                      "structure_from_motion rotation_calibration",
    "lengths": "state imu structure_from_motion initialization",
    "output": "state",
}
POSE_GRAPH_LAYERS = {
    "geometry": "",
    "description": "",
    "keyframes": "geometry description",
    "retrieval": "description keyframes",
    "graph": "geometry",
    "verification": "geometry keyframes graph",
    "map": "geometry keyframes graph verification",
    "output": "keyframes verification map",
}
OFFLINE_LAYERS = {
    "recordings": "",
    "pipeline": "recordings",
    "results": "pipeline",
}


def inside(part, layers):
    return {f"{part}/{layer}" for layer in layers}


def layers_of_part(part, folders, others=frozenset()):
    """Returns the layers of a part with everything that each may include; `others` are layers of
    other parts."""
    layers = {}
    for layer, below in folders.items():
        below = inside(part, below.split())
        assert below <= set(layers), f"{part}/{layer} may include only what is listed before it"
        layers[f"{part}/{layer}"] = below | others
    return {**layers, part: set(layers) | others,
            f"{part}/ros": {part, *layers} | others | ROS_EDGE}


ROS_EDGE = {"common/ros", "tracking/ros"}
COMMON = {"common"} | inside("common", COMMON_LAYERS)
TRACKING = COMMON | {"tracking"} | inside("tracking", TRACKING_LAYERS)
TRACKERS = {"feature_tracker", "linefeature_tracker"}
ESTIMATOR_OUTPUT = inside("vins_estimator", ["state", "output"])

# Everything that each layer (a folder or a file) may include besides itself; the longest match
# applies. Tests may include anything, also ROS.
LAYERS = {
    **layers_of_part("common", COMMON_LAYERS),
    **layers_of_part("tracking", TRACKING_LAYERS, COMMON),
    **layers_of_part("feature_tracker", POINT_TRACKER_LAYERS, TRACKING),
    **layers_of_part("linefeature_tracker", LINE_TRACKER_LAYERS, TRACKING),
    **layers_of_part("vins_estimator", ESTIMATOR_LAYERS, COMMON),
    "vins_estimator": COMMON | inside("vins_estimator", set(ESTIMATOR_LAYERS) - {"output"}),
    "vins_estimator/ros": COMMON | ROS_EDGE | {"vins_estimator"} | ESTIMATOR_OUTPUT | inside(
        "vins_estimator", ["imu", "input"]),
    **layers_of_part("pose_graph", POSE_GRAPH_LAYERS, COMMON),
    **layers_of_part("map_bundle", {}, COMMON | {"pose_graph"} | inside(
        "pose_graph", ["geometry", "keyframes", "map", "verification"]) | inside(
            "vins_estimator", ["state", "geometry", "imu", "factors", "equations",
                               "solver"])),
    **layers_of_part("offline", OFFLINE_LAYERS,
                     TRACKING | TRACKERS | ESTIMATOR_OUTPUT
                     | {"vins_estimator", "pose_graph", "map_bundle"}
                     | inside("pose_graph", POSE_GRAPH_LAYERS)),
    **layers_of_part("mavros_relay", {}, COMMON),
    **layers_of_part("simulator", {}, COMMON | ESTIMATOR_OUTPUT),
}
# Parts that must not depend on Ceres, directly or indirectly, since they only use the estimator's
# results.
WITHOUT_CERES = ["common", "tracking", "feature_tracker", "linefeature_tracker",
                 "vins_estimator/state", "vins_estimator/map", "vins_estimator/output",
                 "vins_estimator/ros", "offline", "mavros_relay", "simulator"]
CODE_FOLDERS = sorted({folder.split("/")[0] for folder in LAYERS} | {"test"})
TEXT_FOLDERS = CODE_FOLDERS + [".ci", "cmake", "config", "docs", "launch", "scripts"]
TEXT_SUFFIXES = {".cpp", ".h", ".py", ".sh", ".txt", ".cmake", ".md", ".yaml", ".launch", ".test",
                 ".rviz", ".xml", ""}

ROS_INCLUDE = re.compile(
    r'#include\s*[<"](ros|rosbag|cv_bridge|image_transport|diagnostic_updater|nodelet|pluginlib'
    r'|message_filters|tf2\w*|tf|std_srvs|\w+_msgs)/')
INCLUDE = re.compile(r'^#include\s*"([^"]+)"', re.MULTILINE)
CERES_INCLUDE = re.compile(r"^#include\s*<ceres/", re.MULTILINE)
# "somebody" stands for a user in examples.
HOME_PATH = re.compile(r"(?<![\w./~$}{-])/(home|root|work|Users)/(?!somebody/)\w")
NAMESPACE = re.compile(r"^namespace ([\w:]+) {", re.MULTILINE)
TYPE = re.compile(r"^(?:class|struct|enum class) (\w+)(?: final)?(?: :[^;{]*)? {", re.MULTILINE)
LINK = re.compile(r"\]\((?!https?:)([^)#\s]*)(?:#([^)\s]+))?\)")
SPDX = "// SPDX-License-Identifier: BSD-3-Clause"
MAX_FILE_LINES = 400
MAX_FUNCTION_LINES = 60
MAX_COLUMNS = 100
OLDEST_PYTHON = (3, 8)
# Names that Ubuntu 20.04 lacks, by kind of file: Eigen 3.3, the library of GCC 9 (floating-point
# from_chars, parallel algorithms), CMake 3.16, the library of Python 3.8.
NEWER_NAMES = {
    ".h .cpp": r"Eigen::(Row)?Vector[X2-4]?<|Eigen::(all|last|lastN|seq|seqN)\b|\.reshaped\("
               r"|\bstd::(chars_format|execution)\b",
    ".cmake .txt": r"\b(block|cmake_language|cmake_path)\("
                   r"|\bfile\((ARCHIVE_|CHMOD|COPY_FILE|REAL_PATH)|\bstring\(JSON"
                   r"|\bfind_(file|library|path|program)\([^)]*REQUIRED"
                   r"|\b(CMAKE_CURRENT_FUNCTION|PROJECT_IS_TOP_LEVEL)"
                   r"|\b(COMMAND_ERROR_IS_FATAL|ENVIRONMENT_MODIFICATION|FILE_SET|ZIP_LISTS)\b",
    ".py": r"\.(removeprefix|removesuffix|is_relative_to|with_stem|bit_count|randbytes)\("
           r"|\bfunctools\.cache\b|\bitertools\.pairwise\b|\bmath\.(lcm|nextafter|ulp)\b"
           r"|\bBooleanOptionalAction\b|\b(dict|list|set|tuple)\[|\bzip\(.*\bstrict=",
}
NEWER_NAMES = {suffix: re.compile(names) for suffixes, names in NEWER_NAMES.items()
               for suffix in suffixes.split()}


def main(root):
    problems = [problem for path in code_files(root) for problem in check_code(root, path)]
    problems += [problem for path in text_files(root) for problem in check_paths(root, path)]
    problems += [problem for path in text_files(root) if path.suffix == ".py"
                 for problem in (*check_columns(root, path), *check_python(root, path))]
    problems += [problem for path in text_files(root) for problem in check_names(root, path)]
    problems += [problem for path in text_files(root) if path.suffix == ".md"
                 for problem in check_links(root, path)]
    problems += check_circles(root)
    problems += check_ceres(root)
    problems += check_types(root)
    problems += check_functions(root)
    print(*problems, sep="\n", end="\n" if problems else "")
    print(f"{len(code_files(root))} source files, {len(problems)} problems")
    return 1 if problems else 0


def code_files(root):
    return files_below(root, CODE_FOLDERS, {".h", ".cpp"})


def text_files(root):
    top = sorted(path for path in root.iterdir()
                 if path.is_file() and path.suffix in TEXT_SUFFIXES and path.name[0] != ".")
    return top + files_below(root, TEXT_FOLDERS, TEXT_SUFFIXES)


def files_below(root, folders, suffixes):
    return sorted(path for folder in folders for path in (root / folder).rglob("*")
                  if path.is_file() and path.suffix in suffixes and "__pycache__" not in path.parts)


def check_code(root, path):
    name = path.relative_to(root)
    lines = path.read_text(encoding="utf-8").splitlines()
    if not lines or lines[0] != SPDX:
        yield f"{name}:1: the first line is not '{SPDX}'"
    if len(lines) > MAX_FILE_LINES:
        yield f"{name}: {len(lines)} lines, at most {MAX_FILE_LINES}"
    for number, line in enumerate(lines, start=1):
        if ROS_INCLUDE.match(line) and "ros" not in name.parts[:-1] and layer_of(name):
            yield f"{name}:{number}: ROS outside of a folder named ros/"
        if path.suffix == ".h" and line.lstrip().startswith("using namespace"):
            yield f"{name}:{number}: 'using namespace' in a header"
        include = INCLUDE.match(line)
        if include and not may_include(name, include.group(1)):
            yield f"{name}:{number}: this layer must not know {include.group(1)}"


def layer_of(name):
    """Returns the layer of a file, or None if it belongs to no layer."""
    layers = [layer for layer in LAYERS if is_inside(name, layer)]
    return max(layers, key=len) if layers else None


def is_inside(name, folder):
    """Returns whether the file is in the folder; `folder` may also be the file itself."""
    path = pathlib.PurePath(name)
    return pathlib.PurePath(folder) in (path, *path.parents)


def may_include(name, included):
    layer, target = layer_of(name), layer_of(included)
    if layer is None:
        return True  # a test
    if target is None:
        return included.split("/")[0] not in CODE_FOLDERS  # a library, but no test
    return target == layer or target in LAYERS[layer]


def check_circles(root):
    """Yields pairs of folders that include each other; a folder and its parent are such a pair."""
    includes = {}  # by pair of folders: an example
    for path in code_files(root):
        name = path.relative_to(root)
        for included in INCLUDE.findall(path.read_text(encoding="utf-8")):
            if layer_of(name) and layer_of(included):
                folders = str(name.parent), str(pathlib.PurePath(included).parent)
                includes.setdefault(folders, f"{name} {included}")
    for (folder, target), example in sorted(includes.items()):
        if folder < target and (target, folder) in includes:
            yield f"{folder} and {target} include each other: {example}; {includes[target, folder]}"


def check_ceres(root):
    """Yields files in WITHOUT_CERES that include Ceres, directly or indirectly."""
    for path in code_files(root):
        name = path.relative_to(root)
        if any(is_inside(name, folder) for folder in WITHOUT_CERES):
            way = way_to_ceres(root, name, set())
            if way:
                yield f"{name}: includes Ceres by way of {' '.join(way)}"


def way_to_ceres(root, name, seen):
    """Returns the chain of includes from a file to Ceres, or None."""
    seen.add(str(name))
    text = (root / name).read_text(encoding="utf-8") if (root / name).is_file() else ""
    if CERES_INCLUDE.search(text):
        return [str(name)]
    for included in INCLUDE.findall(text):
        way = way_to_ceres(root, included, seen) if included not in seen else None
        if way:
            return [str(name)] + way
    return None


def check_paths(root, path):
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1):
        if HOME_PATH.search(line):
            yield f"{path.relative_to(root)}:{number}: absolute path of one machine"


def check_columns(root, path):
    """Checks Python only; clang-format checks the columns of C++."""
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1):
        if len(line) > MAX_COLUMNS:
            yield f"{path.relative_to(root)}:{number}: {len(line)} columns, at most {MAX_COLUMNS}"


def check_python(root, path):
    """Syntax that the Python of ROS Noetic does not know."""
    try:
        ast.parse(path.read_text(encoding="utf-8"), feature_version=OLDEST_PYTHON)
    except SyntaxError as error:
        yield f"{path.relative_to(root)}:{error.lineno}: {error.msg} (Python 3.8)"


def check_names(root, path):
    """Yields names that the libraries and tools of Ubuntu 20.04 do not know."""
    newer = NEWER_NAMES.get(path.suffix)
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1):
        found = newer and newer.search(line)
        if found:
            yield f"{path.relative_to(root)}:{number}: {found.group()} is newer than Ubuntu 20.04"


def check_links(root, path):
    """Yields broken links of a page to files and headings of this repository."""
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1):
        for file, anchor in LINK.findall(line):
            target = path.parent / file if file else path
            if not target.exists():
                yield f"{path.relative_to(root)}:{number}: no such file {file}"
            elif anchor and anchor not in headings(target):
                yield f"{path.relative_to(root)}:{number}: no such heading {file}#{anchor}"


def headings(page):
    """Returns the anchors of a Markdown page's headings."""
    titles = re.findall(r"^#+ (.+)$", page.read_text(encoding="utf-8"), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}


def check_types(root):
    """Yields types with the same name in two headers, which the linker would confuse."""
    homes = {}  # by qualified name: the header
    for path in code_files(root):
        name = path.relative_to(root)
        if path.suffix != ".h" or not layer_of(name):
            continue  # tests are separate programs
        text = path.read_text(encoding="utf-8")
        space = NAMESPACE.search(text)
        for defined in sorted(set(TYPE.findall(text))):
            home = homes.setdefault((space and space.group(1), defined), name)
            if home != name:
                yield f"{name}: {defined} is defined in {home}, too"


def check_functions(root):
    """Checks function lengths by universal-ctags; skipped if it is not installed."""
    ctags, files = find_ctags(), code_files(root)
    if ctags is None or not files:
        return []
    output = run(ctags, "--languages=C++", "--kinds-C++=f", "--fields=+ne", "--output-format=json",
                 "-f", "-", *map(str, files))
    tags = [json.loads(line) for line in output.splitlines() if line.startswith("{")]
    problems = []
    for tag in tags:
        length = tag.get("end", tag["line"]) - tag["line"] + 1
        if length > MAX_FUNCTION_LINES:
            name = pathlib.Path(tag["path"]).relative_to(root)
            problems.append(f"{name}:{tag['line']}: {tag['name']}() has {length} lines,"
                            f" at most {MAX_FUNCTION_LINES}")
    return problems


def find_ctags():
    """Returns the path of ctags if it is Universal Ctags, which reports the ends of functions."""
    ctags = shutil.which("ctags")
    return ctags if ctags and "Universal Ctags" in run(ctags, "--version") else None


def run(*command):
    return subprocess.run(command, stdout=subprocess.PIPE, encoding="utf-8", check=True).stdout


if __name__ == "__main__":
    default = pathlib.Path(__file__).resolve().parent.parent
    sys.exit(main(pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else default))
