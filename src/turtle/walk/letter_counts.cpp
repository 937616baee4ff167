#include "turtle/walk/letter_counts.h"

#include <algorithm>
#include <bit>

#if defined(__x86_64__) && defined(__GNUC__)
#define ESPALIER_WIDE_COUNTS
#include <immintrin.h>
#endif

namespace espalier::turtle {
namespace {

// Fields of a packed count. A block's modules fill none of them; the depth, which may fall, is the highest.
constexpr int internodes_at = 24, queries_at = 31, answers_at = 38, unclear_at = 45, depth_at = 52;

std::size_t field(std::uint64_t packed, int at, int bits = 7) {
    return (packed >> at) & ((std::uint64_t{1} << bits) - 1);
}

std::uint64_t packed_rows(Symbol::Effect effect) {
    using enum Symbol::Effect;
    return std::uint64_t{effect == draws} << internodes_at | std::uint64_t{effect == asks} << queries_at |
           std::uint64_t{effect == answers} << answers_at;
}

/// All packed counts added up, and the least of all sums from the first on. The depth decides which is less.
struct Sum {
    std::uint64_t all = 0;
    std::int64_t least = 0;

    void add(std::uint64_t count) {
        all += count;
        least = std::min(least, static_cast<std::int64_t>(all));
    }
    void add(const Sum& next) {
        least = std::min(least, static_cast<std::int64_t>(all) + next.least);
        all += next.all;
    }
    LetterSum unpacked() const {
        return {
            {field(all, 0, internodes_at), field(all, internodes_at), field(all, queries_at), field(all, answers_at)},
            static_cast<std::int64_t>(all) >> depth_at,
            least >> depth_at,
            field(all, unclear_at) == 0};
    }
};

/// Adds up modules, one behind the other.
template <bool alone>
class Lane {
public:
    /// `before`: the letter before the first one.
    Lane(const std::vector<std::uint32_t>& rows, const std::vector<std::uint64_t>& table, LetterId before)
        : rows_(rows.data()), table_(table.data()), row_(alone ? 0 : rows_[before]) {}

    void add(LetterId letter) {
        sum.add(table_[row_ + letter]);
        if constexpr (!alone) row_ = rows_[letter];
    }

