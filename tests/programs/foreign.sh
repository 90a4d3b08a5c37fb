#!/bin/sh
# Runs a program of an i386 package whose amd64 package has the same paths, so that dpkg cannot have both:
#
#   foreign.sh PACKAGE PATH [ARGUMENT...]
#
# The package is downloaded and unpacked into target/programs/i386 once; its libraries and its data are installed as other packages.
set -eu
package=$1 program=$2
shift 2
root=$PWD/target/programs/i386
if ! [ -x "$root$program" ]; then
    mkdir -p "$root.deb"
    (cd "$root.deb" && apt-get -q -o APT::Sandbox::User=root download "$package:i386" >&2)
    dpkg -x "$root.deb/${package}"_*_i386.deb "$root"
fi
exec "$root$program" "$@"
