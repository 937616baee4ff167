// Values that are shared with whoever reads them later, while their owner goes on.
#pragma once

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

namespace espalier {

/// Memory that frames may hold on to: what somebody else still reads is set aside until they let go of it. Where nobody
/// ever does, it lies in its plant: the way to memory of its own costs many small plants a fifth of their step.
template <class T>
class Lent {
public:
    T& operator*() { return lending_ ? *lending_->now : own_; }
    const T& operator*() const { return lending_ ? *lending_->now : own_; }
    T* operator->() { return &**this; }
    const T* operator->() const { return &**this; }
    std::shared_ptr<const T> share() {
        if (!lending_) lending_ = std::make_unique<Lending>(Lending{std::make_shared<T>(std::move(own_)), {}});
        return lending_->now;
    }
    bool is_read() const { return lending_ && lending_->now.use_count() > 1; }
    /// Something that nobody reads, its values left over from an earlier step.
    T& for_writing() {
        if (is_read()) lending_->set_aside();
        return **this;
    }

private:
    struct Lending {
        std::shared_ptr<T> now;
        std::vector<std::shared_ptr<T>> earlier;

        void set_aside() {
            const auto is_free = [](const std::shared_ptr<T>& one) { return one.use_count() == 1; };
            const auto free = std::find_if(earlier.begin(), earlier.end(), is_free);
            std::shared_ptr<T> next = free == earlier.end() ? std::make_shared<T>() : std::move(*free);
            // Of more that are free, some would stay so for ever.
            std::erase_if(earlier, [&](const std::shared_ptr<T>& one) { return !one || is_free(one); });
            earlier.push_back(std::exchange(now, std::move(next)));
        }
    };

    T own_;  ///< until it is shared
    std::unique_ptr<Lending> lending_;
};

}  // namespace espalier
