#!/usr/bin/env bash
# What building costs: the dearest files and targets of the last builds in a folder (times as ninja took them, so of a
# machine that was idle or not), and each public header by itself. Usage: bench_build.sh BUILD-FOLDER, in the repository.
set -euo pipefail
log="$1/.ninja_log"
[ -f "$log" ] || { echo "bench_build: there is no $log; build first" >&2; exit 2; }

objects="$(awk -F'\t' '/^[0-9]/ && $4 ~ /\.o$/ { seconds[$4] = ($2 - $1) / 1000 }
                       END { for (object in seconds) print seconds[object], object }' "$log" |
  sed 's|CMakeFiles/||; s|\.dir/| |; s|\.o$||' | sort -rn)"
echo "== the dearest files, s"
awk 'NR <= 25 { printf "%8.1f  %s %s\n", $1, $2, $3 }' <<<"$objects"
echo "== the dearest targets, s of their files"
awk '{ sum[$2] += $1; files[$2]++; all += $1 }
     END { for (target in sum) printf "%8.1f  %s (%d files)\n", sum[target], target, files[target]
           printf "%8.1f  all (%d files)\n", all, NR }' <<<"$objects" | sort -rn | head -25
echo "== each public header by itself: CPU s, kB of preprocessed text"
TIMEFORMAT='%U'
find api/include -name '*.hpp' -o -name '*.h' | while read -r header; do
  flags=(-std=c++20 -x c++ -I api/include -include "$header" /dev/null)
  kilobytes="$(("$(g++ -E -P "${flags[@]}" | wc -c)" / 1024))"
  seconds="$({ time g++ -fsyntax-only "${flags[@]}"; } 2>&1)"
  printf '%8s %6d  %s\n' "$seconds" "$kilobytes" "$header"
done | sort -rn
