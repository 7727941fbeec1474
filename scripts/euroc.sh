#!/usr/bin/env bash
# Downloads EuRoC, runs all variants on it and writes a report next to the figures of the paper.
# Usage: euroc.sh [--data DIR] [--output DIR] [--archives FILE] [--download-only] [SEQUENCE ...]
#   SEQUENCE         such as MH_01_easy (default: all eleven); of TUM VI: room1 to room6
#   --data DIR       where archives are, or are downloaded to (default: output/euroc/data)
#   --output DIR     where results go (default: output/euroc)
#   --archives FILE  another table of archives (default: scripts/dataset/archives.txt), as of a mirror
#   --download-only  runs nothing
# The same command again resumes an interrupted run.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
# shellcheck source=scripts/usage.sh
source "$root/scripts/usage.sh"

fail() {
  echo "euroc.sh: $*" >&2
  exit 1
}

output="$root/output/euroc" data='' archives="$root/scripts/dataset/archives.txt" run=true
sequences=()
while (($#)); do
  case "$1" in
    --data | --output | --archives) (($# > 1)) || fail "$1 needs a value" ;;&
    --data) data="$2"; shift ;;
    --output) output="$2"; shift ;;
    --archives) archives="$2"; shift ;;
    --download-only) run=false ;;
    -*) fail "unknown option $1; euroc.sh --help lists them" ;;
    *) sequences+=("$1") ;;
  esac
  shift
done
data="${data:-$output/data}"
if ((!${#sequences[@]})); then
  sequences=(MH_01_easy MH_02_easy MH_03_medium MH_04_difficult MH_05_difficult V1_01_easy
    V1_02_medium V1_03_difficult V2_01_easy V2_02_medium V2_03_difficult)
fi
[[ -f "$archives" ]] || fail "$archives: no such table of archives"
mkdir -p "$data" "$output"

# archive_of SEQUENCE: prints MD5 sum, URL and file name of the archive that contains it.
archive_of() {
  local pattern md5 url name
  while read -r pattern md5 url name; do
    # shellcheck disable=SC2053
    if [[ "$pattern" != \#* && "$1" == $pattern ]]; then
      echo "$md5 $url $name"
      return
    fi
  done <"$archives"
  fail "$1: no such sequence in $archives"
}

folder_of() { echo "$data/$1"; }

# The server of EuRoC rejects curl's default user agent.
fetch() { curl --fail --silent --show-error --location --user-agent plm_vins/1.0 "$@"; }

remote_size() {
  fetch --head "$1" | tr -d '\r' | awk 'tolower($1) == "content-length:" {size = $2} END {print size + 0}'
}

# Resumes a partial download and verifies the MD5 sum.
download() {
  local md5="$1" url="$2" file="$3" complete=true
  [[ ! -f "$file" ]] || return 0
  [[ "$md5" != - ]] || md5="$(fetch "$url.md5" | awk '{print $1}')" || fail "$url.md5: cannot be read"
  echo "== Download $url"
  curl --fail --location --user-agent plm_vins/1.0 --retry 5 --continue-at - --progress-bar \
    --output "$file.part" "$url" || complete=false  # also if nothing was left to download
  if [[ "$(md5sum "$file.part" | awk '{print $1}')" != "$md5" ]]; then
    [[ "$complete" == true ]] ||
      fail "$url: the download was interrupted; run the same command again to resume it"
    rm "$file.part"
    fail "$file: the MD5 sum is wrong, so it was deleted; run the same command again"
  fi
  mv "$file.part" "$file"
}

# unpack SEQUENCE ARCHIVE: unpacks into the sequence's folder, which gets its name once complete.
# EuRoC's archives contain one zip for each sequence.
unpack() {
  local folder part inner
  folder="$(folder_of "$1")"
  part="$folder.part"
  rm -rf "$part"
  mkdir -p "$part"
  case "$2" in
    *.tar) tar -xf "$2" -C "$part" --strip-components 1 || fail "$2: damaged; delete it" ;;
    */"$1.zip") unzip -q "$2" -d "$part" || fail "$2: damaged; delete it" ;;
    *)
      inner="$part/$1.zip"
      unzip -p "$2" "*/$1.zip" >"$inner" || fail "$2: holds no $1.zip, or is damaged"
      unzip -q "$inner" -d "$part" || fail "$2: its $1.zip is damaged"
      rm "$inner"
      ;;
  esac
  [[ -d "$part/mav0" ]] || fail "$2: holds no mav0/ of $1"
  mv "$part" "$folder"
}

# Missing sequences: neither unpacked nor present as an archive.
declare -A missing=()
total=0
for sequence in "${sequences[@]}"; do
  entry="$(archive_of "$sequence")"
  read -r _ url name <<<"$entry"
  if [[ -d "$(folder_of "$sequence")" || -f "$data/$sequence.zip" || -f "$data/$name" ||
    -n "${missing[$name]:-}" ]]; then
    continue
  fi
  size="$(remote_size "$url")" || fail "$url: cannot be reached; put $name or $sequence.zip into $data"
  missing[$name]="$entry"
  total=$((total + size))
done
if ((${#missing[@]})); then
  echo "To download: ${!missing[*]}, $((total / 1000000)) MB, into $data; free there:" \
    "$(df -Pm "$data" | awk 'END {print $4}') MB"
fi

for sequence in "${sequences[@]}"; do
  [[ ! -d "$(folder_of "$sequence")" ]] || continue
  entry="$(archive_of "$sequence")"
  read -r md5 url name <<<"$entry"
  archive="$data/$sequence.zip"
  if [[ ! -f "$archive" ]]; then
    archive="$data/$name"
    download "$md5" "$url" "$archive"
  fi
  echo "== Unpack $sequence"
  unpack "$sequence" "$archive"
done
[[ "$run" == true ]] || exit 0

# evaluate NAME OPTION...: writes a separate report on the sequences of one camera.
evaluate() {
  local report="$1"
  shift
  echo "== Run: $report"
  "$root/scripts/run_dataset.py" "${folders[@]}" --output "$output/$report" "$@"
}

TARGETS="run_offline" "$root/scripts/build.sh" -DBUILD_TESTING=OFF
for dataset in euroc tum_vi; do
  folders=()
  for sequence in "${sequences[@]}"; do
    [[ "$sequence" == room* ]] && of=tum_vi || of=euroc
    [[ "$of" != "$dataset" ]] || folders+=("$(folder_of "$sequence")")
  done
  ((${#folders[@]})) || continue
  evaluate "$dataset" --config "$root/config/$dataset.yaml"
  evaluate "${dataset}_loops" --config "$root/config/$dataset.yaml" --variants anchors \
    --set loop_closure=1
  if [[ -f "$root/config/${dataset}_stereo.yaml" ]]; then
    evaluate "${dataset}_stereo" --config "$root/config/${dataset}_stereo.yaml" --variants anchors
  fi
done
echo "Reports: $output/*/report.md"
