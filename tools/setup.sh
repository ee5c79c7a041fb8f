#!/bin/sh
# Installs the missing Debian packages of those in the given lists, if any.
# Usage: tools/setup.sh packages.apt [MORE.apt ...]
set -eu

missing=""
for package in $(cat "$@"); do
  status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing="$missing $package"
done
[ -n "$missing" ] || exit 0

if ! command -v apt-get >/dev/null 2>&1; then
  echo "setup: this is not Debian; the build needs what these packages contain:$missing" >&2
  exit 0
fi
as_root=""
if [ "$(id -u)" -ne 0 ]; then
  as_root="sudo"
  command -v sudo >/dev/null 2>&1 || {
    echo "setup: please install as root: apt-get install$missing" >&2
    exit 1
  }
fi
echo "setup: installing with apt-get:$missing"
$as_root apt-get update -q </dev/null
$as_root env DEBIAN_FRONTEND=noninteractive \
  apt-get install -y -q --no-install-recommends $missing </dev/null
