#!/usr/bin/env bash
# Installs the Debian 12 packages that are missing: install_dependencies.sh build|test|check|all
#   build  what the program needs      test  also what the tests need
#   check  also formatter, linter, sanitizer runtimes, Doxygen
#   all    also the large programs that the integrations are tried with: Blender, Open3D, VTK, tools of containers
set -euo pipefail

build=(g++ cmake ninja-build libeigen3-dev libtbb-dev libembree-dev libpng-dev libjpeg-dev nlohmann-json3-dev
       libcli11-dev libtinygltf-dev libmetis-dev libnanoflann-dev libmeshoptimizer-dev
       libwebp-dev zlib1g-dev libdraco-dev libexpat1-dev libsqlite3-dev libarchive-dev libsodium-dev
       libcpp-httplib-dev libssl-dev libbrotli-dev)
test=(libgtest-dev libgmock-dev python3 chromium slurm-wlm munge parallel pkgconf groff-base zsh fish
      pybind11-dev python3-dev python3-numpy python3-pytest python3-pip python3-matplotlib
      mypy python3-venv python3-yaml patchelf git curl libassimp-dev libocct-data-exchange-dev)
check=(clang-14 clang-format-14 clang-tidy-14 libclang-rt-14-dev libbenchmark-dev doxygen debootstrap patchelf)
integrations=(blender python3-open3d python3-vtk9 xvfb xauth mmdebstrap umoci uidmap runc)

case "${1:-build}" in
  build) wanted=("${build[@]}") ;;
  test)  wanted=("${build[@]}" "${test[@]}") ;;
  check) wanted=("${build[@]}" "${test[@]}" "${check[@]}") ;;
  all)   wanted=("${build[@]}" "${test[@]}" "${check[@]}" "${integrations[@]}") ;;
  *) echo "usage: $0 build|test|check|all" >&2; exit 2 ;;
esac

# Node.js of any origin will do: the distribution's packages conflict with others.
command -v npm >/dev/null || wanted+=(npm)

missing=()
for package in "${wanted[@]}"; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' || missing+=("$package")
done
if ((${#missing[@]} > 0)); then
  echo "installing: ${missing[*]}"
  as_root=()
  if [[ $(id -u) -ne 0 ]]; then as_root=(sudo); fi
  "${as_root[@]}" apt-get update -qq
  DEBIAN_FRONTEND=noninteractive "${as_root[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
fi
