#!/usr/bin/env bash
# Installs missing packages, builds, runs the odometry on a recording and shows the result.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
programs="$root/build/devel/lib/plm_vins"

usage() {
  cat <<EOF
Usage: demo.sh [--bag FILE | --asl DIR] [--config FILE] [--groundtruth FILE] [--output DIR] [--rviz]
  --bag FILE          a ROS bag with the config's image and IMU topics
  --asl DIR           an EuRoC ASL folder (the one with mav0/ inside)
                      without either: a simulated recording, made once
  --config FILE       camera, IMU and options of the recording (default: config/euroc.yaml)
  --groundtruth FILE  TUM file, EuRoC csv or ASL folder to compare with (default: FILE.tum beside
                      FILE.bag, or the one in the ASL folder)
  --output DIR        where results go (default: output/demo)
  --rviz              run the nodes, rosbag play and rviz instead of the offline runner
EOF
}

fail() {
  echo "demo.sh: $*" >&2
  exit 1
}

bag='' asl='' config='' truth='' output="$root/output/demo" rviz=false
while (($#)); do
  case "$1" in
    --rviz) rviz=true; shift; continue ;;
    -h | --help) usage; exit 0 ;;
    --bag | --asl | --config | --groundtruth | --output) (($# > 1)) || fail "$1 needs a value" ;;
    *) usage >&2; fail "unknown option $1" ;;
  esac
  case "$1" in
    --bag) bag="$2" ;;
    --asl) asl="$2" ;;
    --config) config="$2" ;;
    --groundtruth) truth="$2" ;;
    --output) output="$2" ;;
  esac
  shift 2
done
[[ -z "$bag" || -z "$asl" ]] || fail "give either --bag or --asl"
[[ -z "$bag" || -f "$bag" ]] || fail "$bag: no such bag"
[[ -z "$asl" || -d "$asl" ]] || fail "$asl: no such folder"
[[ -z "$truth" || -e "$truth" ]] || fail "$truth: no such ground truth"
[[ "$rviz" == false || -z "$asl" ]] || fail "--rviz plays bags, not ASL folders"
[[ "$rviz" == false || -z "$truth" ]] || fail "--rviz makes no comparison; drop --groundtruth"
if [[ -n "$config" && -z "$bag$asl" ]]; then
  fail "--config needs --bag or --asl: the simulated recording is of config/euroc.yaml" \
    "(simulate --config FILE --output NEW.bag makes one of your sensors)"
fi
config="${config:-$root/config/euroc.yaml}"
[[ -f "$config" ]] || fail "$config: no such config"

# Makes a recording of 30 s with ground truth. It is complete once the folder has its final name.
simulate() {
  local folder="$root/output/simulated"
  if [[ ! -d "$folder" ]]; then
    echo "== Simulate a recording"
    rm -rf "$folder.part"
    mkdir -p "$folder.part"
    "$programs/simulate" --config "$root/config/euroc.yaml" --duration 30 --seed 1 \
      --output "$folder.part/demo.bag"
    mv "$folder.part" "$folder"
  fi
  bag="$folder/demo.bag"
}

run_online() {
  mkdir -p "$output"
  set +u  # ROS's script reads unset variables
  # shellcheck disable=SC1091
  source "$root/build/devel/setup.bash"
  set -u
  roslaunch plm_vins euroc.launch config:="$(realpath "$config")" bag:="$(realpath "$bag")" \
    output:="$(realpath "$output")" rviz:=true
}

find_truth() {
  if [[ -n "$truth" ]]; then
    echo "$truth"
  elif [[ -n "$asl" ]]; then
    find -H "$asl" -path '*/state_groundtruth_estimate0/data.csv' -print -quit
  elif [[ -f "${bag%.bag}.tum" ]]; then
    echo "${bag%.bag}.tum"
  fi
}

run_offline() {
  local input=(--bag "$bag")
  if [[ -n "$asl" ]]; then
    input=(--asl "$asl")
  fi
  truth="$(find_truth)"
  mkdir -p "$output"
  rm -f "$output/evaluation.json"
  echo "== Run offline"
  "$programs/run_offline" --config "$config" "${input[@]}" --output "$output"
  if [[ -n "$truth" ]]; then
    echo "== Compare with the ground truth"
    "$root/scripts/evaluate.py" "$output/trajectory.tum" "$truth" --plots "$output/plots" \
      --json "$output/evaluation.json" || echo "not comparable, see above"
  fi
  echo "== Result"
  "$root/scripts/show_result.py" "$output"
}

echo "== Set up and build"
"$root/scripts/setup.sh"
targets='run_offline simulate'
if [[ "$rviz" == true ]]; then
  targets=all
fi
TARGETS="$targets" "$root/scripts/build.sh" -DBUILD_TESTING=OFF
if [[ -z "$bag" && -z "$asl" ]]; then
  simulate
fi
if [[ "$rviz" == true ]]; then
  run_online
else
  run_offline
fi
