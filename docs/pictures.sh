#!/usr/bin/env bash
# Makes every picture of README.md and docs/ anew from the scenes of this repository.
#   docs/pictures.sh [PROGRAM]     default: build/release/espalier
# ffmpeg (apt-get install ffmpeg) gives pictures of plants a palette, which makes them small, and writes the film.
set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
espalier="$(realpath "${1:-$root/build/release/espalier}")"
pictures="$root/docs/pictures"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
cd "$root"

grow() { # FOLDER SCENE [OPTIONS]
    "$espalier" run "$2" --output "$work/$1" --quiet "${@:3}"
}
render() { # PICTURE RUN [OPTIONS]
    "$espalier" render "$work/$2" --output "$work/$1" --quiet "${@:3}"
    with_palette "$1"
}
render_fine() { # PICTURE RUN WIDTH HEIGHT [OPTIONS]: what is thinner than a pixel is drawn larger and made smaller
    "$espalier" render "$work/$2" --output "$work/$1" --quiet --size "$((3 * $3))x$((3 * $4))" "${@:5}"
    with_palette "$1" "scale=$3:$4:flags=area,"
}
with_palette() { # PICTURE [FILTER]
    local palette="${2:-}split[a][b];[a]palettegen=max_colors=160:stats_mode=full[p];[b][p]paletteuse=dither=none"
    ffmpeg -loglevel error -y -i "$work/$1" -filter_complex "$palette" -fflags +bitexact "$pictures/$1"
}

grow two-trees environments/two-trees.toml
grow lone-tree environments/lone-tree.toml
grow two-roots environments/two-roots.toml
grow root-2d environments/root-2d.toml
grow storm-on-layers environments/storm-on-layers.toml
grow root-drought environments/root-drought.toml
grow nitrate-in-rain environments/nitrate-in-rain.toml
grow hydraulic-lift environments/hydraulic-lift.toml
for scene in leaf-day season price-of-shade price-of-shade-alone fruiting-shoot drought-deep drought-shallow intercrop intercrop-maize intercrop-lupine split-pot; do
    grow "$scene" "environments/$scene.toml"
done
grow plough-pan environments/plough-pan.toml
grow plough-pan-loose environments/plough-pan.toml --set environment.strength.file=soils/loose.csv
grow plough-pan-summer environments/plough-pan.toml --set environment.temperature.file=soils/summer.csv
for soil in plough-pan plough-pan-loose plough-pan-summer; do
    render_fine "$soil.png" "$soil" 260 360 --no-legend --scale-bar --elevation 3
done
grow dry-spell environments/dry-spell.toml
grow dry-spell-wet environments/dry-spell.toml --set environment.head.file=soils/wet.csv
grow hydrotropism environments/hydrotropism.toml --set plant.0.define.WIDTH=0.004
grow chemotropism environments/chemotropism.toml --set plant.0.define.WIDTH=0.004
grow stones environments/stones.toml
grow stones-numb environments/stones.toml --set plant.0.define.TOUCH=0
for roots in stones stones-numb; do
    render "$roots.png" "$roots" --size 300x380 --field stone.distance:iso=0 --no-legend --elevation 8
done
grow split-wet environments/split-pot.toml --set environment.water.regions.0.initial.head=-100
grow split-feddes environments/split-pot.toml --set 'environment.roots.model="feddes"'
for nitrate in poor layers rich; do
    grow "barley-$nitrate" "environments/barley-$nitrate.toml"
    render_fine "barley-$nitrate.png" "barley-$nitrate" 260 330 --no-legend --azimuth 10 --elevation 3
done
grow topiary environments/topiary-3d.toml
grow forest environments/forest.toml --set plant.0.grid.columns=7 --set plant.0.grid.rows=7
grow forest-patch environments/forest-patch.toml --every 50
grow lychnis models/herbs/lychnis.l