    Sum sum;

private:
    const std::uint32_t* rows_;
    const std::uint64_t* table_;
    std::size_t row_;
};

}  // namespace

void WalkCounts::add(Symbol::Effect effect) {
    internodes += effect == Symbol::Effect::draws;
    queries += effect == Symbol::Effect::asks;
    answers += effect == Symbol::Effect::answers;
}

WalkCounts& WalkCounts::operator+=(const WalkCounts& other) {
    parameters += other.parameters;
    internodes += other.internodes;
    queries += other.queries;
    answers += other.answers;
    return *this;
}

LetterCounts::LetterCounts(const SymbolTable& symbols) {
    const std::vector<LetterMeaning>& single = symbols.levels[0];
    const auto add_row = [&](const LetterMeaning* before) {
        for (std::size_t letter = 0; letter < single.size(); ++letter) {
            LetterMeaning meaning = single[letter];
            bool unclear = false;
            if (before && symbols.levels[before->level][letter].belongs) {
                meaning = symbols.levels[before->level][letter];
                unclear = meaning.level || single[letter].level || before->effect != Symbol::Effect::other;
            }
            std::uint64_t packed = meaning.arity + packed_rows(meaning.effect);
            packed += std::uint64_t{unclear} << unclear_at;
            packed += std::uint64_t{letter == Alphabet::open_bracket} << depth_at;
            packed -= std::uint64_t{letter == Alphabet::close_bracket} << depth_at;
            table_.push_back(packed);
        }
    };
    add_row(nullptr);
    for (const LetterMeaning& meaning : single) {
        rows_.push_back(meaning.level ? std::uint32_t(table_.size()) : 0);
        if (meaning.level) add_row(&meaning);
    }
    find_bytes(single);
}

LetterSum LetterCounts::sum(const LetterId* letters, std::size_t count, LetterId before) const {
    if (wide_ && count == block_size) return sum_wide(letters, bytes_);
    return alone() ? sum_one_by_one<true>(letters, count, before) : sum_one_by_one<false>(letters, count, before);
}

template <bool alone>
LetterSum LetterCounts::sum_one_by_one(const LetterId* letters, std::size_t count, LetterId before) const {
    Lane<alone> first(rows_, table_, before);
    if (count < block_size) {
        for (std::size_t i = 0; i < count; ++i) first.add(letters[i]);
        return first.sum.unpacked();
    }
    // Lanes need not wait for each other.
    constexpr std::size_t length = block_size / 4;
    Lane<alone> second(rows_, table_, letters[length - 1]), third(rows_, table_, letters[2 * length - 1]),
        fourth(rows_, table_, letters[3 * length - 1]);
    for (std::size_t i = 0; i < length; ++i) {
        first.add(letters[i]);
        second.add(letters[i + length]);
        third.add(letters[i + 2 * length]);
        fourth.add(letters[i + 3 * length]);
    }
    first.sum.add(second.sum);
    first.sum.add(third.sum);
    first.sum.add(fourth.sum);
    return first.sum.unpacked();
}

#ifdef ESPALIER_WIDE_COUNTS
namespace {

constexpr int draws_bit = 0, asks_bit = 1, answers_bit = 2;

#define ESPALIER_WIDE __attribute__((target("avx2,popcnt"))) inline

/// The bytes of 32 letters.
ESPALIER_WIDE __m256i look_up(const std::array<std::uint8_t, 32>& bytes, __m256i letters) {
    const auto* const halves = reinterpret_cast<const __m128i*>(bytes.data());
    const __m256i lower = _mm256_broadcastsi128_si256(_mm_loadu_si128(halves));
    const __m256i upper = _mm256_broadcastsi128_si256(_mm_loadu_si128(halves + 1));
    const __m256i is_upper = _mm256_slli_epi16(letters, 3);  // bit 4 of each becomes its highest
    return _mm256_blendv_epi8(_mm256_shuffle_epi8(lower, letters), _mm256_shuffle_epi8(upper, letters), is_upper);
}

ESPALIER_WIDE std::size_t count_bit(__m256i bytes, int bit) {
    return std::size_t(std::popcount(unsigned(_mm256_movemask_epi8(_mm256_slli_epi16(bytes, 7 - bit)))));
}

/// The sums of 32 bytes up to each of them.
ESPALIER_WIDE __m256i running_sums(__m256i bytes) {
    bytes = _mm256_add_epi8(bytes, _mm256_bslli_epi128(bytes, 1));
    bytes = _mm256_add_epi8(bytes, _mm256_bslli_epi128(bytes, 2));
    bytes = _mm256_add_epi8(bytes, _mm256_bslli_epi128(bytes, 4));
    bytes = _mm256_add_epi8(bytes, _mm256_bslli_epi128(bytes, 8));
    const __m256i lasts = _mm256_shuffle_epi8(bytes, _mm256_set1_epi8(15));
    return _mm256_add_epi8(bytes, _mm256_permute2x128_si256(lasts, lasts, 0x08));  // the lower half's goes to the upper
}

ESPALIER_WIDE int least_of(__m256i bytes) {
    __m128i least = _mm_min_epi8(_mm256_castsi256_si128(bytes), _mm256_extracti128_si256(bytes, 1));
    least = _mm_xor_si128(least, _mm_set1_epi8(-128));  // no sign, the same order
    least = _mm_min_epu8(least, _mm_srli_epi16(least, 8));
    return _mm_cvtsi128_si32(_mm_minpos_epu16(least)) % 256 - 128;
}

}  // namespace

__attribute__((target("avx2,popcnt"))) LetterSum LetterCounts::sum_wide(const LetterId* letters, const Bytes& bytes) {
    LetterSum sum = {{}, 0, 0, true};
    for (std::size_t at = 0; at < block_size; at += 32) {
        const auto* const from = reinterpret_cast<const __m256i*>(letters + at);
        const __m256i crossed = _mm256_packus_epi16(_mm256_loadu_si256(from), _mm256_loadu_si256(from + 1));
        const __m256i narrow = _mm256_permute4x64_epi64(crossed, 0xD8);
        const __m256i effects = look_up(bytes.effects, narrow);
        sum.counts.internodes += count_bit(effects, draws_bit);
        sum.counts.queries += count_bit(effects, asks_bit);
        sum.counts.answers += count_bit(effects, answers_bit);
        const __m256i arities = _mm256_sad_epu8(look_up(bytes.arities, narrow), _mm256_setzero_si256());
        const __m128i halves = _mm_add_epi64(_mm256_castsi256_si128(arities), _mm256_extracti128_si256(arities, 1));
        sum.counts.parameters += std::size_t(_mm_cvtsi128_si64(_mm_add_epi64(halves, _mm_bsrli_si128(halves, 8))));
        // A comparison yields -1.
        const __m256i depths =
            running_sums(_mm256_sub_epi8(_mm256_cmpeq_epi8(narrow, _mm256_set1_epi8(Alphabet::close_bracket)),
                                         _mm256_cmpeq_epi8(narrow, _mm256_set1_epi8(Alphabet::open_bracket))));
        sum.least = std::min(sum.least, sum.depth + least_of(depths));
        sum.depth += static_cast<std::int8_t>(_mm256_extract_epi8(depths, 31));
    }
    return sum;
}

void LetterCounts::find_bytes(const std::vector<LetterMeaning>& single) {
    static const bool has_vectors = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("popcnt");
    const bool fits = std::all_of(single.begin(), single.end(), [](const LetterMeaning& m) { return m.arity < 256; });
    wide_ = has_vectors && fits && alone() && single.size() <= bytes_.arities.size();
    if (!wide_) return;
    using enum Symbol::Effect;
    for (std::size_t letter = 0; letter < single.size(); ++letter) {
        const auto [effect, arity] = std::pair(single[letter].effect, single[letter].arity);
        bytes_.arities[letter] = std::uint8_t(arity);
        bytes_.effects[letter] = std::uint8_t((effect == draws) << draws_bit | (effect == asks) << asks_bit |
                                              (effect == answers) << answers_bit);
    }
}
#else
LetterSum LetterCounts::sum_wide(const LetterId*, const Bytes&) {
    return {};
}

void LetterCounts::find_bytes(const std::vector<LetterMeaning>&) {}
#endif

}  // namespace espalier::turtle
