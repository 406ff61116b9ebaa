#!/usr/bin/env bash
# A fit over another range reads the collected table alone: the cache keeps every byte and every
# time, and the numbers follow the range. Usage: refit_test.sh SHAKEBED
set -euo pipefail
shakebed=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

cat > bed.yaml <<'YAML'
scene: 1
dimension: 2
grains: {count: 8, restitution: 0.9, friction: 0}
cell: [4]
base: {drive: {W: 10, amplitude: 1}, restitution: 0.9, friction: 0}
contact: {normal: linear_spring_dashpot, tangential: frictionless}
protocol: {measure: {cycles: 120}}
seed: 3
YAML
cat > sweep.yaml <<'YAML'
sweep: 1
id: refit
base: bed.yaml
axes: [{key: base.drive.W, values: [4, 6, 9, 13, 20, 30]}]
YAML
fit() {  # fit FROM TO OUT
  cat > "$3.yaml" <<YAML
fit: 1
id: refit
data: table.csv
defaults: {if_impossible: refuse}
fits:
  - {id: alpha, x: V_p, y: T_z, model: power_law, range: {W: [$1, $2]}, minimum_stationary: 0.01}
YAML
  "$shakebed" fit "$3.yaml" --csv "$3/parameters.csv" > "$3.txt"
}
state() { find cache -type f -exec sha256sum {} + | sort; find cache -printf '%p %T@ %C@\n' | sort; }

"$shakebed" sweep run sweep.yaml --cache cache --jobs 2 > run.txt 2>&1
"$shakebed" sweep collect sweep.yaml --cache cache --csv table.csv > collect.txt 2>&1
state > before
fit 3 40 whole
fit 8 40 high
state > after

cmp before after || { echo "a fit changed the cache"; exit 1; }
test "$(grep -c '\.h5' before)" -ge 12 || { echo "the cache does not hold the six beds"; exit 1; }
for range in whole high; do
  grep -q '^alpha,' "$range/parameters.csv" || { cat "$range/parameters.csv"; exit 1; }
done
! cmp -s whole/parameters.csv high/parameters.csv || { echo "another range, same numbers"; exit 1; }
mv cache elsewhere
fit 3 40 without_cache
cmp whole/parameters.csv without_cache/parameters.csv
echo "refits leave the cache alone"
