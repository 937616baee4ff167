// printf of the language: the format is taken apart once, checked against its arguments, and then only filled in.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace espalier::lsystem {

class PrintFormat {
public:
    /// A '%' that begins no conversion stands for itself, as in "100%!".
    explicit PrintFormat(std::string_view format);

    struct Value {
        double number = 0;
        const std::string* text = nullptr;
    };
    std::size_t conversions() const { return pieces_.size(); }
    /// True if the k-th conversion is %s.
    bool wants_text(std::size_t k) const { return pieces_[k].conversion == 's'; }
    /// Values that are missing are 0.
    std::string fill(const std::vector<Value>& values) const;

private:
    struct Piece {
        std::string before;  ///< literal text in front of the conversion
        std::string specification;
        char conversion = 0;
    };
    std::vector<Piece> pieces_;
    std::string after_;
};

}  // namespace espalier::lsystem
