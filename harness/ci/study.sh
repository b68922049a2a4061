#!/usr/bin/env bash
# Runs a study of one's own engine among others, and writes what a commit is to be told: what got better and worse since
# a baseline, and the scorecard. Both CI files beside it call it; it needs nothing of either.
set -euo pipefail

usage() {
  cat <<'TEXT'
usage: study.sh --out DIR [--baseline DIR] [--study STUDY] [--backend NAME|FILE]... [--budget TIME]
                [--times]

  --out DIR        results, and in it comment.md and report.html; what is finished there is not run again
  --baseline DIR   earlier results; without any rows in it, or not given, there is nothing to compare with
  --study STUDY    a preset (quick) or a study file
  --backend B      the engines, repeatable; none: all that load
  --budget TIME    90s, 20min: what is left then is left out
  --times          times count, too: for a machine that nobody else uses

PLUMB names the program (plumb). The exit status is that of the report: 1 where something got worse, 2 where the question
was wrong.
TEXT
}

refuse() {
  echo "study.sh: $1" >&2
  exit 2
}

plumb="${PLUMB:-plumb}"
most_bytes=60000 # of a comment: GitHub takes 65,536 characters
out="" baseline="" study=quick times=(--ignore-times)
asked=()
while [ $# -gt 0 ]; do
  case "$1" in
    --help) usage; exit 0 ;;
    --times) times=(); shift; continue ;;
    --out | --baseline | --study | --backend | --budget) [ $# -gt 1 ] || refuse "$1 needs a value" ;;
    *) refuse "there is no option \"$1\"; --help lists them" ;;
  esac
  case "$1" in
    --out) out="$2" ;;
    --baseline) baseline="$2" ;;
    --study) study="$2" ;;
    *) asked+=("$1" "$2") ;;
  esac
  shift 2
done
[ -n "$out" ] || refuse "--out DIR is missing"
command -v "$plumb" >/dev/null || refuse "there is no program \"$plumb\"; name it in PLUMB"

# The same cells whatever the machine, so that those of a baseline are there again.
"$plumb" study "$study" --fixed --out "$out" "${asked[@]}"

against=()
if [ -n "$baseline" ] && compgen -G "$baseline/results*.jsonl*" >/dev/null; then
  against=(--against "$baseline" --strict "${times[@]}")
fi
status=0
"$plumb" report "$out" "${against[@]}" --html "$out/report.html" --md >"$out/table.md" || status=$?
[ "$status" -le 1 ] || exit "$status"

# Whole lines, and no more than a comment may have; the page has all of it.
LC_ALL=C awk -v most="$most_bytes" '
  { bytes += length($0) + 1 }
  bytes > most { print "\nThe rest is cut off here: report.html has all of it."; exit }
  { print }' "$out/table.md" >"$out/comment.md"
rm "$out/table.md"
exit "$status"
