// Labels: a text of the model filled in with the module's parameters, where the turtle is.
#include "espalier/turtle/walk.h"

#include "lsystem/programs/print_format.h"

#include <vector>

namespace espalier::turtle {
namespace {

constexpr std::size_t longest_label = 1000;  // bytes; formats such as %99999d are no labels

const std::string* text_at(const Model& model, double index) {
    if (!(index >= 0 && index < double(model.texts.size()))) return nullptr;
    return &model.texts[std::size_t(index)];
}

std::string filled(const Model& model, const std::string& format, std::span<const double> values) {
    const PrintFormat print(format);
    std::vector<PrintFormat::Value> arguments(values.size());
    for (std::size_t k = 0; k < values.size(); ++k) arguments[k] = {values[k], text_at(model, values[k])};
    return print.fill(arguments);
}

}  // namespace

void Walk::write_label(std::span<const double> values) {
    const std::string* format = values.empty() ? nullptr : text_at(*model_, values[0]);
    if (!format) return;
    std::string text = filled(*model_, *format, values.subspan(1));
    if (text.size() > longest_label) text.resize(longest_label);
    geometry_->labels.push_back(
        {module_, turtle().order, std::uint16_t(turtle().colour), turtle().pose.position, std::move(text)});
    geometry_->bounds.add(turtle().pose.position);
}

}  // namespace espalier::turtle
