#!/usr/bin/env bash
# Installs what Luciole is built from, where it is missing. `scripts/packages.sh test` adds what the tests need.
# Knows Debian 12 and Ubuntu 24.04; elsewhere it names the packages and goes on.
set -euo pipefail

packages=(g++ cmake ninja-build pkg-config libvulkan-dev mesa-vulkan-drivers vulkan-validationlayers glslc
    libembree-dev libopenexr-dev libspng-dev libturbojpeg0-dev libglm-dev nlohmann-json3-dev libcli11-dev libfmt-dev zlib1g-dev
    doctest-dev python3-jsonschema)
# Node.js bundles the page of `luciole compare`. Other distributors' nodejs brings npm along and refuses Debian's.
command -v node >/dev/null && command -v npm >/dev/null || packages+=(nodejs npm)
if [[ "${1:-}" == test ]]; then packages+=(clang python3-skimage openimageio-tools graphviz); fi

is_installed() { [[ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null || true)" == installed ]]; }

as_root() {
    if [[ $EUID -eq 0 ]]; then
        "$@"
    elif command -v sudo >/dev/null; then
        sudo "$@"
    else
        echo "packages: not root and no sudo; run as root: $*" >&2
        return 1
    fi
}

install_missing() {
    local missing=() package
    for package in "$@"; do is_installed "$package" || missing+=("$package"); done
    if [[ ${#missing[@]} -eq 0 ]]; then return; fi
    echo "packages: installing ${missing[*]}"
    as_root apt-get update -q
    as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "${missing[@]}"
}

# The sanitizer and fuzzer libraries come in a package of their own, one per version of clang.
clang_has_runtime() {
    echo 'extern "C" int LLVMFuzzerTestOneInput(const char*, unsigned long) { return 0; }' |
        clang++ -fsanitize=fuzzer,address -x c++ - -o /dev/null 2>/dev/null
}

# What apps/report is bundled and tested with, as its lock file says. Nothing is downloaded later, while building.
install_node_packages() {
    local folder installed
    folder="$(dirname "${BASH_SOURCE[0]}")/../apps/report"
    installed="$folder/node_modules/.package-lock.json"
    if [[ -e "$installed" && ! "$folder/package-lock.json" -nt "$installed" ]]; then return; fi
    echo "packages: npm ci in apps/report"
    npm ci --prefix "$folder" --no-audit --no-fund || echo "packages: that failed; all but luciole compare will work" >&2
}

distribution=unknown
if [[ -r /etc/os-release ]]; then distribution="$(. /etc/os-release && echo "${ID:-}-${VERSION_ID:-}")"; fi
case "$distribution" in
    debian-12 | ubuntu-24.04)
        # The browser that tests/report opens. Ubuntu's package is an empty stand-in for a snap; the test is skipped there.
        if [[ "${1:-}" == test && "$distribution" == debian-12 ]]; then packages+=(chromium); fi
        install_missing "${packages[@]}"
        if [[ "${1:-}" == test ]] && ! clang_has_runtime; then
            install_missing "libclang-rt-$(clang++ -dumpversion | cut -d. -f1)-dev"
        fi
        ;;
    *)
        echo "packages: written for Debian 12 and Ubuntu 24.04. On this system, please see to it that these or their"
        echo "packages: counterparts are installed: ${packages[*]}"
        ;;
esac
if command -v npm >/dev/null; then install_node_packages; fi
