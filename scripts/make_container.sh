#!/usr/bin/env bash
# Makes an OCI image of the Debian package and the libraries it depends on: no shell, no package manager, no root.
# Needs mmdebstrap, umoci, the network (Debian's mirror) and the right to make user namespaces, but not root.
#   make_container.sh PACKAGE.deb [OUTPUT=build/container]     OUTPUT/vantage-oci.tar, for `podman load -i`
set -euo pipefail
package=$(realpath "$1")
output=$(realpath -m "${2:-$(dirname "$0")/../build/container}")
for tool in mmdebstrap umoci; do
  command -v $tool >/dev/null || { echo "make_container.sh: install $tool" >&2; exit 1; }
done
mkdir -p "$output"
place=$(mktemp -d)
trap 'chmod -R u+rwX "$place"; rm -rf "$place"' EXIT
mkdir "$place/root"

# The packages are unpacked, not installed: their scripts have nothing to do in a tree that is never changed.
libraries=$(dpkg-deb -f "$package" Depends | sed 's/ ([^)]*)//g; s/ //g')
mmdebstrap --quiet --variant=extract --include="$libraries" bookworm "$place/libraries.tar"
tar -C "$place/root" -xf "$place/libraries.tar" --exclude='./dev/*' --no-same-owner
dpkg-deb --fsys-tarfile "$package" | tar -C "$place/root" -xf - --no-same-owner

# Of all this, the program, the libraries, and the licences of both.
cd "$place/root"
rm -rf var etc usr/bin/[!v]* usr/sbin usr/lib/x86_64-linux-gnu/{gconv,audit} \
  usr/share/{bash-completion,fish,zsh,man,mime,thumbnailers,lintian,gdb,gcc,doc-base,locale}
find usr/share/doc -mindepth 2 -not -type d -not -name copyright -not -path '*/vantage/*' -delete
cp -rL /usr/share/common-licenses usr/share/  # which the files `copyright` point to
mkdir -p etc tmp work
chmod 1777 tmp
echo 'vantage:x:65532:65532::/tmp:/sbin/nologin' >etc/passwd
echo 'vantage:x:65532:' >etc/group
[[ ! -e bin/sh && ! -e usr/bin/sh ]] || { echo "make_container.sh: there is a shell in the image" >&2; exit 1; }

version=$(dpkg-deb -f "$package" Version)
umoci init --layout "$place/oci"
umoci new --image "$place/oci:$version"
umoci insert --rootless --image "$place/oci:$version" "$place/root" /
umoci config --image "$place/oci:$version" --config.entrypoint /usr/bin/vantage --config.user 65532:65532 \
  --config.workingdir /work --config.env PATH=/usr/bin --config.env HOME=/tmp --os linux \
  --architecture "$(dpkg-deb -f "$package" Architecture)" \
  --config.label org.opencontainers.image.title=vantage --config.label org.opencontainers.image.version="$version" \
  --config.label org.opencontainers.image.licenses=MIT
umoci gc --layout "$place/oci"
tar -C "$place/oci" -cf "$output/vantage-oci.tar" .
echo "$output/vantage-oci.tar: $(du -sb "$place/root" | cut -f1) bytes unpacked, $(stat -c %s "$output/vantage-oci.tar") packed"
