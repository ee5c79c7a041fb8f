#!/bin/bash
# Installs the Debian packages in a fresh, minimal Debian 12 and tries them there: runs the
# demonstration, checks its certificate, imports the Python module, builds a separate C++ project, and
# tries every command and every Python block of the docs.
# Usage (as root, for debootstrap and chroot): tools/try_package.sh FOLDER_OF_DEBS [CHROOT]
# CHROOT is made, and removed at the end; KEEP_CHROOT=1 keeps it. Needs about 2 GB and a few minutes.
set -euo pipefail
debs=$(realpath "$1")
root=$(realpath -m "${2:-build/chroot}")
cd "$(dirname "$0")/.."
mirror=${DEBIAN_MIRROR:-http://deb.debian.org/debian}

[ "$(id -u)" -eq 0 ] || { echo "try_package: debootstrap and chroot need root" >&2; exit 1; }
command -v debootstrap >/dev/null || { echo "try_package: please install debootstrap" >&2; exit 1; }
[ ! -e "$root" ] || { echo "try_package: $root already exists; remove it or choose another" >&2; exit 1; }

clean_up() {
  if mountpoint -q "$root/proc"; then umount "$root/proc"; fi
  if [ -z "${KEEP_CHROOT:-}" ]; then rm -rf --one-file-system "$root"; fi
}
trap clean_up EXIT

step() {  # step WHAT COMMAND...: prints what it does and how long it took
  local what=$1 begin=$SECONDS
  shift
  echo "== $what"
  "$@"
  echo "-- $((SECONDS - begin)) s"
}
inside() { chroot "$root" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 \
  DEBIAN_FRONTEND=noninteractive "$@"; }
as_user() { inside su someone -s /bin/sh -c "cd; $1"; }
size() { inside sh -c "du -smx --exclude=./var/cache --exclude=./var/lib/apt --exclude=./debs / | cut -f 1"; }

bare_system() {
  debootstrap --variant=minbase bookworm "$root" "$mirror" >"$root.log" 2>&1 ||
    { tail -n 20 "$root.log" >&2; return 1; }
  rm -f "$root.log"
  mount -t proc proc "$root/proc"
  mkdir -p "$root/debs"
  cp "$debs"/*.deb "$root/debs"
  inside useradd -m someone
  inside apt-get update -q >/dev/null
}
install() { inside sh -c "apt-get install -y -q --no-install-recommends $* >/tmp/apt.log 2>&1 ||
  { tail -n 30 /tmp/apt.log; exit 1; }"; }

demonstration() {
  as_user 'fairway run /usr/share/doc/fairway/examples/demo/demo.toml -o out/demo'
  as_user 'ls -l out/demo'
  as_user 'test -s out/demo/report.html && test -s out/demo/plan.png'
}
asked() {
  as_user 'fairway-check out/demo/certificate.safetensors --plan out/demo/plan.safetensors'
  as_user 'fairway query out/demo/certificate.safetensors --state 100,100,90deg'
  # minbase keeps manual pages and docs where packages put them, but has no man to read them
  inside sh -c 'zcat /usr/share/man/man1/fairway-run.1.gz | head -n 4'
  inside bash -c '. /usr/share/bash-completion/completions/fairway
    COMP_WORDS=(fairway ver) COMP_CWORD=1; _fairway; test "${COMPREPLY[*]}" = verify'
}
from_python() {
  as_user 'python3 -c "
import fairway
print(fairway.__version__, fairway.load_plan(\"out/demo/plan.safetensors\"))
plan = fairway.plan(fairway.Scenario(\"/usr/share/doc/fairway/examples/demo/demo.toml\"))
print(plan.fly(plan.random_starts(1000, seed=1)).counts)"'
}
strangers_project() {
  cp -r tests/consumer "$root/home/someone/consumer"
  inside chown -R someone: /home/someone/consumer
  as_user 'cmake -S consumer/library -B library -DCMAKE_BUILD_TYPE=Release >/dev/null &&
    cmake --build library >/dev/null && library/consumer plan.safetensors'
  as_user 'cmake -S consumer/on_board -B on_board -DCMAKE_BUILD_TYPE=Release >/dev/null &&
    cmake --build on_board >/dev/null &&
    fairway verify plan.safetensors --undecided-max 0.05 --quiet -o proved.safetensors &&
    on_board/on_board proved.safetensors'
  as_user 'g++ -std=c++20 -O2 consumer/library/main.cpp $(pkg-config --cflags --libs fairway) \
    -o by_hand && ./by_hand plan.safetensors'
  as_user 'g++ -std=c++20 -O2 consumer/on_board/main.cpp $(pkg-config --cflags fairway-runtime) \
    -o by_hand && ./by_hand proved.safetensors'
}
docs() {  # the commands of the docs, with only what is installed
  mkdir -p "$root/home/someone/source/python"
  cp tests/docs_commands_test.py "$root/home/someone/source"
  cp -r python/tests "$root/home/someone/source/python"
  inside cp -r /usr/share/doc/fairway/docs /usr/share/doc/fairway/examples/demo /home/someone/source
  inside chown -R someone: /home/someone/source
  as_user 'python3 source/docs_commands_test.py source /usr/bin/fairway -v -k test_page'
  as_user 'FAIRWAY=/usr/bin/fairway FAIRWAY_SOURCE=$PWD/source \
    python3 -B source/python/tests/run_tests.py source/python/tests/test_docs.py'
}
gone() {  # nothing from the packages is left
  inside apt-get purge -y -q fairway libfairway-dev python3-fairway >/dev/null 2>&1
  ! inside find /usr /etc -path '*fairway*' | grep .
}

step "a bare Debian 12 (debootstrap, minbase)" bare_system
before=$(size)
step "apt-get install fairway, with its dependencies" install '/debs/fairway_*.deb'
echo "$((before)) MB before, $(size) MB with it"
step "the demonstration, as an ordinary user" demonstration
step "certificate, query, manual page, completion" asked
step "apt-get install python3-fairway" install '/debs/python3-fairway_*.deb'
step "import fairway" from_python
step "apt-get install libfairway-dev, and a compiler" install '/debs/libfairway-dev_*.deb' g++ cmake make pkgconf
step "find_package(fairway), pkg-config" strangers_project
step "apt-get install python3-pytest" install python3-pytest
step "every page of the docs" docs
step "apt-get purge leaves nothing" gone
echo "try_package: everything works"
