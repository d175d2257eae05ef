# Roots of Debian and Ubuntu by debootstrap, for scripts that source this file after setting `source` and `say`. Only root may make them.
# Kept in /var/cache/lavalight, and made anew where one is not there. Exits with 77 where there are no means.

# need_root WHAT: only root may do it; the script then starts anew in a namespace whose mounts go with it, however it ends.
need_root() {
    if [ "$(id -u)" -ne 0 ]; then
        say "cannot make $1: only root may; try sudo $0"
        exit 77
    fi
}

# Fetches the keys that sign Ubuntu's archive. Debian has no package of them; Ubuntu's is known by its hash.
fetch_ubuntu_keys() {
    local keys="$1" mirror="$2" work
    [ ! -s "$keys" ] || return 0
    work="$(mktemp -d)"
    python3 - "$mirror/pool/main/u/ubuntu-keyring/ubuntu-keyring_2023.11.28.1_all.deb" "$work/keyring.deb" <<'PYTHON'
import hashlib, pathlib, sys, urllib.request
package = urllib.request.urlopen(sys.argv[1], timeout=60).read()
if hashlib.sha256(package).hexdigest() != "36de43b15853ccae0028e9a767613770c704833f82586f28eb262f0311adb8a8":
    sys.exit(f"cannot trust {sys.argv[1]}: its hash is another one")
pathlib.Path(sys.argv[2]).write_bytes(package)
PYTHON
    dpkg-deb --extract "$work/keyring.deb" "$work/files"
    mkdir -p "$(dirname "$keys")"
    cp "$work/files/usr/share/keyrings/ubuntu-archive-keyring.gpg" "$keys"
    rm -rf "$work"
}

# make_root SUITE FOLDER: a minimal Debian or Ubuntu with certificates, whole or absent.
make_root() {
    local suite="$1" root="$2" options=() mirror="${LAVALIGHT_MIRROR:-http://deb.debian.org/debian}" script=()
    [ ! -e "$root/etc/debian_version" ] || return 0
    if ! command -v debootstrap >/dev/null && ! "$source/tools/setup" debootstrap; then
        say "cannot make a root of $suite: debootstrap is not installed"
        exit 77
    fi
    say "installing $suite into $root"
    rm -rf "$root.part"
    mkdir -p "$root.part"
    case "$suite" in
    jammy | noble | plucky | questing | resolute) # Ubuntu; one script serves all, and an older debootstrap lacks their names
        mirror="${LAVALIGHT_UBUNTU_MIRROR:-http://archive.ubuntu.com/ubuntu}"
        fetch_ubuntu_keys "$(dirname "$root")/ubuntu-archive-keyring.gpg" "$mirror"
        options=(--components=main,universe "--keyring=$(dirname "$root")/ubuntu-archive-keyring.gpg")
        script=(/usr/share/debootstrap/scripts/gutsy)
        ;;
    esac
    debootstrap --variant=minbase --include=ca-certificates "${options[@]}" "$suite" "$root.part" "$mirror" "${script[@]}" >&2
    mv "$root.part" "$root"
}

# share_network FOLDER: the names of hosts, proxies and certificates are this machine's.
share_network() {
    local root="$1" file
    for file in /etc/resolv.conf /etc/hosts; do
        [ ! -e "$file" ] || cp --dereference "$file" "$root$file"
    done
    if [ -d /usr/local/share/ca-certificates ]; then
        cp -r /usr/local/share/ca-certificates/. "$root/usr/local/share/ca-certificates/"
        chroot "$root" update-ca-certificates >/dev/null 2>&1
    fi
    { grep -slE '^Acquire::' /etc/apt/apt.conf.d/* || true; } | while read -r file; do cp "$file" "$root/etc/apt/apt.conf.d/"; done
}

# mount_system FOLDER: what programs expect of a running system.
mount_system() {
    mkdir -p "$1/proc" "$1/dev" "$1/sys"
    mount -t proc proc "$1/proc"
    mount --rbind /dev "$1/dev"
    mount --rbind /sys "$1/sys"
    mount -t tmpfs tmpfs "$1/tmp"
}

# The environment of programs inside. GLFW 3.4 asks for Wayland first, whose library complains where there is no such folder.
inside_environment=(PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 XDG_RUNTIME_DIR=/tmp)
for name in http_proxy https_proxy no_proxy HTTP_PROXY HTTPS_PROXY NO_PROXY; do
    [ -z "${!name:-}" ] || inside_environment+=("$name=${!name}")
done

# make_work: an empty folder in `roots`, as `work`.
make_work() {
    mkdir -p "$roots"
    work="$(mktemp -d "$roots/work.XXXXXX")"
}

# enter_clean SUITE: a clean root of that suite with a writable layer of its own in `work`, as `root`. Wants `roots` and `work`.
enter_clean() {
    local suite="$1" layer
    make_root "$suite" "$roots/clean-$suite"
    layer="$(mktemp -d "$work/$suite.XXXXXX")"
    root="$layer/root"
    mkdir -p "$layer/upper" "$layer/work" "$root"
    mount -t overlay overlay -o "lowerdir=$roots/clean-$suite,upperdir=$layer/upper,workdir=$layer/work" "$root"
    share_network "$root"
    mount_system "$root"
}

leave_clean() {
    [ -z "$root" ] || umount --recursive "$root"
    root=""
}

inside() { chroot "$root" /usr/bin/env -i "${inside_environment[@]}" "$@"; }
