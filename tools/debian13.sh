#!/usr/bin/env bash
# Builds Daumier in a Debian 13 chroot, against LibTorch 2.6, and runs its tests there. As root, on Debian with debootstrap.
#   tools/debian13.sh [FOLDER]     FOLDER (default build/debian13) is made once, about 3 GB, and kept.
# DAUMIER_PRESET=dev builds with clang, which takes half the time. The mirror is the one that this machine's own package sources name; DAUMIER_DEBIAN_MIRROR overrides it.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source tools/packages.sh
source_root="$PWD"
preset="${DAUMIER_PRESET:-release}"
root="$(realpath -m "${1:-build/debian13}")"
mirror="${DAUMIER_DEBIAN_MIRROR:-$(apt-get indextargets --format '$(SITE)' 'Created-By: Packages' | head -n 1)}"
[ "$(id -u)" = 0 ] || { echo "debian13: debootstrap and chroot need root" >&2; exit 1; }
command -v debootstrap >/dev/null || { echo "debian13: install debootstrap first" >&2; exit 1; }

if [ ! -e "$root/etc/debian_version" ]; then
  debootstrap --variant=minbase trixie "$root" "$mirror"
  cp /etc/apt/apt.conf.d/*proxy* "$root/etc/apt/apt.conf.d/" 2>/dev/null || true
fi
packages="$(echo $build_packages $library_packages libonnxruntime-dev nodejs)"  # one line
if [ "$(cat "$root/etc/daumier-packages" 2>/dev/null)" != "$packages" ]; then
  chroot "$root" env DEBIAN_FRONTEND=noninteractive sh -ec \
    "apt-get update -qq; apt-get install -y -qq --no-install-recommends $packages >/dev/null"
  echo "$packages" >"$root/etc/daumier-packages"
fi

mkdir -p "$root/daumier" "$root/shared"
cleanup() { for folder in daumier shared proc dev; do mountpoint -q "$root/$folder" && umount -lR "$root/$folder"; done; }
trap cleanup EXIT
mount --bind "$source_root" "$root/daumier"
mount -t proc proc "$root/proc"
mount --rbind /dev "$root/dev"  # With /dev/pts, which a test of progress on a terminal opens.
mount --make-rslave "$root/dev"
[ -d "$source_root/../shared" ] && mount --bind "$source_root/../shared" "$root/shared"

chroot "$root" bash -ec "cd /daumier
  cmake --preset $preset -B build/debian13-$preset >/dev/null
  cmake --build build/debian13-$preset -j ${DAUMIER_JOBS:-$(nproc)}
  ctest --test-dir build/debian13-$preset --output-on-failure"
