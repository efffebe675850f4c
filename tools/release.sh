#!/usr/bin/env bash
# Makes a release of the committed sources: checks them, builds and tests packages, packs the sources with the page of the viewer,
# and tags them.
#   tools/release.sh             takes hours, for the slow checks
#   tools/release.sh --rehearse  leaves out the slow checks and the tag
set -euo pipefail
cd "$(dirname "$0")/.."
rehearse=false
case "${1-}" in
  '') ;;
  --rehearse) rehearse=true ;;
  *) echo "$0: unknown option: $1; accepted: --rehearse" >&2; exit 2 ;;
esac
version=$(sed -n 's/^project(holdfast VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)

[[ -z $(git status --porcelain) ]] || { echo "there are changes that are not committed" >&2; exit 1; }
grep -q "^## \[$version\]" CHANGELOG.md || { echo "CHANGELOG.md has no section [$version]" >&2; exit 1; }
[[ $(sed -n '1s/holdfast (\([0-9.]*\)-.*/\1/p' debian/changelog) == "$version" ]] ||
  { echo "debian/changelog is not of $version" >&2; exit 1; }
! git rev-parse -q --verify "refs/tags/v$version" > /dev/null || { echo "v$version is released already" >&2; exit 1; }

$rehearse || .ci/slow
packages=build/packages
tools/build_packages.sh $packages
tools/test_packages.sh $packages
# With the page, packages can be built from the archive where there is no npm.
archive=holdfast-$version.tar.gz
git archive --prefix="holdfast-$version/build/viewer/" --add-file=$packages/viewer.html --add-file=$packages/licenses.txt \
  --prefix="holdfast-$version/" -o "$packages/$archive" HEAD
(cd $packages && sha256sum ./*.deb ./*.whl "$archive" viewer.html > SHA256SUMS)
if $rehearse; then
  echo "$packages has what v$version would publish; nothing is tagged"
  exit
fi
git tag -a "v$version" -m "holdfast $version"
echo "v$version is tagged; $packages has what to publish. git push origin v$version"
