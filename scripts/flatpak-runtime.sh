#!/bin/sh
# Makes a runtime and a program of Flatpak from a folder with another /usr, and installs them into a folder of their own, for `make test-launch`.
#
# usage: flatpak-runtime.sh ROOT FOLDER: ROOT is what other-usr.sh has made, and FOLDER becomes FLATPAK_USER_DIR
set -eu
root=$1
mkdir -p "$2"
folder=$(cd "$2" && pwd)
if [ -f "$folder/whole" ]; then exit; fi
scratch=$(mktemp -d -p "$(dirname "$folder")")
trap 'rm -rf "$scratch"' EXIT
mkdir -p "$scratch/runtime/files" "$scratch/runtime/var" "$scratch/app/files/bin" "$scratch/app/export"
cp -a "$root/usr" "$scratch/runtime/usr"
mkdir -p "$scratch/runtime/usr/etc"
cp -a "$root/etc/." "$scratch/runtime/usr/etc/"
same="runtime=org.example.Platform/x86_64/1
sdk=org.example.Platform/x86_64/1"
printf '[Runtime]\nname=org.example.Platform\n%s\n' "$same" >"$scratch/runtime/metadata"
printf '[Application]\nname=org.example.Gears\n%s\ncommand=gears\n\n[Context]\nshared=ipc;\nsockets=x11;\n' "$same" >"$scratch/app/metadata"
printf '#!/bin/sh\nexec /usr/bin/glxgears.x86_64-linux-gnu "$@"\n' >"$scratch/app/files/bin/gears"
chmod +x "$scratch/app/files/bin/gears"
flatpak build-export --runtime --no-update-summary "$scratch/repository" "$scratch/runtime" 1
flatpak build-export "$scratch/repository" "$scratch/app" 1
export FLATPAK_USER_DIR="$folder"
flatpak --user remote-add --no-gpg-verify here "$scratch/repository"
flatpak --user install -y --noninteractive here org.example.Platform//1
flatpak --user install -y --noninteractive here org.example.Gears//1
touch "$folder/whole"
