# For `./dev fuzz`: copies what inputs of each target begin with into a folder, `seed_TARGET FOLDER`. $root is the clone.
# shellcheck shell=bash disable=SC2154

# Seeds: every model there is, good and bad.
seed_model() {
    seed "$1" < <(find "$root/models" "$root/tests" -name '*.l' -size -64k)
}

# Every file of another notation, good and bad.
seed_notations() {
    seed "$1" < <(find "$root/models" "$root/tests" \( -name '*.pgraph' -o -name '*.sdl' -o -name '*.species' \
        -o -name '*.rsml' -o -name '*.mtg' -o -name '*.dgf' -o -name '*.rparam' -o -name '*.xml' -o -name '*.swc' -o -name '*.opf' \
        -o -path '*seeds*.csv' \) -size -64k)
}

# The first byte of each says which reader it is for, in the order of `readers` in side_files.cpp.
seed_side_files() {
    local file reader
    while IFS= read -r file; do
        case "$file" in
            *.v) reader=0 ;;
            *.s) reader=1 ;;
            *.ray) reader=2 ;;
            *.con) reader=3 ;;
            *.func) reader=4 ;;
            *.fset) reader=5 ;;
            *.curve) reader=6 ;;
            *.bg) reader=7 ;;
            *.map) reader=8 ;;
            *.mat) reader=9 ;;
            *.a) reader=10 ;;
            */specifications) reader=11 ;;
            *.obj) reader=12 ;;
            *.bark) reader=13 ;;
            *) continue ;;
        esac
        # shellcheck disable=SC2059
        { printf "\\$(printf %03o "$reader")" && cat "$file"; } >"$1/seed$(tr / - <<<"${file#"$root"}")"
    done < <(find "$root/models" "$root/tests" -type f -size -64k)
}

seed_settings() {
    seed "$1" < <(find "$root/models" "$root/environments" "$root/tests" "$root/docs/examples" -name '*.toml' -size -16k)
}

# What programs write, the target itself leaves in a folder.
seed_textures() { ESPALIER_FUZZ_SEEDS="$1" "$root/build/fuzz/tests/fuzz/fuzz_textures"; }
seed_grids() { ESPALIER_FUZZ_SEEDS="$1" "$root/build/fuzz/tests/fuzz/fuzz_grids"; }
seed_runs() { ESPALIER_FUZZ_SEEDS="$1" "$root/build/fuzz/tests/fuzz/fuzz_runs"; }
seed_checkpoints() { ESPALIER_FUZZ_SEEDS="$1" "$root/build/fuzz/tests/fuzz/fuzz_checkpoints"; }

# Requests to a studio, a line each.
seed_requests() {
    seed "$1" < <(find "$root/tests/fuzz/seeds" -name '*.requests')
}

# Copies the files of a list under names of their own.
seed() {
    local file
    while IFS= read -r file; do cp "$file" "$1/seed$(tr / - <<<"${file#"$root"}")"; done
}
