#!/usr/bin/env bash
# Makes docs/gallery.md and its pictures anew: shelves with every model and scene of the library, as in the studio's gallery.
#   docs/gallery.sh [PROGRAM [FILE...]]     default: build/release/espalier, and the pictures of all files
# ffmpeg (apt-get install ffmpeg) gives the pictures a palette, which makes them small.
set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
espalier="$(realpath "${1:-$root/build/release/espalier}")"
only=" ${*:2} "
pictures="docs/pictures/gallery"
page="docs/gallery.md"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
cd "$root"
[[ $# -gt 1 ]] || rm -rf "$pictures"
mkdir -p "$pictures"

columns=4
count=0

shelf() { # TITLE
    end_row
    printf '\n## %s\n\n| | | | |\n|---|---|---|---|\n' "$1" >>"$page"
}
# The options of `run` that make the plant, and after -- those of `render`.
entry() { # FILE "TITLE" "SOURCE" [OPTIONS] [-- RENDER OPTIONS]
    local file="$1" title="$2" source="$3" growing=()
    shift 3
    while [[ $# -gt 0 && $1 != -- ]]; do growing+=("$1") && shift; done
    cell "$file" "$title" "$source" "$(name_of "$file")" "$file ${growing[*]}"
    [[ $only == "  " || $only == *" $file "* ]] || return 0
    [[ $(jobs -rp | wc -l) -lt $(nproc) ]] || wait -n
    draw "$(name_of "$file")" "$file" "${#growing[@]}" "${growing[@]}" "${@:2}" &
}
# A model that shows little without the environment of a scene: it has the scene's picture.
grown_by() { # SCENE FILE "TITLE" "SOURCE"
    cell "$2" "$3" "$4" "$(name_of "$1")" "$1"
}
cell() { # FILE "TITLE" "SOURCE" NAME "WHAT IS RUN"
    printf '| ![%s](pictures/gallery/%s.png)<br>[**%s**](../%s)<br>%s<br>`espalier run %s` ' \
        "$2" "$4" "$2" "$1" "$3" "${5% }" >>"$page"
    count=$((count + 1))
    [[ $count -lt $columns ]] || end_row
}
end_row() {
    [[ $count -eq 0 ]] || printf '|\n' >>"$page"
    count=0
}
name_of() { # FILE
    local name="${1#models/}"
    name="${name%.*}"
    printf '%s' "${name//\//-}"
}
draw() { # NAME FILE NUMBER OPTIONS RENDER-OPTIONS
    local run="$work/$1" picture="$work/$1.png" size=(--size 180x180) colours=32 palette
    [[ $* != *" --size "* ]] || size=()  # what is thinner than a pixel is drawn larger and made smaller
    [[ $* != *" --light"* ]] || size+=(--samples 32) colours=64
    palette="scale=180:180:flags=area,split[a][b];[a]palettegen=max_colors=$colours:stats_mode=full[p];[b][p]paletteuse=dither=none"
    "$espalier" run "$2" "${@:4:$3}" --every 1000000 --output "$run" --quiet 2>/dev/null
    "$espalier" render "$run" --output "$picture" "${size[@]}" --quiet "${@:4+$3}"
    ffmpeg -nostdin -loglevel error -y -i "$picture" -filter_complex "$palette" -fflags +bitexact "$pictures/$1.png"
    rm -rf "$run"
}

cat >"$page" <<'PAGE'
# Gallery

Every model and scene of the library, with the command that grows what the picture shows. `docs/gallery.sh` makes this page and its
pictures, and the studio's gallery has the same shelves. [Models](models.md) says what the tests prove of each model,
[experiments](experiments.md) what those of the scenes measure.
PAGE

shelf "Trees and shrubs"
entry environments/tree.toml "Tree from a cloud of points" "Runions, Lane & Prusinkiewicz 2007" -- --light
entry environments/self-organizing.toml "Self-organizing tree" "Palubicki et al. 2009" --set plant.0.define.YEARS=16 -- --light
entry models/species/balsam-fir.species "Balsam fir" "parameters of Weber & Penn 1995" -- --light
entry models/species/black-oak.species "California black oak" "Weber & Penn 1995" --seed 4 --define BaseSize=0.15 -- --light
entry models/species/black-tupelo.species "Black tupelo" "Weber & Penn 1995" -- --light
entry models/species/coconut-palm.species "Coconut palm" "Weber & Penn 1995" -- --light
entry models/species/european-larch.species "European larch" "parameters of Weber & Penn 1995" -- --light
entry models/species/lombardy-poplar.species "Lombardy poplar" "parameters of Weber & Penn 1995" -- --light
entry models/species/quaking-aspen.species "Quaking aspen" "Weber & Penn 1995" -- --light
entry models/species/sassafras.species "Sassafras" "parameters of Weber & Penn 1995" -- --light
entry models/species/weeping-willow.species "Weeping willow" "Weber & Penn 1995" -- --light
entry environments/species/broadleaf.toml "Broadleaved tree by its age" "Lintermann & Deussen 1997" -- --light
entry environments/species/palm.toml "Palm by its age" "Lintermann & Deussen 1997" -- --light
entry environments/species/willow.toml "Weeping willow by its age" "Lintermann & Deussen 1997" -- --light
entry models/trees/honda.l "Two branches at different angles" "Honda 1971"
entry models/trees/aono-kunii.l "Two constant angles" "Aono & Kunii 1984"
entry models/trees/monopodial.l "Trees with one leading axis" "Prusinkiewicz & Lindenmayer 1990, figure 2.6" -- --size 360x360
entry models/trees/sympodial.l "Trees whose apices fork" "Prusinkiewicz & Lindenmayer 1990, figure 2.7" -- --size 360x360
entry models/trees/ternary.l "Three branches at every fork" "Prusinkiewicz & Lindenmayer 1990" --view models/trees/ternary.v
entry models/trees/oppenheimer.l "Oppenheimer's fractal tree" "Oppenheimer 1986"
entry models/trees/maple.l "Bark, saddles and roots" "Bloomenthal 1985" --view models/trees/maple.v -- --skin smooth --light
entry models/trees/structured-particles.l "Structured particles" "Reeves & Blau 1985"
entry models/trees/buds.l "Buds that die, rest or grow" "de Reffye et al. 1988" -- --size 360x360
entry environments/buds/coffee.toml "Coffee by its buds" "after de Reffye et al. 1988" -- --light
entry environments/buds/poplar.toml "Poplar by its buds" "after de Reffye et al. 1988" -- --light
entry environments/buds/spruce.toml "Spruce by its buds" "after de Reffye et al. 1988" -- --light
entry models/trees/growth-kinds.l "Kinds of growth" "Barthelemy & Caraglio 2007" -- --size 360x360
entry models/trees/holton.l "Tree of strands" "Holton 1994"
entry models/trees/ramification.l "Tree of a ramification matrix" "Viennot et al. 1989" -- --size 360x360
entry models/trees/vigour.l "Apical control" "Borchert & Honda 1984"
entry models/trees/pipe-model.l "Pipe model" "Leonardo da Vinci, in Richter 1970"
entry models/trees/strahler.l "Strahler numbers" "Strahler 1952"
entry models/trees/tropisms.l "Tropisms" "" -- --size 360x360
entry models/trees/twisted-stem.l "A stem with helical twist and taper" "Oppenheimer 1986"
entry models/trees/unequal-flow.l "Growth by unequal flow" "Honda, Tomlinson & Fisher 1981"
entry models/trees/weeping.l "Branches that bend" "Prusinkiewicz & Lindenmayer 1990, section 2.1" --view models/trees/weeping.v -- --size 360x360
entry models/pgraph/broadleaf.pgraph "Broadleaved tree of any size" "Lintermann & Deussen 1997" -- --light
entry models/pgraph/bush.pgraph "Bush of components" "Lintermann & Deussen 1997" -- --light
entry models/pgraph/palm.pgraph "Palm" "Lintermann & Deussen 1997" -- --light
entry models/pgraph/weeping-willow.pgraph "Weeping willow" "Lintermann & Deussen 1997" -- --light
entry models/pgraph/wind-pine.pgraph "Mountain pine in the wind" "Lintermann & Deussen 1997" -- --light
entry models/sdl/tree.sdl "Broad-leaved tree" "after Szemla 1999" -- --light
entry models/sdl/spruce.sdl "Spruce" "Szemla 1999" -- --light
entry models/sdl/palm.sdl "Palm" "after Szemla 1999" -- --light
entry models/sdl/bush.sdl "Fractal bush" "after Szemla 1999" -- --light
entry environments/wind.toml "Aspen in the wind" "Weber & Penn 1995" -- --light
entry environments/life-of-a-tree.toml "The life of a tree" "" --steps 30 -- --light
entry environments/aono-kunii-field.toml "Tree between attractor and inhibitor" "Aono & Kunii 1984"
grown_by environments/aono-kunii-field.toml models/environment/aono-kunii-field.l "Forks between attractors and inhibitors" "Aono & Kunii 1984"
entry environments/towards-light.toml "Tree beside an awning" "Lintermann & Deussen 1997" -- --light
grown_by environments/towards-light.toml models/environment/towards-light.pgraph "Tree that bends towards the light" "Lintermann & Deussen 1997"
grown_by environments/towards-light.toml models/environment/awning.l "Leaf of an awning" ""
grown_by environments/self-organizing.toml models/colonization/self-organizing.l "Self-organizing tree: the model" "Palubicki et al. 2009"
grown_by environments/tree.toml models/colonization/tree.l "Tree from a cloud of points: the model" "Runions, Lane & Prusinkiewicz 2007"
entry models/stochastic/random-tree.l "Random angles and lengths" "after Prusinkiewicz & Lindenmayer 1990, section 1.7"
entry models/brackets/bush.l "Bush" "Prusinkiewicz & Lindenmayer 1990"
entry models/brackets/bush-finished.l "Bush without the remains of its apices" "Prusinkiewicz & Lindenmayer 1990, figure 1.25"
entry models/brackets/plant-a.l "Plant a: segments that branch" "Prusinkiewicz & Lindenmayer 1990, figure 1.24 a"
entry models/brackets/plant-b.l "Plant b: two places of branching" "Prusinkiewicz & Lindenmayer 1990, figure 1.24 b"
entry models/brackets/plant-c-bent.l "Plant c with other angles" "after Prusinkiewicz & Lindenmayer 1990, figure 1.24 c"
entry models/brackets/plant-c.l "Plant c: branches of three segments" "Prusinkiewicz & Lindenmayer 1990, figure 1.24 c"
entry models/brackets/plant-d.l "Plant d: an apex and its axes" "Prusinkiewicz & Lindenmayer 1990, figure 1.24 d"
entry models/brackets/plant-e.l "Plant e: opposite branches" "Prusinkiewicz & Lindenmayer 1990, figure 1.24 e"
entry models/brackets/plant-f.l "Plant f: a plant that leans" "Prusinkiewicz & Lindenmayer 1990, figure 1.24 f"
entry models/brackets/growing-tree.l "Tree that grows everywhere" "Prusinkiewicz & Lindenmayer 1990, section 1.10.3" --steps 5

shelf "Flowers and inflorescences"
entry models/herbs/crocus.l "Crocus" "Prusinkiewicz & Lindenmayer 1990"
entry models/herbs/dibotryoid.l "Raceme of racemes" "Prusinkiewicz & Lindenmayer 1990, chapter 3"
entry models/herbs/dichasium.l "Dichasium" "Prusinkiewicz & Lindenmayer 1990, chapter 3"
entry models/herbs/lilac.l "Lilac" "Prusinkiewicz & Lindenmayer 1990"
entry models/herbs/lily-of-the-valley.l "Lily of the valley" "Prusinkiewicz & Lindenmayer 1990"
entry models/herbs/lychnis.l "Lychnis" "Robinson 1986"
entry models/herbs/monochasium.l "Bostryx and cincinnus" "Prusinkiewicz & Lindenmayer 1990, chapter 3"
entry models/herbs/mycelis-delays.l "Wall lettuce by delays" "Prusinkiewicz & Lindenmayer 1990, chapter 3"
entry models/herbs/mycelis.l "Wall lettuce" "Janssen & Lindenmayer 1987"
entry models/herbs/shepherds-purse.l "Shepherd's purse" "Prusinkiewicz & Lindenmayer 1990, chapter 3"
entry models/herbs/wild-carrot.l "Wild carrot" "Prusinkiewicz & Lindenmayer 1990"
entry models/brackets/flowering-plant.l "Flowering plant" "Prusinkiewicz & Lindenmayer 1990"
entry models/stochastic/flower-field.l "Field of flowers" "Prusinkiewicz & Lindenmayer 1990"
entry models/organs/flower.l "A flower composed of surfaces" "Prusinkiewicz & Lindenmayer 1990, section 5.1" --view models/organs/flower.v -- --elevation 35
entry models/phyllotaxis/rose.l "Rose" "after Prusinkiewicz & Lindenmayer 1990, section 4.1" -- --elevation 35
entry models/phyllotaxis/zinnia.l "Zinnia" "Prusinkiewicz & Lindenmayer 1990" -- --elevation 35
entry models/pgraph/sunflower.pgraph "Sunflower" "Lintermann & Deussen 1997"
entry models/pgraph/dandelion.pgraph "Dandelion" "Lintermann & Deussen 1997"
entry models/sdl/daisy.sdl "Daisies" "after Szemla 1999"
entry models/sdl/agave.sdl "Agave" "after Szemla 1999"
entry models/herbs/grass.l "Grass of particles" "Reeves & Blau 1985"
entry models/sdl/grass.sdl "Tuft of grass" "after Szemla 1999"
entry models/sdl/straw.sdl "Straw, as printed" "Szemla 1999" --view models/sdl/straw.v
entry models/signals/acropetal-flowering.l "Flowering from below" "Prusinkiewicz & Lindenmayer 1990, section 3.2"
entry models/signals/basipetal-flowering.l "Flowering from above" "Prusinkiewicz & Lindenmayer 1990, section 3.2"

shelf "Leaves and organs"
entry models/leaves/compound-leaf-alternate.l "Compound leaf, alternate" "Prusinkiewicz & Lindenmayer 1990, figure 5.12" -- --size 360x360
entry models/leaves/compound-leaf-timed.l "Compound leaf in continuous time" "Prusinkiewicz & Lindenmayer 1990" --define TIME=11 -- --size 360x360
entry models/leaves/compound-leaf.l "Compound leaf" "Prusinkiewicz & Lindenmayer 1990" -- --size 360x360
entry models/leaves/contour-leaf.l "Leaf traced along its edge" "Prusinkiewicz & Lindenmayer 1990, section 5.1"
entry models/leaves/cordate-leaf.l "Heart-shaped leaf" "Prusinkiewicz & Lindenmayer 1990, section 5.2"
entry models/leaves/fern.l "Fern frond that unrolls" "after Prusinkiewicz & Lindenmayer 1990" --steps 44 -- --azimuth 25 --elevation 8 --size 360x360
entry models/leaves/framework-leaf.l "Leaf on a growing framework" "Prusinkiewicz & Lindenmayer 1990, section 5.2"
entry models/leaves/rose-leaf.l "Serrated leaf" "Prusinkiewicz & Lindenmayer 1990" --define LC=8 -- --azimuth 20 --elevation 15 --no-ground --size 360x360
entry models/leaves/simple-leaf.l "Leaf with midrib and ribs" "Prusinkiewicz & Lindenmayer 1990, figure 5.6"
entry models/organs/horn.l "Horn" "Lintermann & Deussen 1999"
entry models/organs/patch-leaf.l "Leaf as a patch" "Prusinkiewicz & Lindenmayer 1990, section 5.1"
entry models/organs/shoot.l "A leafy shoot" "Prusinkiewicz & Lindenmayer 1990, section 5.1" --view models/organs/shoot.v
entry models/organs/trunk.l "Trunk as a generalized cylinder" "Prusinkiewicz & Lindenmayer 1990, section 5.1" --view models/organs/trunk.v
entry models/sdl/fern.sdl "Fern" "after Szemla 1999"
entry environments/vein-net.toml "Veins that close meshes" "Meinhardt 1976"
grown_by environments/vein-net.toml models/environment/vein-net.l "Net of veins" "Meinhardt 1976"

shelf "Phyllotaxis"
entry models/phyllotaxis/disc.l "Vogel's disc" "Vogel 1979"
entry models/phyllotaxis/sunflower-head.l "Sunflower head" "Vogel 1979"
entry models/phyllotaxis/collision.l "Organs that touch" "Fowler, Prusinkiewicz & Battjes 1992" -- --elevation 25
entry models/phyllotaxis/cone.l "Pine cone" "Ridley 1986"
entry models/phyllotaxis/contact-pressure.l "Leaves that push each other" "Adler 1974"
entry models/phyllotaxis/cylinder.l "Phyllotaxis on a cylinder" "Prusinkiewicz & Lindenmayer 1990, figure 4.6"
entry models/phyllotaxis/pineapple.l "Pineapple" "Ridley 1986"
entry models/phyllotaxis/ridley.l "Organs of equal area on a cylinder" "Ridley 1986"
entry models/pgraph/pineapple.pgraph "Pineapple" "Lintermann & Deussen 1997"
entry environments/canalisation.toml "Fibonacci numbers at a rim" "Vogel 1979" -- --azimuth 0 --elevation 90 --no-ground
grown_by environments/canalisation.toml models/environment/canalisation.l "Fibonacci numbers at a rim: the model" "Vogel 1979"
entry environments/reaction-diffusion.toml "Leaves by reaction and diffusion" "Meinhardt 1982"
grown_by environments/reaction-diffusion.toml models/environment/reaction-diffusion.l "Leaves where an activator is greatest" "Gierer & Meinhardt 1972"

shelf "Forests and competition"
entry environments/two-trees.toml "Two trees compete for light" "Mech & Prusinkiewicz 1996"
entry environments/two-trees-apart.toml "Two trees far apart" "Mech & Prusinkiewicz 1996"
entry environments/two-trees-long.toml "Two trees for 24 cycles" "Mech & Prusinkiewicz 1996"
entry environments/two-trees-unshaded.toml "Two trees without shadows" "Mech & Prusinkiewicz 1996"
entry environments/lone-tree.toml "The tree alone" "Mech & Prusinkiewicz 1996"
grown_by environments/default-process.toml models/light/bush.l "Bush that avoids its own shade" "after Mech & Prusinkiewicz 1996"
entry environments/stand.toml "Stand of herbs in daylight" "after Monsi & Saeki 1953"
entry environments/stand-rays.toml "Stand of herbs, with scattered light" "after Monsi & Saeki 1953"
entry environments/stand-measured.toml "Stand of herbs in measured light" "after Monsi & Saeki 1953"
entry environments/growth-chamber.toml "Herbs in a growth chamber" "after Monsi & Saeki 1953"
grown_by environments/stand.toml models/light/stand.l "Herb whose leaves live on light" "after Monsi & Saeki 1953"
entry environments/crowded-stand.toml "Three species in a crowd" "after Yoda et al. 1963" --steps 40
grown_by environments/crowded-stand.toml models/light/crowded.l "Plant in a crowd" "after Yoda et al. 1963"
entry environments/shade-avoidance.toml "Seedlings that avoid shade" "after Ballare, Scopel & Sanchez 1990"
grown_by environments/shade-avoidance.toml models/light/shade-avoiding.l "Seedling that senses far-red light" "after Morgan & Smith 1979"
entry environments/phototropism.toml "Seedling in light from one side" "after Darwin & Darwin 1880"
grown_by environments/phototropism.toml models/light/phototropic.l "Seedling that bends to the light" "after Darwin & Darwin 1880"
grown_by environments/two-trees.toml models/light/competing-tree.l "Tree that grows on light" "Mech & Prusinkiewicz 1996"
grown_by environments/forest-patch.toml models/light/conifer.l "Conifer that grows on light" "Mech & Prusinkiewicz 1996"
entry environments/forest-patch.toml "Nine conifers" "Mech & Prusinkiewicz 1996" -- --azimuth 20
entry environments/forest.toml "Stand of young trees" "Mech & Prusinkiewicz 1996"
entry environments/default-process.toml "Bush in its own shade" "after Mech & Prusinkiewicz 1996"
entry environments/self-thinning.toml "Stand that thins itself" "Deussen et al. 1998" -- --azimuth 0 --elevation 90 --no-ground
grown_by environments/self-thinning.toml models/environment/self-thinning.l "Self-thinning of three species" "Deussen et al. 1998"
entry environments/terminalia-two-tiers.toml "Two tiers of Terminalia" "Honda, Tomlinson & Fisher 1981" -- --azimuth 0 --elevation 90 --no-ground
entry environments/terminalia.toml "Tier of Terminalia" "Honda, Tomlinson & Fisher 1981" -- --azimuth 0 --elevation 90 --no-ground
grown_by environments/terminalia.toml models/environment/terminalia.l "Tiers that end where they meet" "Honda, Tomlinson & Fisher 1981"
entry environments/clover.toml "Clover that fills the light" "Mech & Prusinkiewicz 1996" -- --azimuth 0 --elevation 90 --no-ground --size 360x360
entry environments/clover-cover.toml "Clover that leaves a dark patch" "Bell 1986" --steps 60 -- --azimuth 0 --elevation 90 --no-ground --size 360x360
grown_by environments/clover.toml models/environment/clover.l "Clover: the model" "Mech & Prusinkiewicz 1996"
grown_by environments/clover-cover.toml models/environment/cover.l "A cover that takes the light" ""

shelf "Roots and water"
entry environments/two-roots.toml "Two roots in one soil" "Clausnitzer & Hopmans 1994" -- --field water:volume --no-legend
entry environments/two-roots-apart.toml "Two roots far apart" "Mech & Prusinkiewicz 1996" -- --field water:volume --no-legend
entry environments/two-roots-long.toml "Two roots, twice as deep" "Mech & Prusinkiewicz 1996" -- --field water:volume --no-legend
entry environments/two-roots-no-depletion.toml "Two roots in soil that stays wet" "Mech & Prusinkiewicz 1996" -- --field water:volume --no-legend
entry environments/one-root.toml "One root" "Mech & Prusinkiewicz 1996" -- --field water:volume --no-legend
entry environments/root-2d-blind.toml "Root without hydrotropism" "Mech & Prusinkiewicz 1996" -- --field water:slice --no-legend
entry environments/root-2d-stones.toml "Root between stones" "Mech & Prusinkiewicz 1996" -- --field water:slice --no-legend
entry environments/root-2d-uniform.toml "Root in evenly moist soil" "Mech & Prusinkiewicz 1996" -- --field water:slice --no-legend
entry environments/storm-on-layers.toml "A storm on layers of loam, clay and sand" "Richards 1931; Celia et al. 1990" -- --field water:slice --no-legend
entry environments/leaf-day.toml "A clear day of a plant that drinks" "Farquhar et al. 1980; Medlyn et al. 2011" --steps 28 -- --colour-by leaves.temperature --no-legend
entry environments/price-of-shade.toml "The price of shade" "Farquhar et al. 1980; ours" --
grown_by environments/price-of-shade.toml models/light/carbon-tree.l "A young tree that lives on what its leaves gain" "ours"
entry environments/price-of-shade-alone.toml "A tree that pays for no neighbour" "ours" --
entry environments/yield-by-density.toml "A dense field" "Shinozaki & Kira 1956" --
entry environments/fruiting-shoot.toml "A shoot with six fruits" "Allen, Prusinkiewicz & DeJong 2005" -- --colour-by carbon.sugar --no-legend
grown_by environments/fruiting-shoot.toml models/light/fruiting-shoot.l "A shoot that bears fruit" "ours"
entry environments/drought-stand.toml "Careful and daring plants in a drought" "Tuzet, Perrier & Leuning 2003; ours" --steps 390 -- --colour-by roots.plc --no-legend
grown_by environments/drought-stand.toml models/water/thirsty.l "A plant that loses leaves which dry" "ours"
entry environments/season.toml "A cereal, from sowing to harvest" "ours" --steps 92 -- --azimuth 30 --elevation 8
grown_by environments/season.toml models/water/cereal.l "A cereal that lives on what its leaves gain" "ours"
grown_by environments/leaf-day.toml models/water/drinking.l "A plant that drinks" "ours"
entry environments/root-drought.toml "A root in a drought" "Doussan et al. 1998; Schroeder et al. 2008" --steps 48 -- --field water:slice --no-legend
entry environments/hydraulic-lift.toml "Water lifted at night" "Richards & Caldwell 1987" --steps 72 -- --field roots:slice --no-legend
entry environments/hydraulic-lift-off.toml "Roots that do not conduct" "Richards & Caldwell 1987" --steps 72 -- --field water:slice --no-legend
entry environments/drought-deep.toml "Deep roots in a dry season" "Couvreur et al. 2012" -- --field water:slice --no-legend
entry environments/drought-shallow.toml "Shallow roots in a dry season" "Couvreur et al. 2012" -- --field water:slice --no-legend
entry environments/intercrop.toml "Maize and lupine in one soil" "Willey 1979; de Wit 1958" -- --field water:slice --no-legend
entry environments/intercrop-maize.toml "Two maize plants" "Willey 1979; de Wit 1958" -- --field water:slice --no-legend
entry environments/intercrop-lupine.toml "Two lupines" "Willey 1979; de Wit 1958" -- --field water:slice --no-legend
entry environments/hydrotropism.toml "A root turns to water" "Jaffe, Takahashi & Biro 1985" --set plant.0.define.WIDTH=0.004 -- --field water:slice=z-0.05 --no-legend
entry environments/chemotropism.toml "A root turns to fertiliser" "Newcombe & Rhodes 1904; Leitner et al. 2010" --set plant.0.define.WIDTH=0.004 -- --field nitrate:slice=z-0.05 --no-legend
entry environments/stones.toml "Roots between stones" "Massa & Gilroy 2003" -- --field stone.distance:iso=0 --no-legend --elevation 8
entry environments/plough-pan.toml "Roots above a plough pan" "Bengough et al. 2011" -- --elevation 3 --size 540x540
entry environments/dry-spell.toml "Roots after a dry spell" "Stasovski & Peterson 1991" -- --elevation 3 --size 540x540
entry environments/tree-roots.toml "Roots of a tree" "Köstler, Brückner & Bibelriether 1968" -- --elevation 30
entry environments/split-pot.toml "Split roots" "Couvreur et al. 2012" -- --field roots:slice --no-legend
entry environments/nitrate-in-rain.toml "Nitrate that rain washes down" "van Leer 1974; Barber 1995" --steps 24 -- --field nitrate:slice --no-legend
entry environments/barley-layers.toml "Barley in layers of nitrate" "Drew 1975" -- --size 540x540
entry environments/barley-poor.toml "Barley in poor soil" "Drew 1975" -- --size 540x540
entry environments/barley-rich.toml "Barley in rich soil" "Drew 1975" -- --size 540x540
entry models/roots/maize.l "Maize roots" "Pagès, Jordan & Picard 1989"
entry models/roots/wheat.l "Wheat roots" "Pagès, Jordan & Picard 1989"
entry models/roots/lupine.l "Lupine roots" "Pagès, Jordan & Picard 1989"
grown_by environments/hydrotropism.toml models/roots/hydrotropic.l "Root that turns to water" "Jaffe, Takahashi & Biro 1985"
grown_by environments/chemotropism.toml models/roots/chemotropic.l "Root that turns to a nutrient" "Newcombe & Rhodes 1904; Leitner et al. 2010"
grown_by environments/stones.toml models/roots/thigmotropic.l "Roots that grow along stones" "Massa & Gilroy 2003"
grown_by environments/plough-pan.toml models/roots/impeded.l "Roots in strong and cold soil" "Bengough et al. 2011"
grown_by environments/dry-spell.toml models/roots/mortal.l "Roots that die in dry soil" "Stasovski & Peterson 1991"
grown_by environments/tree-roots.toml models/roots/tree.l "Roots of a tree" "Köstler, Brückner & Bibelriether 1968"
grown_by environments/split-pot.toml models/roots/split.l "Roots in two halves" "Pagès, Jordan & Picard 1989"
grown_by environments/barley-layers.toml models/roots/barley.l "Barley root" "Drew 1975; Pagès et al. 1989"
entry environments/root-2d.toml "Root that follows wet soil" "Mech & Prusinkiewicz 1996" -- --field water:slice --no-legend
grown_by environments/root-2d.toml models/water/root.l "Root that takes up water" "Mech & Prusinkiewicz 1996"
entry environments/root-flare.toml "Tree with its roots" "Runions, Lane & Prusinkiewicz 2007"
entry environments/pot.toml "Plant in a pot" ""
grown_by environments/pot.toml models/together/potted-plant.l "Potted plant: shoot and root" ""

shelf "Topiary, climbers and shapes"
entry environments/topiary-3d.toml "Topiary dinosaur" "Prusinkiewicz, James & Mech 1994" -- --azimuth 25
entry environments/topiary-ellipse.toml "Plant pruned to an ellipse" "Prusinkiewicz, James & Mech 1994"
entry environments/topiary-free.toml "The topiary without a shape" "Prusinkiewicz, James & Mech 1994"
entry environments/topiary-shrinking.toml "Hedge that is clipped twice" "Prusinkiewicz, James & Mech 1994"
entry environments/topiary-square-shape.toml "Plant pruned to a box of the scene" "Prusinkiewicz, James & Mech 1994"
entry environments/topiary-square.toml "Plant pruned to a square" "Prusinkiewicz, James & Mech 1994"
grown_by environments/topiary-ellipse.toml models/topiary/ellipse.l "Pruning to an ellipse" "Prusinkiewicz, James & Mech 1994"
grown_by environments/topiary-shrinking.toml models/topiary/hedge.l "Clipped hedge" "Prusinkiewicz, James & Mech 1994"
grown_by environments/topiary-square-shape.toml models/topiary/square-shape.l "Pruning to a box of the scene" "Prusinkiewicz, James & Mech 1994"
grown_by environments/topiary-square.toml models/topiary/square.l "Pruning to a square" "Prusinkiewicz, James & Mech 1994"
entry environments/hedge.toml "Hedge without shears" "Runions, Lane & Prusinkiewicz 2007"
entry environments/ivy.toml "Ivy on a wall with a window" "Runions, Lane & Prusinkiewicz 2007"
entry environments/two-processes.toml "Ivy on a pillar" ""
grown_by environments/two-processes.toml models/together/ivy.l "Ivy that feels its wall" ""
entry environments/vines.toml "Vines on a house" "Greene 1989" -- --azimuth 25
grown_by environments/vines.toml models/environment/vines.l "Vines in search of light" "Greene 1989"
entry environments/climber.toml "Climbers on a column" "Arvo & Kirk 1988"
grown_by environments/climber.toml models/environment/climber.l "Climber that winds up" "Arvo & Kirk 1988"
entry models/pgraph/ivy.pgraph "Ivy on a pole" "Lintermann & Deussen 1997"

shelf "Signals in plants"
entry models/signals/acropetal.l "A signal towards the tips" "Prusinkiewicz & Lindenmayer 1990, figure 1.30 a"
entry models/signals/apical-dominance.l "Apical dominance" "after Prusinkiewicz & Lindenmayer 1990, section 3.2"
entry models/signals/basipetal.l "A signal towards the root" "Prusinkiewicz & Lindenmayer 1990, figure 1.30 b"
entry models/signals/hogeweg-hesper-a.l "Hogeweg and Hesper's pattern a" "Hogeweg & Hesper 1974"
entry models/signals/hogeweg-hesper-b.l "Hogeweg and Hesper's pattern b" "Hogeweg & Hesper 1974"
entry models/signals/hogeweg-hesper-c.l "Hogeweg and Hesper's pattern c" "Hogeweg & Hesper 1974"
entry models/signals/hogeweg-hesper-d.l "Hogeweg and Hesper's pattern d" "Hogeweg & Hesper 1974"
entry models/signals/hogeweg-hesper-e.l "Hogeweg and Hesper's pattern e" "Hogeweg & Hesper 1974"
entry models/signals/neighbours.l "Neighbours in a string with branches" "after Prusinkiewicz & Lindenmayer 1990, section 1.8"
entry models/signals/travelling-signal.l "A signal that travels" "Prusinkiewicz & Lindenmayer 1990, section 1.8"
entry models/signals/two-speeds.l "Two signals that meet" "after Prusinkiewicz & Lindenmayer 1990, section 3.2"

shelf "Patterns and curves"
entry models/curves/dragon.l "Dragon curve" "Davis & Knuth 1970" -- --size 360x360
entry models/curves/gosper.l "Gosper's hexagonal curve" "Gosper, in Gardner 1976" -- --size 360x360
entry models/curves/hilbert-3d.l "Hilbert's curve in space" "Hilbert 1891, Voorhies 1991"
entry models/curves/hilbert.l "Hilbert's curve" "Hilbert 1891"
entry models/curves/islands-and-lakes.l "Islands and lakes" "Mandelbrot 1982" -- --size 360x360
entry models/curves/koch-gaps.l "Koch's curve with gaps" "after Mandelbrot 1982" --steps 3
entry models/curves/koch-snowflake.l "Koch's snowflake" "von Koch 1904"
entry models/curves/koch-variations.l "Six variations of Koch" "Prusinkiewicz & Lindenmayer 1990, figure 1.9"
entry models/curves/koch.l "Koch curve" "von Koch 1904" --steps 3 -- --size 360x360
entry models/curves/levy.l "Levy's C curve" "Levy 1938" -- --size 360x360
entry models/curves/macrotile.l "Curve without long straight runs" "Prusinkiewicz, Lindenmayer & Fracchia 1991"
entry models/curves/moore.l "Moore's curve" "Moore 1900"
entry models/curves/peano.l "Peano's curve" "Peano 1890"
entry models/curves/penrose.l "Penrose's tiling by two rhombs" "Penrose 1974"
entry models/curves/quadratic-gosper.l "E-curve" "Dekking 1982"
entry models/curves/quadratic-island-18.l "Quadratic Koch island of eighteen" "Mandelbrot 1982" -- --size 360x360
entry models/curves/quadratic-island.l "Quadratic Koch island" "Mandelbrot 1982" -- --size 360x360
entry models/curves/quadratic-snowflake.l "Quadratic snowflake" "Prusinkiewicz & Lindenmayer 1990, figure 1.7 b" -- --size 360x360
entry models/curves/row-of-trees.l "Row of trees" "Prusinkiewicz & Lindenmayer 1990, figure 1.37" -- --size 540x540
entry models/curves/sierpinski.l "Sierpinski's gasket as one line" "Sierpinski 1915" -- --size 360x360
entry models/brackets/pythagoras.l "Pythagoras' tree" "Bosman 1942"
entry environments/cohen-sources.toml "Branching between attractor and inhibitor" "Cohen 1967"
entry environments/cohen-vertical.toml "Branching that strives upwards" "Cohen 1967"
entry environments/cohen.toml "Branching in a field of density" "Cohen 1967"
grown_by environments/cohen.toml models/environment/cohen.l "Branching patterns: the model" "Cohen 1967"

shelf "Cells"
entry models/cells/anabaena-timed.l "Anabaena catenula in continuous time" "Prusinkiewicz & Lindenmayer 1990" --define TIME=4
entry models/cells/anabaena.l "Filament of Anabaena catenula" "Lindenmayer 1968" --steps 5
entry models/cells/cantor.l "Cantor's set" "Cantor 1883" --steps 4 -- --size 360x360
entry models/cells/elementary-automaton.l "Elementary cellular automata" "Wolfram 1983"
entry models/cells/fibonacci.l "Fibonacci's cells" "Prusinkiewicz & Lindenmayer 1990, section 1.2" --steps 6
entry models/cells/heterocysts.l "Heterocysts of Anabaena" "Lindenmayer 1974" --steps 90
entry models/cells/pascal.l "Pascal's triangle" "Pascal 1654"
entry models/cells/ring.l "Ring of cells" ""
entry models/cells/thue-morse.l "The sequence of Thue and Morse" "Thue 1906"
entry environments/cells.toml "Cells on a lattice" "Ulam 1962" -- --azimuth 0 --elevation 90 --no-ground
grown_by environments/cells.toml models/environment/cells.l "Cells on a lattice: the model" "Ulam 1962"
entry environments/ulam-branching.toml "Ulam's cells: branching pattern" "Ulam 1962" -- --azimuth 0 --elevation 90 --no-ground
entry environments/ulam.toml "Ulam's cells: simple pattern" "Ulam 1962" -- --azimuth 0 --elevation 90 --no-ground
entry environments/sierpinski-triangle.toml "Sierpinski's triangle by collision" "Sierpinski 1915" --steps 31 -- --azimuth 0 --elevation 90 --no-ground
grown_by environments/sierpinski-triangle.toml models/environment/sierpinski-triangle.l "Sierpinski's triangle: collision" "Sierpinski 1915"
grown_by environments/ulam-branching.toml models/environment/ulam-branching.l "Ulam's cells that keep their distance" "Ulam 1962"
grown_by environments/ulam.toml models/environment/ulam.l "Ulam's cells: collision" "Ulam 1962"

shelf "The course"
entry models/course/01-curve.l "01 A curve" "von Koch 1904" --steps 3 --set plant.0.turtle.line_width=0.3
entry models/course/02-branching.l "02 Branching" "Prusinkiewicz & Lindenmayer 1990, figure 1.24 d" --set plant.0.turtle.line_width=0.4
entry models/course/03-parameters.l "03 Parameters" "Honda 1971"
entry models/course/04-signals.l "04 Context and signals" "Prusinkiewicz & Lindenmayer 1990, section 3.2"
entry models/course/05-stochastic.l "05 Chance" "Prusinkiewicz & Lindenmayer 1990, figure 1.27" -- --size 360x360
entry models/course/06-decomposition-homomorphism.l "06 Decomposition and homomorphism" "Prusinkiewicz, Hanan & Mech 1999"
entry models/course/07-queries.l "07 Queries" "Prusinkiewicz, James & Mech 1994"
grown_by environments/course-light.toml models/course/08-light.l "08 Light" "Mech & Prusinkiewicz 1996"
grown_by environments/course-water.toml models/course/09-water.l "09 Water" "Mech & Prusinkiewicz 1996"
grown_by environments/course-shape.toml models/course/10-shape.l "10 A shape" "Prusinkiewicz, James & Mech 1994"
entry environments/course-light.toml "Light: the scene" "Mech & Prusinkiewicz 1996"
entry environments/course-shape.toml "A shape: the scene" "Prusinkiewicz, James & Mech 1994"
entry environments/course-water.toml "Water: the scene" "Mech & Prusinkiewicz 1996" -- --field water:slice --no-legend

shelf "The language"
entry models/language/binary-counter.l "Predecessor of several modules" ""
entry models/language/blocks.l "Blocks before, between and after the steps" ""
entry models/language/conditions.l "Parameters and conditions" "after Prusinkiewicz & Lindenmayer 1990, section 1.10"
entry models/language/contexts.l "Contexts that name branches" ""
entry models/language/cut.l "Cutting branches off" "after Prusinkiewicz & Lindenmayer 1990, section 1.10"
entry models/language/decomposition.l "Decomposition" "Prusinkiewicz, Hanan & Mech 1999"
entry models/language/homomorphism.l "Homomorphism" "Prusinkiewicz, Hanan & Mech 1999"
entry models/language/labels.l "Labels" "" -- --zoom 0.75
entry models/language/named-modules.l "Modules with names" ""
entry models/language/parametric-turtle.l "The turtle's parameters" "Prusinkiewicz & Lindenmayer 1990, section 1.10.2"
entry models/language/protocol.l "Writing files" ""
entry models/language/queries.l "Queries of the turtle" ""
entry models/language/scale.l "Scale" "" -- --size 360x360
entry models/language/shared/twig.l "The preprocessor" ""
entry models/language/shoot/shoot.l "Growth by functions" "Prusinkiewicz et al. 2001" --view models/language/shoot/shoot.v
entry models/language/species/compound-leaf.l "Compound leaf inside a plant" "after Prusinkiewicz & Lindenmayer 1990, section 5.3"
entry models/language/species/grove.l "Sub-L-systems" "Hanan 1992"
entry models/language/spiral/liana.l "A curve in space as a guide" "" --view models/language/spiral/liana.v
entry models/language/statements.l "Statements: a sieve" ""
entry models/language/stopping.l "Derivation that stops by itself" ""
entry models/language/table/growth.l "Data from a file" ""
entry models/brackets/first-branches.l "Branches and branches of branches" "Prusinkiewicz & Lindenmayer 1990, section 1.6"
entry models/brackets/widths-and-colours.l "Widths and colours along a path" "Prusinkiewicz & Lindenmayer 1990, section 1.6.5"
entry models/stochastic/branching.l "Random choice in every segment" "Prusinkiewicz & Lindenmayer 1990, figure 1.27"
entry models/stochastic/distributions.l "Four distributions" ""
entry models/stochastic/galton.l "Galton's board" "Galton 1889"
entry models/stochastic/weights.l "Weights that depend on a parameter" "Prusinkiewicz & Lindenmayer 1990, section 1.7" -- --azimuth 0 --elevation 0 --no-ground
entry models/environment/queries.l "Queries of position and orientation" "Prusinkiewicz, James & Mech 1994"
end_row
wait
