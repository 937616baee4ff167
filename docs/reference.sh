#!/usr/bin/env bash
# Draws the pictures of the reference anew: those of symbols, from the models on their pages, and those of docs/examples.
#   docs/reference.sh [PROGRAM]     default: build/release/espalier
# ImageMagick (apt-get install imagemagick) gives the pictures a palette, which makes them small.
set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
espalier="$(realpath "${1:-$root/build/release/espalier}")"
pictures="$root/docs/pictures/reference"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
cd "$root"
rm -rf "$pictures"
mkdir -p "$pictures"

draw() { # NAME FILE
    "$espalier" run "$2" --every 1000000 --output "$work/run" --overwrite --quiet
    "$espalier" render "$work/run" --output "$work/picture.png" --size 360x360 --quiet
    convert "$work/picture.png" -resize 180x180 -colors 32 -strip "$pictures/$1.png"
}

for page in docs/reference/symbols/*.md; do
    name="$(basename "$page" .md)"
    # Colours need a map; queries and symbols without effect draw nothing of their own.
    [[ $name != colour && $name != queries && $name != not-drawn ]] || continue
    sed -n "/<<'END'/,/^END/p" "$page" | sed '1d;$d' >"$work/$name.l"
    draw "symbols-$name" "$work/$name.l"
done
for scene in docs/examples/*.toml; do
    draw "docs-examples-$(basename "$scene" .toml)" "$scene"
done
"$espalier" list --markdown docs
