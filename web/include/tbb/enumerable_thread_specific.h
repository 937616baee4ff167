#pragma once

#include <functional>
#include <optional>
#include <utility>

namespace tbb {

template <class Value>
class enumerable_thread_specific {
public:
    enumerable_thread_specific() : make_([] { return Value(); }) {}
    template <class Make>
        requires std::is_invocable_r_v<Value, Make>
    explicit enumerable_thread_specific(Make make) : make_(std::move(make)) {}

    Value& local() {
        if (!value_) value_.emplace(make_());
        return *value_;
    }
    Value* begin() { return value_ ? &*value_ : nullptr; }
    Value* end() { return value_ ? &*value_ + 1 : nullptr; }
    void clear() { value_.reset(); }

private:
    std::function<Value()> make_;
    std::optional<Value> value_;
};

}  // namespace tbb
