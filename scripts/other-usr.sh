#!/bin/sh
# Makes a Debian of another release in a folder, with OpenGL for programs of 64 and of 32 bits: the /usr of the containers of `make test-launch`.
#
# usage: other-usr.sh FOLDER
set -eu
folder=$1 release=trixie
wanted="libgl1 libegl1 libgl1-mesa-dri libx11-6 libwayland-egl1 libpng16-16t64"
# A folder that was made with other packages is made anew.
if [ "$(cat "$folder/whole" 2>/dev/null)" = "$release $wanted" ]; then exit; fi
rm -rf "$folder"
mkdir -p "$(dirname "$folder")"
# shellcheck disable=SC2086
debootstrap --variant=minbase --include=mesa-utils-bin,"$(echo $wanted | tr ' ' ,)" "$release" "$folder"
chroot "$folder" dpkg --add-architecture i386
chroot "$folder" apt-get update
narrow=$(for name in $wanted mesa-utils-bin; do echo "$name:i386"; done)
# shellcheck disable=SC2086
chroot "$folder" apt-get install -y --no-install-recommends $narrow
echo "$release $wanted" > "$folder/whole"
