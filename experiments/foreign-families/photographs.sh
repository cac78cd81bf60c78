#!/usr/bin/env bash
# Fetches three photographs of trees with alpha from the Debian package tuxpaint-stamps-default (GPL-2), 160 MB.
# Run from the root of the repository; needs dpkg.
set -eu
version=2022.06.04-1
into=experiments/foreign-families/photographs
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
curl -fsSL -o "$work/stamps.deb" \
    "https://deb.debian.org/debian/pool/main/t/tuxpaint-stamps/tuxpaint-stamps-default_${version}_all.deb"
dpkg -x "$work/stamps.deb" "$work"
mkdir -p "$into"
trees=$work/usr/share/tuxpaint/stamps/plants/trees
cp "$trees/holm_oak.png" "$into/holm_oak.png"
cp "$trees/tree336.png" "$into/pili_nut.png"
cp "$trees/liberia-palm.png" "$into/palm.png"
