// The model that measured plants become: they are there, or their nodes appear on their days.
#include "espalier/base/file.h"
#include "espalier/language/measured_plants.h"
#include "espalier/language/notation.h"
#include "espalier/lsystem/lsystem.h"

#include "base/text.h"
#include "language/measured/drawing.h"

#include <fmt/format.h>

#include <algorithm>

namespace espalier::language {
namespace {

double last_day(const MeasuredPlants& plants) {
    double last = 0;
    for (const MeasuredAxis& axis : plants.axes) {
        for (const MeasuredNode& node : axis.nodes) last = std::max(last, node.day);
    }
    return last;
}

std::string model_with_axiom(const MeasuredPlants& plants, const std::string& axiom) {
    std::string text = fmt::format("/* Measured axes: {} */\n\n", escaped(plants.path.filename().string()));
    if (plants.has_times) text += "#define DT 1  /* days in a step; 0.01..100; days */\n";
    text += "module Tip(order)";
    text += plants.has_times ? ", Node(day, x, y, z, length, diameter), NodeBehind(day, x, y, z, length, diameter);\n"
                             : ";\n";
    text += fmt::format("\nlsystem: 1\nderivation length: {}\naxiom:{}\n",
                        plants.has_times ? format_exact(last_day(plants)) + " / DT + 0.999" : "0", axiom);
    if (plants.has_times) {
        text +=
            "\n/* a node appears on its day; G: behind a gap of its axis */\n"
            "Node(day, x, y, z, length, diameter) : day <= DT + 0.000001 --> !(diameter) @R(x, y, z) F(length)\n"
            "Node(day, x, y, z, length, diameter) --> Node(day - DT, x, y, z, length, diameter)\n"
            "NodeBehind(day, x, y, z, length, diameter) : day <= DT + 0.000001 --> !(diameter) @R(x, y, z) G(length)\n"
            "NodeBehind(day, x, y, z, length, diameter) --> NodeBehind(day - DT, x, y, z, length, diameter)\n";
    }
    return text + "endlsystem\n";
}

}  // namespace

std::shared_ptr<const Model> measured_model(const MeasuredPlants& plants, std::optional<std::size_t> plant,
                                            const ReadOptions& options) {
    const std::string text = model_with_axiom(plants, measured::sample_axiom(plants.has_times));
    const std::shared_ptr<const Model> rules =
        read_model_text(text, plants.path.string(), plants.path.parent_path(), options);
    const auto model = std::make_shared<Model>(*rules);
    model->path = plants.path;
    model->name = plants.path.filename().string();
    const measured::DrawingLetters letters(model->alphabet);
    model->systems.front().given_axiom =
        std::make_shared<const lsystem::ModuleString>(measured::drawing_of(plants, plant, letters));
    return model;
}

std::string measured_model_text(const MeasuredPlants& plants) {
    lsystem::Alphabet alphabet;
    const measured::DrawingLetters letters(alphabet);
    return model_with_axiom(plants, measured::text_of(measured::drawing_of(plants, std::nullopt, letters), alphabet));
}

}  // namespace espalier::language
