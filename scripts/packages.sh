#!/bin/sh
# Installs missing Debian packages. Does nothing, and asks for no password, when all are installed.
#
#   scripts/packages.sh PACKAGE... [--optional PACKAGE...]
#
# A missing optional package is a warning: the tests that need it say that they are skipped. With packages such as libgl1:i386, dpkg gets
# that architecture.
set -eu

say() { echo "packages: $*" >&2; }

native=$(dpkg --print-architecture 2>/dev/null || true)

# A name without an architecture means the machine's own, or a package for all of them. dpkg-query has a line for each architecture that is there.
installed() {
    case $1 in
        *:*) wanted=${1##*:} ;;
        *) wanted="$native|all" ;;
    esac
    dpkg-query -W -f='${Architecture} ${db:Status-Status}\n' "$1" 2>/dev/null | grep -qxE "($wanted) installed"
}

# Prints those of its arguments that are not installed.
missing() {
    for package; do
        installed "$package" || printf '%s ' "$package"
    done
}

required= optional= list=required
for word; do
    case $word in
        --optional) list=optional ;;
        *) eval "$list=\"\$$list $word\"" ;;
    esac
done

if ! command -v dpkg-query >/dev/null 2>&1 || ! command -v apt-get >/dev/null 2>&1; then
    say "this is no Debian system; make sure that you have what these Debian packages hold:$required$optional"
    exit 0
fi

# Lists are split into words on purpose from here on.
# shellcheck disable=SC2086
{
    need=$(missing $required)
    want=$(missing $optional)
}
[ -n "$need$want" ] || exit 0

as_root=
if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null 2>&1; then
        say "not root and no sudo; as root, run: apt-get install $need$want"
        [ -z "$need" ] && exit 0
        exit 1
    fi
    as_root=sudo
fi

apt() {
    $as_root env DEBIAN_FRONTEND=noninteractive apt-get -y -q "$@" >&2
}

updated=
update() {
    [ -z "$updated" ] || return 0
    updated=yes
    say "reading the package index"
    apt update || say "apt-get update failed; going on with the index that is there"
}

# A package of another architecture needs that in dpkg, and its index.
for package in $need $want; do
    case $package in
        *:*)
            if ! dpkg --print-foreign-architectures | grep -qx "${package##*:}"; then
                say "adding the architecture ${package##*:}"
                $as_root dpkg --add-architecture "${package##*:}"
                update
            fi
            ;;
    esac
done

available() {
    apt-cache show --no-all-versions "$1" >/dev/null 2>&1
}

# A fresh machine has no package index, and an old index may lack a package.
for package in $need $want; do
    available "$package" || update
done

install() {
    say "installing $*"
    apt install --no-install-recommends "$@" && return 0
    # An older point release of Mesa on the machine can stop the installation half-way. It succeeds after a repair and a
    # second try, as it does after an update where the index is older than the archive.
    update
    apt --fix-broken install || true
    apt install --no-install-recommends "$@"
}

# shellcheck disable=SC2086
if [ -n "$need" ] && ! install $need; then
    say "could not install: $(missing $need)"
    exit 1
fi
for package in $want; do
    if ! available "$package" || ! install "$package"; then
        say "warning: $package is not to be had here; what needs it is skipped"
    fi
done
