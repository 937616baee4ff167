#include "espalier/base/column.h"

#include "base/platform.h"

#include <cstdlib>

namespace espalier {
namespace {

constexpr std::size_t huge_page = std::size_t{2} << 20;

}  // namespace

void* allocate_huge(std::size_t bytes) {
    if (bytes > std::numeric_limits<std::size_t>::max() - huge_page) throw std::bad_alloc();
    const std::size_t whole = (bytes + huge_page - 1) / huge_page * huge_page;
    void* const at = std::aligned_alloc(huge_page, whole);
    if (!at) throw std::bad_alloc();
    platform::prefer_huge_pages(at, whole);
    return at;
}

void free_huge(void* at) noexcept {
    std::free(at);
}

}  // namespace espalier
