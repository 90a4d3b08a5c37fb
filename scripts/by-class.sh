#!/bin/sh
# Links the layer's libraries under the names by which loaders replace $LIB in LD_PRELOAD, so that one value serves programs of 64 and of 32 bits.
#
# usage: by-class.sh FOLDER NARROW: FOLDER has libmanyview.so of 64 bits; NARROW is that of 32 bits, absolute or as seen from FOLDER/by-class/32.
set -eu
folder=$1 narrow=$2 name=libmanyview.so
cd "$folder"
rm -rf by-class
mkdir -p by-class/64 by-class/32 by-class/lib
ln -s "../../$name" "by-class/64/$name"
ln -s "$narrow" "by-class/32/$name"
# Debian and its relatives, and the runtime of Steam.
ln -s ../64 by-class/lib/x86_64-linux-gnu
ln -s ../32 by-class/lib/i386-linux-gnu
# Fedora and openSUSE have lib64 and lib, Arch has lib and lib32. What the loader here makes of it, it tells where it finds nothing.
ln -s 64 by-class/lib64
ln -s 32 by-class/lib32
told=$(LD_PRELOAD='/nowhere/$LIB/none' /bin/true 2>&1 || true)
case $told in
*/nowhere/lib/none*) ln -s ../64/$name by-class/lib/$name ;;
*) ln -s ../32/$name by-class/lib/$name ;;
esac
