#include "environment/light/shade/changes.h"

#include <cstring>

namespace espalier::environment {
namespace {

using Casts = std::span<const ShadeCast>;
static_assert(sizeof(ShadeCast) == 16, "compared as bytes");

constexpr std::size_t block = 64;     // compared at once
constexpr std::size_t near = 16;      // births and deaths among neighbours
constexpr std::size_t far = 1 << 13;  // births and deaths in a whole plant
constexpr std::size_t far_searches = 16;

/// How many pyramids both begin with.
std::size_t common(Casts a, Casts b) {
    const std::size_t most = std::min(a.size(), b.size());
    std::size_t same = 0;
    while (same + block <= most && std::memcmp(&a[same], &b[same], block * sizeof(ShadeCast)) == 0) same += block;
    while (same < most && a[same] == b[same]) ++same;
    return same;
}

struct Skip {
    std::size_t before = 0, now = 0;
};

/// The fewest pyramids to pass over on either side until both go on alike; 1 and 1 if nothing is found.
Skip skip_near(Casts before, Casts now) {
    for (std::size_t by = 1; by <= near; ++by) {
        if (by < now.size() && now[by] == before[0]) return {0, by};
        if (by < before.size() && before[by] == now[0]) return {by, 0};
        if (by < before.size() && by < now.size() && before[by] == now[by]) return {by, by};
    }
    return {1, 1};
}

std::size_t find_far(Casts in, const ShadeCast& cast) {
    const Casts part = in.first(std::min(in.size(), far));
    return static_cast<std::size_t>(std::find(part.begin(), part.end(), cast) - part.begin());
}

Skip skip_far(Casts before, Casts now) {
    const std::size_t gone = find_far(before, now[0]), come = find_far(now, before[0]);
    if (gone < std::min(before.size(), far) && gone <= come) return {gone, 0};
    if (come < std::min(now.size(), far)) return {0, come};
    return {1, 1};
}

}  // namespace

bool find_changes(Casts before, Casts now, std::size_t most, ShadeChanges& changes) {
    changes.gone.clear();
    changes.come.clear();
    std::size_t searches = 0;
    while (true) {
        const std::size_t same = common(before, now);
        before = before.subspan(same);
        now = now.subspan(same);
        Skip skip{before.size(), now.size()};
        const bool last = before.empty() || now.empty();
        if (!last) {
            skip = skip_near(before, now);
            const bool lost =
                skip.before == 1 && skip.now == 1 && !(before.size() > 1 && now.size() > 1 && before[1] == now[1]);
            if (lost && searches++ < far_searches) skip = skip_far(before, now);
        }
        if (changes.gone.size() + changes.come.size() + skip.before + skip.now > most) return false;
        changes.gone.insert(changes.gone.end(), before.begin(),
                            before.begin() + static_cast<std::ptrdiff_t>(skip.before));
        changes.come.insert(changes.come.end(), now.begin(), now.begin() + static_cast<std::ptrdiff_t>(skip.now));
        if (last) return true;
        before = before.subspan(skip.before);
        now = now.subspan(skip.now);
    }
}

}  // namespace espalier::environment
