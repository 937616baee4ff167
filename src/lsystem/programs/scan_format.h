// fscanf of the language: the format is taken apart once and checked; every target is a number.
#pragma once

#include "espalier/base/error.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::lsystem {

class ScanFormat {
public:
    /// Throws UserError at `place` for a conversion that does not exist or gives no number.
    ScanFormat(std::string_view format, const Place& place);

    /// Values the format asks for.
    std::size_t conversions() const { return conversions_; }
    /// Reads from `text` at `position`, which moves behind what was read, into `values`, as many as there are
    /// conversions. Returns how many were read, or -1 if the text ended before the first, as C does.
    int scan(std::string_view text, std::size_t& position, double* values) const;

private:
    struct Piece {
        enum class Kind : char { blank, literal, number, whole, character, word, set };
        Kind kind = Kind::blank;
        char literal = 0;
        int base = 10;          ///< base of whole numbers; 0: as the digits say
        std::size_t width = 0;  ///< most characters; 0: any number
        bool stored = true;
        std::string set;  ///< characters of %[...]
        bool excluded = false;
    };

    std::size_t conversion(std::string_view format, std::size_t at, const Place& place);
    static bool read(const Piece& piece, std::string_view text, std::size_t& position, double& value);

    std::vector<Piece> pieces_;
    std::size_t conversions_ = 0;
};

}  // namespace espalier::lsystem
