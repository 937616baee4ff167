#include "environment/light/rays/ies_file.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "base/number.h"
#include "base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace espalier::environment {
namespace {

/// Where the line that begins with TILT= begins; labels before it may hold the word.
std::optional<std::size_t> tilt_line(const std::string& text) {
    if (text.starts_with("TILT=")) return 0;
    const std::size_t before = text.find("\nTILT=");
    return before == std::string::npos ? std::nullopt : std::optional(before + 1);
}

/// The numbers of a file behind its line TILT=.
class IesNumbers {
public:
    IesNumbers(const std::filesystem::path& path, std::vector<std::string>& unused) : path_(path) {
        const std::string text = read_text(path);
        const auto tilt = tilt_line(text);
        if (!tilt) refuse("it has no line TILT=, so it is no file of IES LM-63");
        const std::size_t end = text.find('\n', *tilt);
        if (end == std::string::npos) refuse("it ends behind TILT=");
        words_ = words_of(std::string_view(text).substr(end), " \t\r\n,\x1a");
        const std::vector<std::string> tilts = words_of(text.substr(*tilt + 5, end - *tilt - 5), " \t\r");
        const std::string name = tilts.empty() ? "NONE" : tilts.front();
        if (name == "INCLUDE") {
            pass_tilt(unused);
        } else if (name != "NONE") {
            unused.push_back(fmt::format("the factors of tilt in '{}' are not used", name));
        }
    }

    double take() {
        if (next_ == words_.size()) refuse("it ends before all of its numbers");
        const std::string& word = words_[next_++];
        const auto number = finite_number(word.starts_with('+') ? std::string_view(word).substr(1) : word);
        if (!number) refuse(fmt::format("'{}' is no number", word));
        return *number;
    }
    int take_count(const char* what) {
        const double count = take();
        if (!(count >= 1 && count <= 10000 && count == std::floor(count))) {
            refuse(fmt::format("the number of {} is {:g}", what, count));
        }
        return static_cast<int>(count);
    }
    /// So many angles that rise.
    std::vector<double> take_angles(int count) {
        std::vector<double> angles;
        for (int i = 0; i < count; ++i) {
            angles.push_back(take());
            if (i > 0 && !(angles[i] > angles[i - 1])) refuse("its angles do not rise");
        }
        return angles;
    }
    std::size_t left() const { return words_.size() - next_; }
    [[noreturn]] void refuse(const std::string& why) const { throw UserError({path_.string(), 0, 0}, why); }

private:
    void pass_tilt(std::vector<std::string>& unused) {
        take();  // how the lamp hangs
        const int pairs = take_count("angles of TILT");
        for (int i = 0; i < pairs; ++i) take();
        bool changes = false;
        for (int i = 0; i < pairs; ++i) changes = take() != 1 || changes;
        if (changes) unused.push_back("its factors of tilt are not used: the lamp shines as if it hung upright");
    }

    std::filesystem::path path_;
    std::vector<std::string> words_;
    std::size_t next_ = 0;
};

/// Between the values at rising angles; 0 beyond the last.
double between(const std::vector<double>& angles, const double* values, double at) {
    if (at < angles.front() || at > angles.back()) return 0;
    const auto after = std::upper_bound(angles.begin(), angles.end(), at) - angles.begin();
    if (after == static_cast<std::ptrdiff_t>(angles.size())) return values[after - 1];
    const double t = (at - angles[after - 1]) / (angles[after] - angles[after - 1]);
    return (1 - t) * values[after - 1] + t * values[after];
}

}  // namespace

void IesFile::refuse(const std::string& why) const {
    throw UserError({path_.string(), 0, 0}, why);
}

IesFile::IesFile(const std::filesystem::path& path) : path_(path) {
    IesNumbers numbers(path, unused_);
    numbers.take();  // lamps
    numbers.take();  // lumens of each
    numbers.take();  // multiplier
    const int vertical = numbers.take_count("vertical angles"), horizontal = numbers.take_count("horizontal angles");
    if (numbers.take() != 1) refuse("its photometry is not of type C");
    for (int i = 0; i < 7; ++i) numbers.take();  // units, three lengths, ballast, future use, watts
    down_ = numbers.take_angles(vertical);
    round_ = numbers.take_angles(horizontal);
    if (down_.front() < 0 || down_.back() > 180) refuse("its vertical angles must lie from 0 to 180 degrees");
    double sum = 0;
    for (int k = 0; k < horizontal; ++k) {
        candela_.emplace_back();
        for (int i = 0; i < vertical; ++i) {
            candela_.back().push_back(numbers.take());
            if (candela_.back().back() < 0) refuse("it has a light below 0");
            sum += candela_.back().back();
        }
    }
    if (!(sum > 0)) refuse("it has no light in any direction");
    if (numbers.left() > 0) {
        unused_.push_back(
            fmt::format("{} words behind its last number are not used: do its counts of angles agree "
                        "with its table?",
                        numbers.left()));
    }
    close_circle();
}

void IesFile::close_circle() {
    const double first = round_.front(), last = round_.back();
    if (first == 90 && last == 270) return;
    if (first == 0 && (last == 0 || last == 90 || last == 180 || last == 360)) return;
    double widest = 0;
    for (std::size_t k = 1; k < round_.size(); ++k) widest = std::max(widest, round_[k] - round_[k - 1]);
    if (first == 0 && last > 180 && last < 360 && 360 - last <= 1.001 * widest) {
        round_.push_back(360);
        candela_.push_back(candela_.front());
        return;
    }
    refuse(
        fmt::format("its angles round the axis go from {:g} to {:g} degrees, which leaves a wedge without light: "
                    "they must go from 0 to 0, 90, 180 or round the circle, or from 90 to 270",
                    first, last));
}

/// Degrees round the axis as the file's half, quarter or whole circle has them.
double IesFile::within_file(double turn) const {
    const double last = round_.back();
    if (last == 0) return 0;
    if (round_.front() == 90) return turn < 90 ? 180 - turn : turn > 270 ? 540 - turn : turn;
    if (last <= 180 && turn > 180) turn = 360 - turn;
    if (last <= 90 && turn > 90) turn = 180 - turn;
    return turn;
}

double IesFile::intensity(double down, double turn) const {
    const double at = within_file(turn);
    const auto above = std::upper_bound(round_.begin(), round_.end(), at);
    const auto high = std::min(static_cast<std::size_t>(above - round_.begin()), round_.size() - 1);
    const std::size_t low = high == 0 || above == round_.end() ? high : high - 1;
    const double a = between(down_, candela_[low].data(), down), b = between(down_, candela_[high].data(), down);
    return low == high ? a : a + (b - a) * (at - round_[low]) / (round_[high] - round_[low]);
}

}  // namespace espalier::environment
