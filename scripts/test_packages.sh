#!/usr/bin/env bash
# Installs the Debian packages on a bare Debian 12 tree, runs the program there, and builds a program against
# the library. Needs root, debootstrap and the network; scripts/check_all.sh runs it.
#   test_packages.sh [BUILD=build/release] [TREE=a temporary folder]
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build/release}
tree=${2:-$(mktemp -d)/debian12}
cmake --build "$build" --target vantage_program vantage_words
# Whatever the builder's umask: others than root have to reach what is installed.
(cd "$build" && umask 077 && cpack -G DEB >/dev/null && chmod a+r packages/*.deb)
for package in "$build"/packages/*.deb; do
  if dpkg-deb -c "$package" | grep -v '^.r..r-.r-'; then
    echo "test_packages.sh: $package holds what not all may read" >&2
    exit 1
  fi
done

if [[ ! -d $tree/usr ]]; then
  debootstrap --variant=minbase bookworm "$tree" >/dev/null
fi
cp /etc/resolv.conf "$tree/etc/resolv.conf"
cp /etc/hosts "$tree/etc/hosts"
mkdir -p "$tree/opt/trial"
cp "$build"/packages/*.deb models/fan.ply tests/data/import/stand.step examples/best_view.cpp tests/install/consumer/CMakeLists.txt "$tree/opt/trial/"
inside() { chroot "$tree" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/opt/trial \
  DEBIAN_FRONTEND=noninteractive http_proxy="${http_proxy:-}" https_proxy="${https_proxy:-}" sh -euc "cd /opt/trial; $1"; }

echo "== two commands from the package to the first picture"
inside 'apt-get update -qq && apt-get install -y -qq --no-install-recommends ./vantage_*.deb >/dev/null'
inside 'vantage view fan.ply'
inside 'test -s fan.vantage/best.png && test -s /usr/share/man/man1/vantage-view.1.gz'

if compgen -G "$build/packages/vantage-import_*.deb" >/dev/null; then
  echo "== CAD and game formats by the optional package"
  inside '! vantage info stand.step 2>message && grep -q "install vantage-import" message'
  inside 'apt-get install -y -qq --no-install-recommends ./vantage-import_*.deb >/dev/null'
  inside 'vantage info stand.step | grep -q "pin (2)"'
fi

echo "== a program against the installed library, by CMake and by pkg-config"
inside 'apt-get install -y -qq --no-install-recommends ./libvantage-dev_*.deb g++ cmake make pkgconf >/dev/null'
inside 'cmake -DEXAMPLE=/opt/trial/best_view.cpp -S . -B consumer >/dev/null && cmake --build consumer >/dev/null'
inside 'consumer/consumer fan.ply a.png && test -s a.png'
inside 'g++ $(pkg-config --cflags vantage) best_view.cpp $(pkg-config --libs vantage) -o by_pc && ./by_pc fan.ply b.png'
inside 'cmp a.png b.png'

echo "== removed without a trace"
inside 'apt-get purge -y -qq vantage libvantage-dev >/dev/null; ! ls /usr/bin/vantage /usr/include/vantage 2>/dev/null'
echo "packages: passed"