render two-trees.png two-trees --size 640x480 --azimuth 20 --elevation 10
grow willow models/species/weeping-willow.species --every 1000000
render light-paths.png willow --size 480x360 --light --sun 60:35 --samples 48
render two-roots.png two-roots --size 640x480 --field water:volume --azimuth 15 --elevation 8 --no-legend
render topiary.png topiary --size 640x480 --azimuth 25 --elevation 10
render root-2d.png root-2d --size 640x640 --field water:slice --time --scale-bar
render storm-on-layers.png storm-on-layers --size 300x270 --sheet 3x1 --step 10:40:14 --field water:slice --time
render root-drought.png root-drought --size 180x400 --sheet 5x1 --step 8:72:16 --field water:slice --azimuth 15 --elevation 5 --time
render hydraulic-lift.png hydraulic-lift --size 200x400 --sheet 2x1 --step 68:72:4 --field roots:slice --azimuth 15 --elevation 5 --time
for plant in drought-deep drought-shallow; do
    render "$plant.png" "$plant" --size 150x480 --sheet 2x1 --step 20:60:40 --field water:slice --azimuth 15 --elevation 5 --time
done
render intercrop.png intercrop --size 240x480 --sheet 2x1 --step 20:40:20 --field water:slice --azimuth 15 --elevation 5 --time
render hydrotropism.png hydrotropism --size 400x400 --field water.head:slice=z-0.05 --azimuth 0 --elevation 5
render chemotropism.png chemotropism --size 400x400 --field nitrate:slice=z-0.05 --azimuth 0 --elevation 5
render split-pot.png split-pot --size 500x380 --field roots:slice --azimuth 0 --elevation 5
render nitrate-in-rain.png nitrate-in-rain --size 180x400 --sheet 5x1 --step 12:60:12 --field nitrate:slice --azimuth 15 --elevation 5 --time
render growth.png two-trees --sheet 4x2 --size 250x190 --colour-by birth
render shade.png two-trees --size 800x600 --field light:slice=z --azimuth 15 --zoom 1.15 --scale-bar --dark
render light.png forest --size 720x450 --colour-by light --elevation 25 --scale-bar
render forest-patch.png forest-patch --size 800x560 --azimuth 20 --elevation 8
render water.png two-roots --size 800x600 --field water:iso=0.285 --field water:slice=x --azimuth 35
render lychnis.png lychnis --size 640x480
for preset in decurrent excurrent weeping shrub gnarly flat orchard; do
    "$espalier" tree --preset "$preset" --run "$work/$preset" --output "$work/$preset.obj" --quiet
    render "tree-$preset.png" "$preset" --size 320x320 --azimuth 20 --ground
done
for scene in hedge ivy; do
    grow "$scene" "environments/$scene.toml"
    render "$scene.png" "$scene" --size 320x300 --azimuth 15
done
grow root-flare environments/root-flare.toml
render root-flare.png root-flare --size 320x300 --azimuth 15 --elevation 20
for scene in cohen cohen-vertical cohen-sources aono-kunii-field; do
    grow "$scene" "environments/$scene.toml"
    render "$scene.png" "$scene" --size 320x300
done
grow vines environments/vines.toml
render vines.png vines --field house.distance:iso=0 --no-legend --size 640x480 --azimuth 25 --zoom 1.2
grow climber environments/climber.toml
render climber.png climber --field column.distance:iso=0 --no-legend --size 320x480 --azimuth 25
plant_of_notation() { # NAME FILE
    grow "$1" "$2"
    render "$1.png" "$1" --size 300x300
}
for plant in dandelion sunflower weeping-willow bush palm pineapple wind-pine ivy; do
    plant_of_notation "pgraph-$plant" "models/pgraph/$plant.pgraph"
done
for plant in grass fern daisy palm spruce agave tree bush; do
    plant_of_notation "sdl-$plant" "models/sdl/$plant.sdl"
done
grow maple models/trees/maple.l --view models/trees/maple.v --every 1000
render maple.png maple --size 380x380 --skin smooth
grow fork models/trees/maple.l --view models/trees/maple.v --define THINNEST=0.2 --define ROOTS=0 --every 1000
render fork-tubes.png fork --size 380x380 --azimuth 60 --elevation 5 --zoom 1.5 --no-ground
render fork-skin.png fork --size 380x380 --azimuth 60 --elevation 5 --zoom 1.5 --no-ground --skin smooth
printf 'stripes = 3\ndepth = 0.15\nwaviness = 0.3\nroughness = 0.02\n' >"$work/cork.bark"
grow cork models/trees/maple.l --define THINNEST=0.2 --every 1000
render displaced.png cork --bark "$work/cork.bark" --skin smooth --displace --azimuth 60 --elevation 5 --zoom 2.2 --no-ground --size 380x380 --voxel 0.01
species() { # NAME [OPTIONS]; the last step alone, because the whole growth of a large tree takes gigabytes
    grow "species-$1" "models/species/$1.species" --colour-map models/plants.map --every 1000 "${@:2}"
    render "species-$1.png" "species-$1" --size 300x300
}
for plant in quaking-aspen black-tupelo lombardy-poplar coconut-palm balsam-fir european-larch sassafras; do
    species "$plant"
