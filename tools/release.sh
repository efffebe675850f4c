#!/usr/bin/env bash
# Makes a release of the committed sources: checks them, builds packages and a source archive, and tags them.
#   tools/release.sh     takes hours, for the slow checks
set -euo pipefail
cd "$(dirname "$0")/.."
version=$(sed -n 's/^project(holdfast VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)

[[ -z $(git status --porcelain) ]] || { echo "there are changes that are not committed" >&2; exit 1; }
grep -q "^## \[$version\]" CHANGELOG.md || { echo "CHANGELOG.md has no section [$version]" >&2; exit 1; }
[[ $(sed -n '1s/holdfast (\([0-9.]*\)-.*/\1/p' debian/changelog) == "$version" ]] ||
  { echo "debian/changelog is not of $version" >&2; exit 1; }
! git rev-parse -q --verify "refs/tags/v$version" > /dev/null || { echo "v$version is released already" >&2; exit 1; }

.ci/slow
tools/build_packages.sh build/packages
tools/test_packages.sh build/packages
git archive --prefix="holdfast-$version/" -o "build/packages/holdfast-$version.tar.gz" HEAD
git tag -a "v$version" -m "holdfast $version"
echo "v$version is tagged; build/packages has what to publish. git push origin v$version"
