#!/bin/sh
# packages.sh LIST: sees to it that every Debian package named in the file LIST is installed.
# Root: says what it installs, and installs it. Anyone else: prints the one line to run, and fails.
set -eu

list=$1
wanted=$(sed 's/#.*//' "$list")

if ! command -v dpkg-query >/dev/null 2>&1; then
  echo "packages: no dpkg here; CMake will say what it misses (Debian's names are in $list)"
  exit 0
fi

# shellcheck disable=SC2086  # a list of words
installed=$(dpkg-query -W -f '${Package} ${db:Status-Status}\n' $wanted 2>/dev/null |
  awk '$2 == "installed" { print $1 }') || true
missing=
for package in $wanted; do
  printf '%s\n' "$installed" | grep -qxF "$package" || missing="$missing $package"
done
[ -n "$missing" ] || exit 0

if [ "$(id -u)" -ne 0 ]; then
  {
    echo "packages: missing from $list:$missing"
    echo "packages: run this line, then make again (SKIP_PACKAGES=1 if you have them from elsewhere):"
    echo "sudo apt-get update && sudo apt-get install --yes --no-install-recommends$missing"
  } >&2
  exit 1
fi

echo "packages: installing with apt-get, as root:$missing"
export DEBIAN_FRONTEND=noninteractive
apt-get update --quiet </dev/null
# shellcheck disable=SC2086
apt-get install --yes --quiet --no-install-recommends --no-remove $missing </dev/null