done
species black-oak --seed 4 --define BaseSize=0.15
species weeping-willow --define Branches_3=60 --define QUALITY=0.5
grow wind environments/wind.toml
render wind.png wind --sheet 4x1 --size 220x280
for shape in 1 2 3; do
    grow "collision-$shape" models/phyllotaxis/collision.l --define SHAPE=$shape --every 900
    render "collision-$shape.png" "collision-$shape" --size 260x300 --elevation 25
done
grow collision-4 models/phyllotaxis/collision.l --view models/phyllotaxis/gourd.v --define SHAPE=4 --every 900
render collision-4.png collision-4 --size 260x300 --elevation 15
grow contact-pressure models/phyllotaxis/contact-pressure.l --every 180
render contact-pressure.png contact-pressure --size 200x300 --elevation 25
for sides in 3 6 12 24; do
    grow "cells-$sides" environments/cells.toml --set plant.0.define.SIDES=$sides
    render "cells-$sides.png" "cells-$sides" --size 260x260 --azimuth 0 --step 14 --elevation $((sides > 6 ? 20 : 90)) --no-ground
done
grow cells-holladay environments/cells.toml --set plant.0.define.STRAIGHT=1 --set 'environment.cells.rule="wishes"' --steps 27
render cells-holladay.png cells-holladay --size 260x260 --azimuth 0 --elevation 90 --no-ground
for tree in coffee poplar spruce; do
    grow "buds-$tree" "environments/buds/$tree.toml" --every 1000
    render "buds-$tree.png" "buds-$tree" --size 220x260
done
grow buds-spruce-young environments/buds/spruce.toml --steps 40 --every 1000
render buds-spruce-young.png buds-spruce-young --size 220x260
grow buds-dead models/trees/buds.l --define DEATH=0.03 --define MARK=0.4 --every 1000
render buds-dead.png buds-dead --size 220x260
holton() { # NAME [OPTIONS]
    grow "$1" models/trees/holton.l --every 1000 "${@:2}"
    render "$1.png" "$1" --size 220x260
}
holton holton-fir
holton holton-pine --define FOOT=6 --define LENGTH=1.1 --define CROWN=2 --define SHARE_0=0.85 --define ANGLE_0=70 \
    --define LEAST_BRANCH=1.2 --define LEAST_DRAWN=1.2 --define CROWN_SHARE_0=0.72 --define CROWN_SHARE_1=0.58 \
    --define CROWN_ANGLE_0=75 --define CROWN_ANGLE_1=55 --define CROWN_DIVERGENCE=100 --define STRANDS=4000 \
    --define THICKNESS=0.007
holton holton-broadleaf --define CROWN=0 --define LENGTH=1.2 --define STRANDS=1500 --define THICKNESS=0.008 \
    --define CROWN_DIVERGENCE=100 --define CROWN_ANGLE_1=55 --define LEAVES=4
grow sierpinski environments/sierpinski-triangle.toml
for step in 6 32; do
    render "sierpinski-$step.png" sierpinski --step $step --size 260x260 --azimuth 0 --elevation 90 --no-ground
done
grow reaction-diffusion environments/reaction-diffusion.toml
render reaction-diffusion.png reaction-diffusion --size 220x320 --elevation 20
grow reaction-diffusion-two environments/reaction-diffusion.toml --set environment.pattern.second_inhibitor=0.1 \
    --set environment.pattern.second_spread=0.05
render reaction-diffusion-two.png reaction-diffusion-two --size 220x320 --elevation 20
grow clover environments/clover-cover.toml
for step in 34 56 120; do
    render "clover-$step.png" clover --step $step --size 300x300 --azimuth 0 --elevation 90 --no-ground
done
# The ground as the pictures above show it: +z is down.
ffmpeg -loglevel error -y -i environments/grounds/patches.png -vf vflip,scale=300:300:flags=neighbor -fflags +bitexact \
    "$pictures/clover-ground.png"
