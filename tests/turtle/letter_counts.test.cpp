// What is counted from letters alone, against a count letter by letter.
#include "turtle/walk/letter_counts.h"

#include "catch.h"
#include "turtle/drawing.h"

#include <fmt/format.h>

#include <random>
#include <string>
#include <vector>

using namespace espalier;
using namespace espalier::turtle;

namespace {

LetterSum counted_one_by_one(const SymbolTable& symbols, std::span<const LetterId> letters) {
    LetterSum sum = {{}, 0, 0, true};
    for (const LetterId letter : letters) {
        const LetterMeaning& meaning = symbols.levels[0][letter];
        sum.counts.parameters += meaning.arity;
        sum.counts.add(meaning.effect);
        sum.depth += int(letter == Alphabet::open_bracket) - int(letter == Alphabet::close_bracket);
        sum.least = std::min(sum.least, sum.depth);
    }
    return sum;
}

void check_sums(const Drawing& drawing, const std::vector<LetterId>& letters, std::mt19937& random) {
    const SymbolTable symbols(drawing.model);
    const LetterCounts counts(symbols);
    std::vector<LetterId> block(LetterCounts::block_size + 1);
    for (int round = 0; round < 300; ++round) {
        for (LetterId& letter : block) letter = letters[random() % letters.size()];
        const std::size_t size = round % 3 == 0 ? 1 + random() % LetterCounts::block_size : LetterCounts::block_size;
        const LetterSum found = counts.sum(block.data() + 1, size, block[0]);
        const LetterSum expected = counted_one_by_one(symbols, std::span(block).subspan(1, size));
        INFO(fmt::format("round {}, {} letters", round, size));
        CHECK(found.counts.parameters == expected.counts.parameters);
        CHECK(found.counts.internodes == expected.counts.internodes);
        CHECK(found.counts.queries == expected.counts.queries);
        CHECK(found.counts.answers == expected.counts.answers);
        CHECK(found.depth == expected.depth);
        CHECK(found.least == expected.least);
        CHECK(found.clear);
    }
}

std::vector<LetterId> letters_of(const Drawing& drawing) {
    return {drawing.string.letters.begin(), drawing.string.letters.end()};
}

/// Draws, asks, answers, branches; apices more to have so many letters. The widest has `most` parameters.
Drawing many_letters(std::size_t count, std::size_t most) {
    std::string text = "[F(1)]G[[+(3)]]f-s(1,2,3)<?light>(1,2)!(0.1)[]]][";
    text += "<Wide>(0" + [&] {
        std::string zeros;
        for (std::size_t i = 1; i < most; ++i) zeros += ",0";
        return zeros;
    }() + ")";
    Drawing drawing(text);
    drawing.model.processes = {"light"};
    for (std::size_t k = 0; drawing.model.alphabet.size() < count; ++k) {
        drawing.string.append(drawing.model.alphabet.letter(fmt::format("Apex{}", k), 1), std::vector<double>{0});
    }
    return drawing;
}

}  // namespace

TEST_CASE("rows, parameters and depths of a block are those of its letters, however many letters there are",
          "[turtle]") {
    std::mt19937 random(3);
    for (const std::size_t count : {16, 17, 32, 33, 100}) {
        for (const std::size_t most : {1, 255, 256}) {
            const Drawing drawing = many_letters(count, most);
            REQUIRE(drawing.model.alphabet.size() == count);
            INFO(fmt::format("{} letters, at most {} parameters", count, most));
            check_sums(drawing, letters_of(drawing), random);
        }
    }
}

TEST_CASE("a block of nothing but brackets is as deep as they are many", "[turtle]") {
    const Drawing drawing("[]");
    const SymbolTable symbols(drawing.model);
    const LetterCounts counts(symbols);
    const std::vector<LetterId> opening(LetterCounts::block_size, Alphabet::open_bracket);
    const std::vector<LetterId> closing(LetterCounts::block_size, Alphabet::close_bracket);
    const LetterSum in = counts.sum(opening.data(), opening.size(), Alphabet::open_bracket);
    CHECK(in.depth == 64);
    CHECK(in.least == 0);
    const LetterSum out = counts.sum(closing.data(), closing.size(), Alphabet::open_bracket);
    CHECK(out.depth == -64);
    CHECK(out.least == -64);
}
