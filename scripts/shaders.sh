#!/bin/sh
# Unpacks Debian packages, without installing them, for the shaders in their data and their programs.
#
#   scripts/shaders.sh FOLDER PACKAGE...
#
# A package that cannot be had is a warning: the test says how many shaders it found.
set -eu

folder=$1
shift
mkdir -p "$folder"
cd "$folder"
for package; do
    [ -d "$package" ] && continue
    if ! apt-get download "$package" >/dev/null 2>&1; then
        echo "shaders: $package cannot be had" >&2
        continue
    fi
    dpkg-deb -x "$package"_*.deb "$package.part"
    rm -f "$package"_*.deb
    mv "$package.part" "$package"
done
