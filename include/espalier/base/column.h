// A contiguous column of plain values that grows without zeroing: first touch of fresh memory is the dearest step.
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace espalier {

/// Memory of at least so many bytes is asked for in huge pages, where the system has them: they are touched first in a
/// quarter of the time.
inline constexpr std::size_t huge_allocation = std::size_t{8} << 20;

/// Throws std::bad_alloc.
void* allocate_huge(std::size_t bytes);
void free_huge(void* at) noexcept;

/// std::allocator, except that resize() leaves new elements uninitialised, and that much memory comes in huge pages.
template <class T>
class UninitialisedAllocator {
public:
    using value_type = T;

    UninitialisedAllocator() = default;
    template <class U>
    UninitialisedAllocator(const UninitialisedAllocator<U>&) noexcept {}

    T* allocate(std::size_t count) {
        if (count > std::numeric_limits<std::size_t>::max() / sizeof(T)) throw std::bad_array_new_length();
        if (count * sizeof(T) >= huge_allocation) return static_cast<T*>(allocate_huge(count * sizeof(T)));
        return std::allocator<T>().allocate(count);
    }
    void deallocate(T* at, std::size_t count) noexcept {
        if (count * sizeof(T) >= huge_allocation)
            free_huge(at);
        else
            std::allocator<T>().deallocate(at, count);
    }

    template <class U>
    void construct(U* at) noexcept(std::is_nothrow_default_constructible_v<U>) {
        ::new (static_cast<void*>(at)) U;
    }
    template <class U, class... Arguments>
    void construct(U* at, Arguments&&... arguments) {
        ::new (static_cast<void*>(at)) U(std::forward<Arguments>(arguments)...);
    }

    friend bool operator==(const UninitialisedAllocator&, const UninitialisedAllocator&) { return true; }
};

template <class T>
using Column = std::vector<T, UninitialisedAllocator<T>>;

}  // namespace espalier
