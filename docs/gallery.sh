#!/usr/bin/env bash
# Makes docs/gallery.md and its pictures anew: a picture for each published system that the library has.
#   docs/gallery.sh [PROGRAM]     default: build/release/espalier
# ffmpeg (apt-get install ffmpeg) gives the pictures a palette, which makes them small.
set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
espalier="$(realpath "${1:-$root/build/release/espalier}")"
pictures="docs/pictures/gallery"
page="docs/gallery.md"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
cd "$root"
rm -rf "$pictures" && mkdir -p "$pictures"

columns=4
count=0
row=""

section() { # TITLE
    end_row
    printf '\n## %s\n\n' "$1" >>"$page"
    printf '| %.0s' 1 2 3 4 >>"$page"
    printf '|\n|---|---|---|---|\n' >>"$page"
}
end_row() {
    [[ -n $row ]] && printf '%s|\n' "$row" >>"$page"
    row=""
    count=0
}
# The options of `run` that make the plant, and after -- those of `render`.
system() { # NAME "TITLE" "SOURCE" FILE [OPTIONS] [-- RENDER OPTIONS]
    local name="$1" title="$2" source="$3" file="$4" growing=() looking=()
    shift 4
    while [[ $# -gt 0 && $1 != -- ]]; do growing+=("$1") && shift; done
    [[ $# -gt 0 ]] && shift && looking=("$@")
    "$espalier" run "$file" "${growing[@]}" --every 1000000 --output "$work/$name" --quiet 2>/dev/null
    "$espalier" render "$work/$name" --output "$work/$name.png" --size 240x240 --quiet "${looking[@]}"
    cell "$name" "$title" "$source" "$(command_of "$file" "${growing[@]}")"
}
# Plants of other runs of this script on a terrain.
landscape() { # NAME "TITLE" "SOURCE" FILE [OPTIONS]
    "$espalier" landscape "$4" --output "$work/$1.png" --size 240x240 --quiet "${@:5}"
    cell "$1" "$2" "$3" "espalier landscape $4"
}
cell() { # NAME "TITLE" "SOURCE" "COMMAND"
    local palette="split[a][b];[a]palettegen=max_colors=64:stats_mode=full[p];[b][p]paletteuse=dither=none"
    ffmpeg -loglevel error -y -i "$work/$1.png" -filter_complex "$palette" -fflags +bitexact "$pictures/$1.png"
    row+="| ![$2](pictures/gallery/$1.png)<br>**$2**<br>$3<br>\`$4\` "
    count=$((count + 1))
    [[ $count -lt $columns ]] || end_row
}
command_of() { # FILE [OPTIONS]
    printf 'espalier run %s' "$1"
    shift
    [[ $# -eq 0 ]] || printf ' %s' "$@"
}

cat >"$page" <<'PAGE'
# Gallery

One picture for each published system that the library has, with the command that grows it. `docs/gallery.sh` makes this page.
`espalier render MODEL` draws a model at once; [models](models.md) says what the tests prove of each.
PAGE

section "Curves and strings"
system koch "Snowflake" "von Koch 1904" models/curves/koch-snowflake.l
system hilbert "Curve in space" "Hilbert 1891, Voorhies 1991" models/curves/hilbert-3d.l
system dragon "Dragon" "Davis & Knuth 1970" models/curves/dragon.l
system gosper "Flowsnake" "Gosper, in Gardner 1976" models/curves/gosper.l
system penrose "Tiling" "Penrose 1974" models/curves/penrose.l
system islands "Islands and lakes" "Mandelbrot 1982" models/curves/islands-and-lakes.l
system pythagoras "Pythagoras' tree" "Bosman 1942" models/brackets/pythagoras.l
system automaton "Cellular automaton" "Wolfram 1983" models/cells/elementary-automaton.l
system ulam "Cells" "Ulam 1962" environments/ulam.toml -- --azimuth 0 --elevation 90 --no-ground
system hogeweg "Pattern of signals" "Hogeweg & Hesper 1974" models/signals/hogeweg-hesper-c.l
system levy "C curve" "Levy 1938" models/curves/levy.l
end_row

section "Herbs, leaves and flowers"
system bush "Bush" "Prusinkiewicz & Lindenmayer 1990" models/brackets/bush.l
system flowering "Flowering plant" "Prusinkiewicz & Lindenmayer 1990" models/brackets/flowering-plant.l
system lychnis "Lychnis" "Robinson 1986" models/herbs/lychnis.l
system mycelis "Wall lettuce" "Janssen & Lindenmayer 1987" models/herbs/mycelis.l
system lilac "Lilac" "Prusinkiewicz & Lindenmayer 1990" models/herbs/lilac.l
system carrot "Wild carrot" "Prusinkiewicz & Lindenmayer 1990" models/herbs/wild-carrot.l
system lily "Lily of the valley" "Prusinkiewicz & Lindenmayer 1990" models/herbs/lily-of-the-valley.l
system crocus "Crocus" "Prusinkiewicz & Lindenmayer 1990" models/herbs/crocus.l
system fern "Fern that unrolls" "after Prusinkiewicz & Lindenmayer 1990" models/leaves/fern.l
system compound "Compound leaf" "Prusinkiewicz & Lindenmayer 1990" models/leaves/compound-leaf.l
system rose-leaf "Serrated leaf" "Prusinkiewicz & Lindenmayer 1990" models/leaves/rose-leaf.l
system field "Field of flowers" "Prusinkiewicz & Lindenmayer 1990" models/stochastic/flower-field.l
system timed-leaf "Leaf in continuous time" "Prusinkiewicz & Lindenmayer 1990" models/leaves/compound-leaf-timed.l --define TIME=11
end_row

section "Phyllotaxis"
system vogel "Disc" "Vogel 1979" models/phyllotaxis/disc.l
system sunflower "Sunflower head" "Vogel 1979" models/phyllotaxis/sunflower-head.l
system zinnia "Zinnia" "Prusinkiewicz & Lindenmayer 1990" models/phyllotaxis/zinnia.l
system pineapple "Pineapple" "Ridley 1986" models/phyllotaxis/pineapple.l
system collision "Organs that touch" "Fowler, Prusinkiewicz & Battjes 1992" models/phyllotaxis/collision.l -- --elevation 25
system gourd "Organs on a drawn profile" "Fowler, Prusinkiewicz & Battjes 1992" models/phyllotaxis/collision.l --view models/phyllotaxis/gourd.v --define SHAPE=4 -- --elevation 15
system pressure "Contact pressure" "Adler 1974" models/phyllotaxis/contact-pressure.l
system meinhardt "Reaction and diffusion" "Meinhardt 1982" environments/reaction-diffusion.toml
system veins "Nets" "Meinhardt 1976" environments/vein-net.toml
end_row

section "Trees"
system honda "Two branches" "Honda 1971" models/trees/honda.l
system aono "Constant angles" "Aono & Kunii 1984" models/trees/aono-kunii.l
system oppenheimer "Fractal tree" "Oppenheimer 1986" models/trees/oppenheimer.l
system maple "Bark, saddles and roots" "Bloomenthal 1985" models/trees/maple.l --view models/trees/maple.v -- --skin smooth
system particles "Structured particles" "Reeves & Blau 1985" models/trees/structured-particles.l
system amap "Buds that die, rest or grow" "de Reffye et al. 1988" models/trees/buds.l
system viennot "Ramification matrix" "Viennot et al. 1989" models/trees/ramification.l
system holton "Strands" "Holton 1994" models/trees/holton.l
system aspen "Quaking aspen" "Weber & Penn 1995" models/species/quaking-aspen.species
system palm "Palm" "Weber & Penn 1995" models/species/coconut-palm.species
system willow "Weeping willow" "Lintermann & Deussen 1997" models/pgraph/weeping-willow.pgraph
system dandelion "Dandelion" "Lintermann & Deussen 1997" models/pgraph/dandelion.pgraph -- --background light
system spruce "Skeleton with fibres" "Szemla 1999" models/sdl/spruce.sdl
system borchert "Apical control" "Borchert & Honda 1984" models/trees/vigour.l
system ternary "Bent by a tropism" "Prusinkiewicz & Lindenmayer 1990" models/trees/ternary.l
system colonization "Space colonization" "Runions, Lane & Prusinkiewicz 2007" environments/tree.toml
system palubicki "Self-organizing tree" "Palubicki et al. 2009" environments/self-organizing.toml --set plant.0.define.YEARS=16
system wind "Wind" "Weber & Penn 1995" environments/wind.toml
end_row

section "Plants and their environment"
system two-trees "Competition for light" "Mech & Prusinkiewicz 1996, Takenaka 1994" environments/two-trees.toml
system forest "Forest patch" "Mech & Prusinkiewicz 1996" environments/forest-patch.toml -- --azimuth 20
system roots "Roots and water" "Clausnitzer & Hopmans 1994" environments/two-roots.toml -- --field water:volume --no-legend
system topiary "Topiary" "Prusinkiewicz, James & Mech 1994" environments/topiary-3d.toml -- --azimuth 25
system terminalia "Tiers that keep apart" "Honda, Tomlinson & Fisher 1981" environments/terminalia.toml -- --azimuth 0 --elevation 90
system cohen "Growth in a field" "Cohen 1967" environments/cohen.toml
system vines "Voxel vines" "Greene 1989" environments/vines.toml -- --azimuth 25
system climber "Climber" "Arvo & Kirk 1988" environments/climber.toml
system thinning "Self-thinning" "Deussen et al. 1998" environments/self-thinning.toml -- --elevation 90
for species in species/black-oak.species species/european-larch.species pgraph/bush.pgraph; do
    "$espalier" run "models/$species" --every 1000000 --output "$work/planted/$(basename "${species%.*}")" --quiet 2>/dev/null
done
landscape landscape "Landscape" "Deussen et al. 1998" environments/landscapes/hills.toml \
    --set stand.run="$work/thinning" --set species.0.run="$work/planted/black-oak" \
    --set species.1.run="$work/planted/european-larch" --set species.2.run="$work/planted/bush" --set camera.angle=25
end_row
