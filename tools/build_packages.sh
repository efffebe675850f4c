#!/usr/bin/env bash
# Builds the Debian packages of the committed sources, and a wheel for pip of what they were built of.
#   tools/build_packages.sh [--without-viewer] [FOLDER]   into FOLDER (build/packages)
# The page of holdfast-viewer takes npm's registry and Debian's emscripten; it is built first, and the build of packages, which may
# ask for neither, takes it from the sources' build/viewer/.
set -euo pipefail
cd "$(dirname "$0")/.."
viewer=true
if [[ ${1-} == --without-viewer ]]; then
  viewer=false
  shift
fi
mkdir -p "${1:-build/packages}"
folder=$(cd "${1:-build/packages}" && pwd)

tools/apt_get.sh install -y --no-install-recommends build-essential debhelper dh-python chrpath lintian > /dev/null
tools/apt_get.sh build-dep -y --no-install-recommends . > /dev/null
tools/apt_get.sh install -y --no-install-recommends python3-pip python3-setuptools python3-wheel > /dev/null

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/holdfast"
git archive HEAD | tar -x -C "$work/holdfast"
export DEB_BUILD_PROFILES=pkg.holdfast.noviewer
if $viewer; then
  DEB_BUILD_PROFILES=
  make -C "$work/holdfast" viewer-engine viewer > "$folder/viewer.log" 2>&1 || { tail -20 "$folder/viewer.log" >&2; exit 1; }
  cp "$work"/holdfast/build/viewer/{viewer.html,licenses.txt} "$folder"
fi
(cd "$work/holdfast" && DEB_BUILD_OPTIONS="nocheck noautodbgsym parallel=$(tools/job_count.sh)" dpkg-buildpackage -b -us -uc > "$folder/build.log" 2>&1) ||
  { tail -20 "$folder/build.log" >&2; exit 1; }
rm -f "$folder"/*.{deb,changes,buildinfo,whl}
(cd "$work/holdfast" && HOLDFAST_BUILD=$work/holdfast/debian/build /usr/bin/python3 -m pip wheel --quiet --no-build-isolation --no-deps -w "$folder" .)
mv "$work"/*.{deb,changes,buildinfo} "$folder"
# They are not uploaded to Debian, so there is no bug to close.
lintian --allow-root --fail-on error,warning --suppress-tags initial-upload-closes-no-bugs "$folder"/*.changes
ls "$folder"/*.{deb,whl}
