#!/usr/bin/env bash
# Installs, uses and removes the packages and the wheel in a bare Debian 12, which debootstrap makes. As root.
#   tools/test_packages.sh [FOLDER]   what tools/build_packages.sh made (build/packages)
set -euo pipefail
cd "$(dirname "$0")/.."
packages=$(cd "${1:-build/packages}" && pwd)
((EUID == 0)) || { echo "$0: debootstrap and chroot take root" >&2; exit 2; }
command -v debootstrap > /dev/null || tools/apt_get.sh install -y --no-install-recommends debootstrap > /dev/null

root=$(mktemp -d)
finish() {
  (($? == 0)) || tail -5 "$root/tmp/errors" >&2
  umount "$root/proc" 2> /dev/null || true
  rm -rf --one-file-system "$root"
}
trap finish EXIT
step() { printf '%-42s %5d s\n' "$1" $((SECONDS - began)); began=$SECONDS; }
inside() { chroot "$root" env DEBIAN_FRONTEND=noninteractive LC_ALL=C "$@" 2>> "$root/tmp/errors"; }

began=$SECONDS
debootstrap --variant=minbase bookworm "$root" http://deb.debian.org/debian > /dev/null
mount -t proc proc "$root/proc"
# How this machine reaches the archive.
cp /etc/resolv.conf "$root/etc/resolv.conf"
cp -r /etc/apt/apt.conf.d/. "$root/etc/apt/apt.conf.d/"
inside apt-get -qq update
step "a bare Debian 12"

mkdir "$root/tmp/packages"
cp "$packages"/*.{deb,whl} "$root/tmp/packages"
rm -f "$root"/tmp/packages/*-dbgsym_*.deb
inside sh -c 'apt-get -qq install -y --no-install-recommends /tmp/packages/*.deb > /dev/null'
step "install"

inside holdfast --version
! inside holdfast --version | grep -q unknown || { echo "the program does not know its commit" >&2; exit 1; }
cp -r configs "$root/tmp/configs"
inside sh -c 'cd /tmp && holdfast screen --layouts configs/layouts --norm road --accuracy screening -o results.h5 2> /dev/null' | head -8
inside sh -c 'cd /tmp && holdfast engines && bash -n /usr/share/bash-completion/completions/holdfast'
step "the first verdict"
if compgen -G "$root/tmp/packages/holdfast-viewer_*.deb" > /dev/null; then
  inside sh -c 'cd /tmp && holdfast view results.h5 --no-open'
  step "the page"
fi
inside sh -c 'cd /tmp && OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun --oversubscribe -n 2 holdfast-mpi \
  screen --layouts configs/layouts --norm road --accuracy screening --threads 1 --quiet -o ranks.h5 &&
  holdfast summary results.h5 > one && holdfast summary ranks.h5 > two && cmp one two'
step "the same by two ranks"
cat > "$root/tmp/verdict.py" << 'END'
import holdfast
with holdfast.Screen(norm="road", accuracy="screening", unit="cm") as screen:
    print(screen.evaluate([[[0, 0, 0, 80, 60, 50, 1]]]).verdict, holdfast.__file__)
END
inside python3 /tmp/verdict.py
step "the first verdict in Python"
inside apt-get -qq install -y --no-install-recommends g++ cmake make > /dev/null
cp -r examples/embed "$root/tmp/embed"
inside sh -c 'cmake -S /tmp/embed -B /tmp/embed/build > /dev/null && cmake --build /tmp/embed/build > /dev/null &&
  /tmp/embed/build/embed /tmp/configs/accelerations/road_brake_0g8.txt /tmp/configs/layouts/seed_example.txt'
step "a program that embeds the library"

names=$(for file in "$root"/tmp/packages/*.deb; do dpkg-deb --field "$file" Package; done)
inside apt-get -qq purge -y $names > /dev/null
left=$(inside find / -xdev \( -path /proc -o -path /tmp \) -prune -o -name '*holdfast*' -print | grep -v '^/var/\(log\|lib/apt\|cache\)' || true)
[[ -z $left ]] || { echo "left behind: $left" >&2; exit 1; }
step "purge, and nothing is left"

# The wheel has the library inside, and asks for the libraries of Debian that docs/develop/packages.md names.
libraries=$(sed -n 's/^sudo apt install \(.*libtbb12.*\)$/\1/p' docs/develop/packages.md)
inside apt-get -qq install -y --no-install-recommends $libraries > /dev/null
inside sh -c 'python3 -m venv --system-site-packages /tmp/venv &&
  /tmp/venv/bin/pip install --quiet --no-index --no-deps /tmp/packages/*.whl && /tmp/venv/bin/python /tmp/verdict.py'
step "the wheel, without the packages"
