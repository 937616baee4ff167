// Labels: a text of the model filled in with the module's parameters, where the turtle is.
#include "espalier/turtle/walk.h"

#include "lsystem/programs/print_format.h"

#include <vector>

namespace espalier::turtle {
namespace {

constexpr std::size_t longest_label = 1000;  // bytes; formats such as %99999d are no labels

std::string filled(const Walk& walk, const std::string& format, std::span<const double> values) {
    const PrintFormat print(format);
    std::vector<PrintFormat::Value> arguments(values.size());
    for (std::size_t k = 0; k < values.size(); ++k) arguments[k] = {values[k], walk.text(values[k])};
    return print.fill(arguments);
}

}  // namespace

const std::string* Walk::text(double number) const {
    if (!(number >= 0 && number < double(model_->texts.size()))) return nullptr;
    return &model_->texts[std::size_t(number)];
}

void Walk::write_label(std::span<const double> values) {
    const std::string* format = values.empty() ? nullptr : text(values[0]);
    if (!format) return;
    std::string written = filled(*this, *format, values.subspan(1));
    if (written.size() > longest_label) written.resize(longest_label);
    geometry_->labels.push_back(
        {acting_.module, turtle().order, std::uint16_t(turtle().colour), turtle().pose.position, std::move(written)});
    geometry_->bounds.add(turtle().pose.position);
}

}  // namespace espalier::turtle
