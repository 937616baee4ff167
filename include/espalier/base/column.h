// A contiguous column of plain values that grows without zeroing: first touch of fresh memory is the dearest step.
#pragma once

#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace espalier {

/// std::allocator, except that resize() leaves new elements uninitialised.
template <class T>
class UninitialisedAllocator : public std::allocator<T> {
public:
    template <class U>
    struct rebind {
        using other = UninitialisedAllocator<U>;
    };
    using std::allocator<T>::allocator;

    template <class U>
    void construct(U* at) noexcept(std::is_nothrow_default_constructible_v<U>) {
        ::new (static_cast<void*>(at)) U;
    }
    template <class U, class... Arguments>
    void construct(U* at, Arguments&&... arguments) {
        ::new (static_cast<void*>(at)) U(std::forward<Arguments>(arguments)...);
    }
};

template <class T>
using Column = std::vector<T, UninitialisedAllocator<T>>;

}  // namespace espalier