grow vein-net-tree environments/vein-net.toml --set environment.veins.uptake=0.1
render vein-net-tree.png vein-net-tree --size 260x200
grow vein-net environments/vein-net.toml
render vein-net.png vein-net --size 260x200
self_organizing() { # PICTURE [OPTIONS]
    grow "$1" environments/self-organizing.toml --set plant.0.define.YEARS=20 "${@:2}"
    render "$1.png" "$1" --size 320x360 --azimuth 20
}
self_organizing lambda-46 --set environment.resource.lambda=0.46
self_organizing lambda-50 --set environment.resource.lambda=0.5
self_organizing lambda-56 --set environment.resource.lambda=0.56
self_organizing space-only --set environment.resource.lambda=0.5 --set plant.0.define.LIGHT=0
self_organizing light-only --set environment.resource.lambda=0.5 --set plant.0.define.SPACE=0 \
    --set plant.0.define.YEARS=12
self_organizing upwards --set environment.resource.lambda=0.5 --set plant.0.define.UPWARDS=0.6 \
    --set plant.0.define.TOWARDS=0.2
grow stand environments/self-thinning.toml --every 1000000 --set plant.0.define.SIDE=2060 \
    --set plant.0.define.SEEDS=424000
grow black-oak models/species/black-oak.species --every 1000000
grow european-larch models/species/european-larch.species --every 1000000
grow bush models/pgraph/bush.pgraph --every 1000000
grow black-oak-2 models/species/black-oak.species --seed 2 --every 1000000
grow european-larch-2 models/species/european-larch.species --seed 2 --every 1000000
grow bush-2 models/pgraph/bush.pgraph --seed 2 --every 1000000
grow tufts models/herbs/grass.l --define TUFTS=6 --define SIDE=0.7 --every 1000000
"$espalier" landscape environments/landscapes/hills.toml --set stand.run="$work/stand" \
    --set species.0.run="$work/black-oak" --set species.1.run="$work/black-oak-2" \
    --set species.2.run="$work/european-larch" --set species.3.run="$work/european-larch-2" \
    --set species.4.run="$work/bush" --set species.5.run="$work/bush-2" --set cover.0.run="$work/tufts" \
    --set cover.0.distance=150 --set cover.0.density=4 --set light.elevation=45 --set camera.angle=46 \
    --set camera.eye=[0,6,300] --set camera.target=[0,7,0] --size 960x540 --output "$work/landscape.png" --quiet
with_palette landscape.png
printf 'click 350 490\ndrag 500 300 530 290\n' >"$work/window.txt"
"$espalier" view "$work/two-trees" --size 1100x700 --script "$work/window.txt" --screenshot "$work/view.png"
with_palette view.png
"$espalier" render "$work/two-trees" --output "$pictures/growth.gif" --size 280x210 --frames 36 --step 0:180 --no-ground \
    --rate 9 --quiet

"$espalier" plot "$work/two-trees" --quantity height,organs,length,light.mean --output "$pictures/plot.png" \
    --size 960x620
"$espalier" plot "$work/intercrop" "$work/intercrop-maize" "$work/intercrop-lupine" --quantity roots.transpiration,roots.depth \
    --output "$pictures/intercrop-plot.png"
"$espalier" plot "$work/drought-deep" "$work/drought-shallow" --quantity roots.transpiration,roots.depth \
    --output "$pictures/drought-plot.png"
"$espalier" plot "$work/leaf-day" --quantity leaves.gain,leaves.transpiration,leaves.temperature --output "$pictures/leaf-day.png"
grow leaf-co2 docs/examples/one-leaf.toml
grow leaf-warm docs/examples/one-leaf.toml --set 'keyframes.0.key="environment.leaf.temperature"' \
    --set 'keyframes.0.times=[1,30]' --set 'keyframes.0.values=[5,45]'
for rises in co2:internal warm:temperature; do
    "$espalier" plot "$work/leaf-${rises%:*}" --against "leaf.${rises#*:}" --quantity leaf.assimilation,leaf.conductance \
        --output "$pictures/leaf-${rises%:*}.png"
done
"$espalier" sweep docs/examples/one-leaf.toml --vary environment.light.sky.par=20:2000:34 --steps 1 \
    --set 'keyframes.0.values=[400,400,400]' \
    --statistic leaf.assimilation,leaf.temperature --output "$work/leaf-light" --plot "$pictures/leaf-light.png" --quiet
