#!/usr/bin/env bash
# The chain sweep -> fit -> figure as CMake declares it, around a program that only notes its calls:
# what runs again after which change. Usage: chain_test.sh CMAKE MODULE_FOLDER
set -euo pipefail
cmake=$1
modules=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
export CALLS=$folder/calls SOURCE_TABLE=$folder/source.csv

cat > shakebed <<'PROGRAM'
#!/usr/bin/env bash
set -eu
echo "$1 $2" >> "$CALLS"
option() { local name=$1; shift; while [ $# -gt 0 ]; do [ "$1" != "$name" ] || { echo "$2"; return; }; shift; done; }
case "$1 $2" in
  "sweep run") ;;
  "sweep collect") cp "$SOURCE_TABLE" "$(option --csv "$@")" ;;
  fit*)
    out=$(dirname "$(option --csv "$@")"); mkdir -p "$out"
    for kind in parameters summary exponents curves comparison correlations points collapse ratios; do
      cat "$2" "$(option --data "$@")" > "$out/$kind.csv"
    done ;;
  figure*)
    out=$(option --output "$@"); mkdir -p "$out"
    for ending in csv svg png; do cp "$SOURCE_TABLE" "$out/$2.$ending"; done ;;
esac
PROGRAM
chmod +x shakebed
echo "W,T_z" > source.csv
touch sweep.yaml fit.yaml figure.yaml script.gp shipped.csv
cat > CMakeLists.txt <<'PROJECT'
cmake_minimum_required(VERSION 3.25)
project(chain LANGUAGES NONE)
include(${MODULES}/ShakebedPipeline.cmake)
add_executable(shakebed IMPORTED)
set_target_properties(shakebed PROPERTIES IMPORTED_LOCATION "${CMAKE_SOURCE_DIR}/shakebed")
add_sweep(s FILE sweep.yaml SHIPPED shipped.csv)
add_fit(f FILE fit.yaml SWEEP s)
add_figure(fig SPEC figure.yaml NEEDS s f USES script.gp)
add_job(job FIGURES fig)
shakebed_write_pipeline()
PROJECT
# The pipeline finds its scripts below the project, as in the repository.
mkdir cmake && cp "$modules"/ReplaceIfChanged.cmake cmake/
"$cmake" -S . -B build -G Ninja "-DMODULES=$modules" > /dev/null

failures=0
# expect WHAT TARGET CALL...: building TARGET makes exactly these calls, in this order.
expect() {
  local what=$1 target=$2; shift 2
  : > "$CALLS"
  "$cmake" --build build --target "$target" > build.log 2>&1 || { cat build.log; exit 1; }
  if ! diff <([ $# -eq 0 ] || printf '%s\n' "$@") "$CALLS" > difference; then
    echo "FAILED: $what"; cat difference; failures=$((failures + 1))
  fi
}
later() { sleep 0.02; touch "$1"; }

check=("sweep run" "sweep collect")
fit="fit $folder/fit.yaml"
figure="figure fig"
expect "everything, the first time" job "${check[@]}" "$fit" "$figure"
expect "nothing but the cache check, the second time" job "${check[@]}"
later fit.yaml
expect "fit and figure after a changed fit" fig "${check[@]}" "$fit" "$figure"
later script.gp
expect "the figure after a changed script" fig "${check[@]}" "$figure"
later sweep.yaml
expect "no fit after a sweep file that led to the same table" fig "${check[@]}"
echo "1,2" >> source.csv
expect "fit and figure after a changed table" fig "${check[@]}" "$fit" "$figure"
expect "the fit alone is fresh" fit-f "${check[@]}"
later shakebed
expect "fit and figure with another program" fig "${check[@]}" "$fit" "$figure"
expect "the other profile from its own folder" fig-paper "${check[@]}" "$fit" "$figure"
expect "refit from the shipped table without a sweep" refit "$fit" "$figure"
expect "nothing, the second time" refit
later shipped.csv
expect "refit after changed shipped averages" refit "$fit" "$figure"
for origin in quick paper shipped; do
  [ -s "build/results/$origin/figures/fig.svg" ] || { echo "FAILED: no $origin figure"; failures=1; }
done
diff <(printf 'figure,needs,origins\nfig,s f,quick paper shipped\n') build/pipeline.csv || failures=1
exit $((failures > 0))
