#!/bin/sh
# Unpacks Debian packages, without installing them, for the shaders in their data and their programs.
#
#   scripts/shaders.sh FOLDER PACKAGE...
#
# A package that is not available is a warning: the test prints the number of shaders that it found.
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
