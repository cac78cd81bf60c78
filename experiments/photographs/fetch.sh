#!/usr/bin/env bash
# Fetches the pictures of trees from the Debian packages torcs-data (GPL-2+ and others) and tuxpaint-stamps-default
# (GPL-2), 480 MB, and puts the cut-outs into experiments/photographs/pictures.
# Run from the root of the repository; needs dpkg, and python3 with Pillow for the two files in SGI's format.
set -eu
torcs=1.3.7+dfsg-5
stamps=2022.06.04-1
pool=https://deb.debian.org/debian/pool/main/t
into=experiments/photographs/pictures
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
curl -fsSL -o "$work/torcs.deb" "$pool/torcs/torcs-data_${torcs}_all.deb"
curl -fsSL -o "$work/stamps.deb" "$pool/tuxpaint-stamps/tuxpaint-stamps-default_${stamps}_all.deb"
dpkg -x "$work/torcs.deb" "$work"
dpkg -x "$work/stamps.deb" "$work"
game=$work/usr/share/games/torcs
trees=$work/usr/share/tuxpaint/stamps/plants/trees
mkdir -p "$into/tuned" "$into/judged"

while read -r set name from; do
    to=$into/$set/$name.png
    case $from in
        *.rgb) python3 -c 'import sys; from PIL import Image; Image.open(sys.argv[1]).save(sys.argv[2])' \
            "$game/$from" "$to" ;;
        */*) cp "$game/$from" "$to" ;;
        *) cp "$trees/$from" "$to" ;;
    esac
done <<'PICTURES'
tuned loose tracks/dirt/dirt-2/tree10_n.png
tuned forked tracks/dirt/dirt-2/tree15_n.png
tuned conifer tracks/road/alpine-2/tree3_n.png
tuned bare tracks/road/alpine-2/tree7_n.png
tuned round tracks/road/brondehach/tree1_n.png
tuned ivy tracks/road/e-track-3/tree12_n.png
tuned apple tracks/road/e-track-6/tree_apple_n.png
tuned maple tracks/road/e-track-6/tree_maple_n.png
tuned slim_conifer tracks/road/ruudskogen/rk_tree_3_n.png
tuned flat tracks/road/wheel-1/tree6_n.png
judged airy tracks/dirt/dirt-2/tree13_n.png
judged snowy_conifer tracks/road/alpine-2/tree1_n.png
judged brown tracks/road/corkscrew/tree3_n.png
judged autumn tracks/road/corkscrew/tree_n.png
judged broad tracks/road/e-track-2/tree11_n.png
judged slender tracks/road/e-track-3/tree195_n.png
judged bushy tracks/road/e-track-6/tree_bush_n.png
judged dark tracks/road/forza/treetd_n.png
judged tall tracks/road/forza/tree3_n.png
judged wide tracks/road/g-track-1/tree53_n.rgb
judged dome tracks/road/wheel-2/tree_n.png
judged one_sided tracks/road/wheel-2/treeg11_n.png
judged gum tracks/dirt/dirt-3/tree_gum_arbor_n.png
judged open_gum tracks/dirt/dirt-3/tree_gum2_arbor_n.png
judged dense data/textures/treeg1.rgb
judged bare_birch birch.png
judged pili_nut tree336.png
judged palm liberia-palm.png
PICTURES
