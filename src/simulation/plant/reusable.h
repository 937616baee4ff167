// Values that are written anew every step, while frames still read those of earlier steps.
#pragma once

#include "base/holders.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

namespace espalier::simulation {

/// What a frame holds is set aside until the frame lets go of it; the memory is then used again.
template <class T>
class Reusable {
public:
    T& operator*() { return *now_; }
    const T& operator*() const { return *now_; }
    T* operator->() { return now_.get(); }
    const T* operator->() const { return now_.get(); }
    std::shared_ptr<const T> share() const { return now_; }
    bool is_shared() const { return is_held_by_others(now_, 1); }

    /// A value that others may read, too: while they do, it is not written.
    void hold(std::shared_ptr<const T> value) { now_ = std::const_pointer_cast<T>(std::move(value)); }

    /// A new value, and no memory of those before but what others hold.
    void release() {
        now_ = std::make_shared<T>();
        held_.clear();
    }

    /// A value that no frame reads, its content left over from an earlier step.
    T& for_writing() {
        if (is_shared()) set_aside();
        return *now_;
    }

private:
    void set_aside() {
        const auto is_free = [](const std::shared_ptr<T>& one) { return !is_held_by_others(one, 1); };
        const auto free = std::find_if(held_.begin(), held_.end(), is_free);
        std::shared_ptr<T> next = free == held_.end() ? std::make_shared<T>() : std::move(*free);
        // One is enough: of more that are free, some would stay so for ever.
        std::erase_if(held_, [&](const std::shared_ptr<T>& one) { return !one || is_free(one); });
        held_.push_back(std::exchange(now_, std::move(next)));
    }

    std::shared_ptr<T> now_ = std::make_shared<T>();
    std::vector<std::shared_ptr<T>> held_;
};

}  // namespace espalier::simulation
