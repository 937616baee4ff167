#include "geometry/side_files/control_points.h"

#include "espalier/base/error.h"

#include "base/line_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace espalier::geometry {
namespace {

/// What takes the place of a part of a text.
struct TextPart {
    std::size_t from, to;
    std::string text;
};

bool same(const ControlPoint& a, const ControlPoint& b) {
    return a.position == b.position && a.times == b.times;
}

std::string end_of_lines(const std::string& text) {
    return text.find("\r\n") == std::string::npos ? "\n" : "\r\n";
}

/// The line of a point, in the seven digits that its file is read with.
std::string line_of(const ControlPoint& point, const ControlPoints& curve) {
    if (point.times < 1) throw UserError("a point counts at least once");
    if (point.times > 1 && !curve.may_repeat) throw UserError("a point of this file counts once");
    std::string line;
    for (int axis = 0; axis < curve.coordinates; ++axis) {
        if (!std::isfinite(point.position[axis])) throw UserError("the coordinates of a point are finite");
        line += fmt::format("{}{:.7g}", axis == 0 ? "" : " ", point.position[axis]);
    }
    if (curve.says_times || point.times > 1) line += fmt::format(" {}", point.times);
    return line;
}

std::size_t begin_of_line(const std::string& text, std::size_t at) {
    return at == 0 ? 0 : text.rfind('\n', at - 1) + 1;
}

std::size_t end_of_line(const std::string& text, std::size_t at) {
    return std::min(text.find_first_of("\r\n", at), text.size());
}

/// The whole number at or behind a place, replaced.
TextPart number_at(const std::string& text, std::size_t at, std::size_t number) {
    const std::size_t from = std::min(text.find_first_not_of(" \t", at), text.size());
    return {from, std::min(text.find_first_not_of("+0123456789", from), text.size()), std::to_string(number)};
}

/// An edit of the points of one curve. At both ends, the points that stay are left alone.
class PointEdit {
public:
    PointEdit(const std::string& text, const ControlPoints& curve, const std::vector<ControlPoint>& points)
        : text_(text), curve_(curve), before_(curve.points), after_(points) {
        const std::size_t fewer = std::min(before_.size(), after_.size());
        while (head_ < fewer && same(before_[head_], after_[head_])) ++head_;
        while (tail_ < fewer - head_ && same(before_[before_.size() - 1 - tail_], after_[after_.size() - 1 - tail_])) {
            ++tail_;
        }
        changed_ = fewer - head_ - tail_;
    }

    std::string text() {
        count();
        for (std::size_t i = head_; i < head_ + changed_; ++i) {
            edits_.push_back({before_[i].from, before_[i].to, line_of(after_[i], curve_)});
        }
        if (after_.size() > before_.size()) insert();
        if (after_.size() < before_.size()) remove();
        std::sort(edits_.begin(), edits_.end(), [](const auto& a, const auto& b) { return a.from > b.from; });
        std::string text = text_;
        for (const TextPart& edit : edits_) text.replace(edit.from, edit.to - edit.from, edit.text);
        return text;
    }

private:
    void count() {
        if (!curve_.count_at) return;
        const std::size_t total = std::accumulate(after_.begin(), after_.end(), std::size_t{0},
                                                  [](std::size_t sum, const auto& point) { return sum + point.times; });
        edits_.push_back(number_at(text_, *curve_.count_at, after_.size()));
        if (curve_.says_total) edits_.push_back(number_at(text_, edits_.back().to, total));
    }

    void insert() {
        const std::size_t first = head_ + changed_;
        std::string lines;
        const std::string end = end_of_lines(text_);
        for (std::size_t i = first; i < after_.size() - tail_; ++i) {
            const std::string line = line_of(after_[i], curve_);
            lines += first == 0 ? line + end : end + line;
        }
        const std::size_t at =
            first == 0 ? begin_of_line(text_, before_.front().from) : end_of_line(text_, before_[first - 1].to);
        edits_.push_back({at, at, lines});
    }

    void remove() {
        for (std::size_t i = head_ + changed_; i < before_.size() - tail_; ++i) {
            const std::size_t end = text_.find('\n', before_[i].to);
            const std::size_t to = end == std::string::npos ? text_.size() : end + 1;
            edits_.push_back({begin_of_line(text_, before_[i].from), to, ""});
        }
    }

    const std::string& text_;
    const ControlPoints& curve_;
    const std::vector<ControlPoint>&before_, &after_;
    std::size_t head_ = 0, changed_ = 0, tail_ = 0;
    std::vector<TextPart> edits_;
};

}  // namespace

bool ControlPoints::add(std::span<const double> numbers, std::size_t from, std::size_t to) {
    const auto count = static_cast<std::size_t>(coordinates);
    const bool repeats = numbers.size() > count;
    const double multiplicity = repeats ? numbers[count] : 1;
    if (!(multiplicity >= 1 && double(total) + multiplicity <= LineReader::most_points)) return false;
    ControlPoint& point = points.emplace_back();
    for (std::size_t axis = 0; axis < count; ++axis) point.position[static_cast<int>(axis)] = numbers[axis];
    point.times = static_cast<int>(multiplicity);
    point.from = from;
    point.to = to;
    total += static_cast<std::size_t>(point.times);
    says_times = says_times || repeats;
    return true;
}

std::string with_points(const std::string& text, const ControlPoints& curve, const std::vector<ControlPoint>& points) {
    if (points.empty()) throw UserError("a curve has points");
    if (!curve.count_at && points.size() != curve.points.size()) {
        throw UserError(fmt::format("a patch has {} points", curve.points.size()));
    }
    return PointEdit(text, curve, points).text();
}

}  // namespace espalier::geometry
