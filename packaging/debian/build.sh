#!/bin/sh
# Makes Debian packages of what `make install` puts to PREFIX: manyview_VERSION_amd64.deb and, where the library for 32-bit programs is built,
# libmanyview_VERSION_i386.deb.
#
# usage: build.sh FOLDER: where the packages are put. make deb runs it; make install takes BIN and CARGO_TARGET_DIR of the environment.
#
# DEBFULLNAME and DEBEMAIL name the maintainer (devscripts(1)); SOURCE_DATE_EPOCH is the date of the packages, else that of the last commit.
set -eu
[ $# -eq 1 ] || { echo "usage: build.sh FOLDER" >&2; exit 2; }
mkdir -p "$1"
out=$(cd "$1" && pwd)
here=$(cd "$(dirname "$0")" && pwd)
source=$(cd "$here/../.." && pwd)
cd "$source"

for tool in dpkg-deb dpkg-shlibdeps strip gzip; do
	command -v $tool >/dev/null || { echo "$tool is missing: run apt-get install dpkg-dev binutils gzip, then make deb again" >&2; exit 1; }
done
version=$(sed -n '/^\[workspace.package\]/,/^\[/s/^version = "\(.*\)"/\1/p' Cargo.toml)
[ -n "$version" ] || { echo "Cargo.toml has no version in [workspace.package]" >&2; exit 1; }
maintainer="${DEBFULLNAME:-The manyview authors} <${DEBEMAIL:-manyview@packages.invalid}>"
: "${SOURCE_DATE_EPOCH:=$(git log -1 --format=%ct 2>/dev/null || stat -c %Y CHANGELOG.md)}"
export SOURCE_DATE_EPOCH

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
trap 'exit 1' HUP INT TERM
# Files of a package are readable by all, whatever mask the builder has.
umask 022

# The man pages are those of the built command, which runs here.
wide=$scratch/amd64
make --no-print-directory install DESTDIR="$wide" PREFIX=/usr ${BIN:+"BIN=$BIN"} >&2
lib=$wide/usr/lib/manyview

# Two packages: one of amd64 cannot say that a library of i386 needs the C library of i386, and dpkg could not install it where i386 is not added.
narrow=
if [ -d "$lib/32" ]; then
	narrow=$scratch/i386
	mkdir -p "$narrow/usr/lib/i386-linux-gnu"
	mv "$lib/32" "$narrow/usr/lib/i386-linux-gnu/manyview"
	# Profiles are looked for beside the library.
	ln -s ../../manyview/profiles "$narrow/usr/lib/i386-linux-gnu/manyview/profiles"
fi
# The links are in the package of the command, also without that of i386: the command takes both classes where the link of 32 bits leads to a library, so that
# installing the other package is enough.
sh scripts/by-class.sh "$lib" ../../../i386-linux-gnu/manyview/libmanyview.so
# LD_PRELOAD='/usr/$LIB/manyview/libmanyview.so' serves both classes without the command.
mkdir -p "$wide/usr/lib/x86_64-linux-gnu/manyview"
ln -s ../../manyview/libmanyview.so "$wide/usr/lib/x86_64-linux-gnu/manyview/libmanyview.so"

# Debian's zsh reads completions of packages from here.
if [ -d "$wide/usr/share/zsh/site-functions" ]; then
	mv "$wide/usr/share/zsh/site-functions" "$wide/usr/share/zsh/vendor-completions"
fi
# The licence is in the copyright file.
rm -f "$wide/usr/share/doc/manyview/LICENSE"
find "$wide/usr/share/man" -type f -exec gzip -9n {} +

is_elf() { [ "$(head -c 4 "$1" | tr -d '\177')" = ELF ]; }

# Prints the files of a tree that are programs or libraries.
binaries() {
	find "$1" -type f | sort | while IFS= read -r file; do
		if is_elf "$file"; then printf '%s\n' "$file"; fi
	done
}

# Prints what the binaries of a tree are linked with, as the value of Depends.
linked() {
	mkdir -p "$scratch/shlibs/debian"
	# dpkg-shlibdeps wants one.
	printf 'Source: manyview\n\nPackage: manyview\nArchitecture: any\n' >"$scratch/shlibs/debian/control"
	binaries "$1" >"$scratch/shlibs/files"
	(
		cd "$scratch/shlibs"
		# Paths of a temporary folder have no spaces.
		# shellcheck disable=SC2046
		DEB_HOST_ARCH=$2 dpkg-shlibdeps --warnings=0 -O $(cat files)
	) | sed -n 's/^shlibs:Depends=//p'
}

# The licence, the licences of what is compiled in, and the changes.
documents() {
	doc=$1/usr/share/doc/$2
	mkdir -p "$doc"
	{
		cat "$here/copyright"
		echo "License: Expat"
		# An empty line would end the paragraph.
		sed -n '/^Permission/,$p' LICENSE | sed 's/^$/./; s/^/ /'
	} >"$doc/copyright"
	date=$(LC_ALL=C date -u -R -d "@$SOURCE_DATE_EPOCH")
	printf 'manyview (%s) unstable; urgency=medium\n\n  * CHANGELOG.md of manyview has the changes.\n\n -- %s  %s\n' \
		"$version" "$maintainer" "$date" | gzip -9n >"$doc/changelog.gz"
}

# Makes the package of a tree, with the fields of a template. Depends comes from what the binaries are linked with. Recommends is written by hand: the viewer of point
# clouds opens libraries of X11, Wayland and OpenGL by name, those of the window system that it finds, and `capture` and `doctor` start an Xvfb where there is no screen.
package() {
	tree=$1 name=$2 architecture=$3
	documents "$tree" "$name"
	binaries "$tree" | while IFS= read -r file; do strip --strip-unneeded --remove-section=.comment --remove-section=.note "$file"; done
	# By this folder dpkg-shlibdeps knows a tree as a package.
	mkdir -p "$tree/DEBIAN"
	depends=$(linked "$tree" "$architecture")
	[ -n "$depends" ] || { echo "dpkg-shlibdeps finds nothing that $name is linked with" >&2; exit 1; }
	size=$(du -k --apparent-size -s --exclude=DEBIAN "$tree" | cut -f1)
	# Alternatives of a dependency have a |.
	sed -e "s%@VERSION@%$version%" -e "s%@MAINTAINER@%$maintainer%" -e "s%@LINKED@%$depends%" -e "s%@SIZE@%$size%" \
		"$here/$name.control" >"$tree/DEBIAN/control"
	if [ -f "$here/$name.lintian-overrides" ]; then
		install -D -m 644 "$here/$name.lintian-overrides" "$tree/usr/share/lintian/overrides/$name"
	fi
	(cd "$tree" && find usr -type f | LC_ALL=C sort | xargs md5sum) >"$tree/DEBIAN/md5sums"
	chmod -R u+w,go-w "$tree"
	dpkg-deb --root-owner-group -Zxz --build "$tree" "$out/${name}_${version}_$architecture.deb"
}

# A package of an earlier build would be taken for one of this.
rm -f "$out"/manyview_*.deb "$out"/libmanyview_*.deb
package "$wide" manyview amd64
if [ -n "$narrow" ]; then
	package "$narrow" libmanyview i386
else
	echo "The library for 32-bit programs is not built: run make build-32, then make deb, to have its package as well" >&2
fi
