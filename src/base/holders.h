// Who else holds a shared value: asked before its memory is written anew.
#pragma once

#include "base/shared_work.h"

#include <atomic>
#include <memory>

namespace espalier {

/// True if more than `ours` pointers hold the value. If not, what the others read before they let go of it comes before
/// what the caller writes next: `use_count()` alone does not order the two.
template <class T>
bool is_held_by_others(const std::shared_ptr<T>& value, long ours) {
    if (value.use_count() > ours) return true;
#ifdef ESPALIER_THREAD_SANITIZER
    const std::shared_ptr<T> seen = value;  // the sanitizer knows counts, but no fences
#else
    std::atomic_thread_fence(std::memory_order_acquire);
#endif
    return false;
}

}  // namespace espalier
