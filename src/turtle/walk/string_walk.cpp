// The loop of every walk. A function of its own, so that what it counts stays in registers.
#include "turtle/walk/string_walk.h"

#include "espalier/base/stop.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace espalier::turtle {
namespace {

std::vector<std::unique_ptr<StringWalk>>& spare_walks() {
    thread_local std::vector<std::unique_ptr<StringWalk>> spare;
    return spare;
}

}  // namespace

PooledWalk::PooledWalk(const WalkInput& input, Interpretation& result, const Walk::Room* room) {
    std::vector<std::unique_ptr<StringWalk>>& spare = spare_walks();
    if (spare.empty()) {
        walk_ = std::make_unique<StringWalk>();
    } else {
        walk_ = std::move(spare.back());
        spare.pop_back();
    }
    walk_->begin(input, result, room);
}

PooledWalk::~PooledWalk() {
    walk_->end();
    spare_walks().push_back(std::move(walk_));
}

void StringWalk::begin(const WalkInput& input, Interpretation& result, const Walk::Room* room) {
    string_ = &input.string;
    symbols_ = &input.symbols;
    derivation_ = input.derivation;
    model_ = &input.model;
    offsets_.clear();
    walk_.begin(input.model, input.string, input.settings, input.plant, result, room);
    walk_.processes_ = &input.symbols.processes;
    walk_.fields_ = input.fields;
}

void StringWalk::end() {
    constexpr std::size_t most_kept = std::size_t{1} << 20;  // entries
    walk_.end();
    if (offsets_.capacity() > most_kept) {
        offsets_ = {};
        links_ = {};
    }
    if (picture_.parameters.capacity() + picture_.letters.capacity() > most_kept) picture_ = {};
}

void StringWalk::run(std::size_t begin, std::size_t end, std::size_t at) {
    constexpr std::size_t between_looks = 8192;
    for (std::size_t here = begin; here < end && !walk_.stopped;) {
        end_if_asked();
        const std::size_t next = here + std::min(end - here, between_looks);
        here = derivation_ ? run_along<true>(here, next, at) : run_along<false>(here, next, at);
    }
}

template <bool with_pictures>
std::size_t StringWalk::run_along(std::size_t begin, std::size_t end, std::size_t& parameters_at) {
    const LetterId* const letters = string_->letters.data();
    const LetterMeaning* const meanings = symbols_->levels[0].data();
    const char* const pictured = symbols_->pictured.data();
    const LetterMeaning* next = &meanings[letters[begin]];
    std::size_t i = begin, at = parameters_at;
    for (; i < end && !walk_.stopped; ++i) {
        assert(letters[i] < symbols_->levels[0].size());
        const LetterMeaning& meaning = *next;
        // Known before this one acts: then the processor need not wait to know where it goes on.
        if (i + 1 < end) next = &meanings[letters[i + 1]];
        if constexpr (with_pictures) {
            if (const std::size_t replaced = pictured[letters[i]] ? draw_picture(i, at) : 0) {
                for (std::size_t k = 0; k < replaced; ++k) at += meanings[letters[i + k]].arity;
                i += replaced - 1;
                if (i + 1 < end) next = &meanings[letters[i + 1]];
                continue;
            }
        }
        if (meaning.level) {
            const SymbolMatch match = symbols_->match(*string_, i);
            if (match.module > i) {
                i = match.module;
                if (i + 1 < end) next = &meanings[letters[i + 1]];
            }
            if (match.meaning.action) act(i, letters[i], match.meaning, at);
            at += match.meaning.arity;
            continue;
        }
        if (meaning.action) act(i, letters[i], meaning, at);
        at += meaning.arity;
    }
    parameters_at = at;
    return i;
}

std::size_t StringWalk::draw_picture(std::size_t module, std::size_t at) {
    const ModuleString& string = *string_;
    const bool looks_around = symbols_->pictures_look_around;
    if (looks_around && offsets_.empty()) {
        link_branches(string, links_);
        offsets_ = parameter_offsets(string, model_->alphabet);
    }
    picture_.clear();
    const std::size_t replaced =
        derivation_->picture(string, looks_around ? &offsets_ : nullptr, links_, module, at, picture_);
    if (replaced == 0) return 0;

    walk_.module_ = std::uint32_t(module);
    walk_.parameters_at_ = at;
    walk_.in_picture_ = true;
    const double* values = picture_.parameters.data();
    constexpr std::size_t between_looks = 8192;
    for (std::size_t i = 0; i < picture_.size() && !walk_.stopped; ++i) {
        if (i % between_looks == between_looks - 1) end_if_asked();
        const SymbolMatch match = symbols_->match(picture_, i);
        i = match.module;
        walk_.letter_ = picture_.letters[i];
        if (match.meaning.action) match.meaning.action(walk_, {values, match.meaning.arity});
        values += match.meaning.arity;
    }
    walk_.in_picture_ = false;
    return replaced;
}

}  // namespace espalier::turtle