grow drought-stand-5 environments/drought-stand.toml --seed 5
"$espalier" render "$work/drought-stand-5" --colour-by roots.plc --step 6:546:12 --size 260x300 --no-ground --rate 9 --time \
    --output "$pictures/drought-stand.gif" --quiet
"$espalier" render "$work/season" --colour-by leaves.assimilation --size 260x360 --rate 4 --time --azimuth 30 --elevation 8 --no-ground \
    --output "$pictures/season.gif" --quiet
"$espalier" plot "$work/drought-stand-5" --quantity leaves.potential,roots.transpiration,roots.plc,carbon.structure \
    --output "$pictures/drought-stand.png"
"$espalier" render "$work/drought-stand-5" --step 390 --colour-by roots.plc --output "$pictures/drought-stand-plc.png" --size 500x500 --quiet
grow season-rich environments/season.toml --set environment.air.co2=800
grow season-dry environments/season.toml --set environment.air.rain_factor=0.5
"$espalier" plot "$work/season" "$work/season-rich" "$work/season-dry" --per total \
    --quantity leaves.leaf_area,carbon.structure,leaves.transpiration,leaves.potential --output "$pictures/season.png"
"$espalier" plot "$work/price-of-shade" "$work/price-of-shade-alone" --quantity carbon.structure,carbon.gain,carbon.shed \
    --output "$pictures/price-of-shade.png"
"$espalier" render "$work/fruiting-shoot" --colour-by carbon.sugar --output "$pictures/fruiting-shoot.png" --size 600x600 --quiet
"$espalier" render "$work/price-of-shade" --size 300x240 --rate 6 --time --output "$pictures/price-of-shade.gif" --quiet
grow fruiting-film environments/fruiting-shoot.toml --set timeline.every=2
"$espalier" render "$work/fruiting-film" --colour-by carbon.sugar --size 260x300 --rate 6 --time --no-ground \
    --output "$pictures/fruiting-shoot.gif" --quiet
"$espalier" plot "$work/dry-spell" "$work/dry-spell-wet" --quantity length,internodes --output "$pictures/dry-spell-plot.png"
"$espalier" plot "$work/split-pot" "$work/split-wet" "$work/split-feddes" --quantity roots.transpiration,roots.collar \
    --output "$pictures/split-plot.png"
"$espalier" plot "$work/two-trees" "$work/lone-tree" --per total --quantity organs,light.mean --dark \
    --output "$pictures/plot-dark.png" --size 960x330
"$espalier" analyse "$work/two-trees" --size 1100x760 --output "$work/trees-measured" >/dev/null
"$espalier" analyse "$work/two-roots" --step last --layer 0.05 --size 960x330 --output "$work/roots-measured" >/dev/null
cp "$work/trees-measured/analysis.png" "$work/roots-measured/layers.png" "$pictures"
"$espalier" sweep environments/two-roots.toml --vary environment.water.initial=0.02:0.14:7 --vary simulation.seed=1..6 \
    --statistic length,water.drunk --output "$work/sweep" --plot "$pictures/sweep.png" --quiet
"$espalier" fit models/roots/lupine.l docs/marks/lupine.rsml --steps 20 --method abc --generations 2 \
    --parameter RATE_0=0.005:0.05 --parameter SPACING_0=log:0.003:0.03 --parameter LENGTH_1=0.02:0.4 \
    --parameter ANGLE_1=40:90 --output "$work/lupine-fit" --size 1170x1065 --quiet
cp "$work/lupine-fit/fit.png" "$pictures/fit.png"
grow forgotten models/trees/honda.l --define R1=0.86 --define R2=0.74 --define A1=17 --define A2=-48 --define DIVERGENCE=120
"$espalier" scan "$work/forgotten" --at 8,2,8 --at=-8,2,-8 --at 8,2,-8 --angle 0.15 --distance-noise 0.005 --no-ground \
    --output "$work/forgotten.ply" --quiet
"$espalier" fit models/trees/honda.l "$work/forgotten.ply" --parameter R1 --parameter R2 --parameter A1=0:40 \
    --parameter A2=-80:-20 --parameter DIVERGENCE --overlay "$pictures/found-tree.svg" --quiet
ls -l "$pictures"
