#!/usr/bin/env bash
# Builds what a release consists of into build/dist: two Debian packages, a tarball that runs from any folder with
# its libraries inside (glibc 2.36 or newer: Debian 12's), the bill of materials, and
# checksums. The same commit gives the same bytes: scripts/check_reproducible.sh looks.
set -euo pipefail
cd "$(dirname "$0")/.."
umask 022  # the permissions of what is packed, also those that ar writes into a .deb
scripts/install_dependencies.sh build
command -v patchelf >/dev/null || { echo "make_release.sh: install patchelf" >&2; exit 1; }
SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct)}
export SOURCE_DATE_EPOCH
build=build/dist
# With the flags that the tests run with: assertions stay.
cmake --preset release -B $build -DVANTAGE_BUILD_TESTS=OFF -DVANTAGE_BUILD_BENCH=OFF >/dev/null
cmake --build $build
(cd $build && cpack -G DEB >/dev/null)

name=vantage-$($build/apps/vantage/vantage --version | sed -n '1s/vantage //p')-linux-$(uname -m)
stage=$build/stage/$name
rm -rf $build/stage
cmake --install $build --prefix "$PWD/$stage" --component program --strip >/dev/null
mkdir -p "$stage/lib/vantage"
ldd "$stage/bin/vantage" | sed -n 's/.* => \(\/[^ ]*\) .*/\1/p' |
  grep -vE '/(libc|libm|libdl|libpthread|librt|libresolv|ld-linux[^/]*)\.so' | sort |
  xargs -I{} cp -L {} "$stage/lib/vantage/"
patchelf --set-rpath "\$ORIGIN/../lib/vantage" "$stage/bin/vantage"
for library in "$stage"/lib/vantage/*; do
  patchelf --set-rpath "\$ORIGIN" "$library"
done
python3 scripts/make_sbom.py $build/apps/vantage/vantage --epoch "$SOURCE_DATE_EPOCH" \
  --licences "$stage/share/doc/vantage/licences" >"$stage/vantage.spdx.json"
cp LICENSE "$stage/"
chmod -R u=rwX,go=rX "$stage"
tar --sort=name --mtime="@$SOURCE_DATE_EPOCH" --owner=0 --group=0 --numeric-owner -C $build/stage -cf - "$name" |
  gzip -9n >"$build/packages/$name.tar.gz"
cp "$stage/vantage.spdx.json" $build/packages/
scripts/test_release.sh "$build/packages/$name.tar.gz"
(cd $build/packages && rm -rf _CPack_Packages && sha256sum -- *.deb *.tar.gz *.json | tee SHA256SUMS)
