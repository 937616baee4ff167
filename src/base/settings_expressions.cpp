// Expressions in place of numbers: texts that begin with '='.
#include "espalier/base/settings.h"

#include "settings_node.h"

#include <fmt/format.h>

#include <cmath>

namespace espalier {
namespace {

using Node = Settings::Node;

constexpr double exact_whole_numbers = 9007199254740992;  // 2^53

std::shared_ptr<Node> computed(double value, const Node& expression) {
    const bool whole = value == std::trunc(value) && std::abs(value) <= exact_whole_numbers;
    std::shared_ptr<Node> node = whole ? Node::make(static_cast<std::int64_t>(value)) : Node::make(value);
    node->place = expression.place;
    node->folder = expression.folder;
    node->computed = true;
    return node;
}

class Replacement {
public:
    explicit Replacement(const Settings::Evaluate& evaluate) : evaluate_(evaluate) {}

    void below(Node& node, const std::string& key, const Place& place) {
        const bool is_table = node.type == Node::Type::table;
        for (std::size_t i = 0; i < node.items.size(); ++i) {
            std::shared_ptr<Node>& item = node.items[i];
            const std::string& name = is_table ? node.names[i] : key;
            if (is_table && name == "define") continue;  // texts of the model that the expressions read
            const Place of_key = is_table ? item->place : place;
            if (item->type == Node::Type::text && item->text.starts_with('=')) {
                replace(item, name, of_key);
            } else {
                below(*item, name, of_key);
            }
        }
    }
    void throw_if_any() {
        if (!mistakes_.empty()) throw UserError(std::move(mistakes_));
    }

private:
    void replace(std::shared_ptr<Node>& item, const std::string& name, const Place& key) {
        try {
            item = computed(evaluate_(std::string_view(item->text).substr(1), key), *item);
        } catch (const UserError& error) {
            if (error.diagnostics().front().place.known()) throw;  // not of the expression
            mistakes_.push_back({Diagnostic::Severity::error, item->place,
                                 fmt::format("the expression of '{}': {}", name, error.what())});
        }
    }

    const Settings::Evaluate& evaluate_;
    std::vector<Diagnostic> mistakes_;
};

}  // namespace

void Settings::replace_expressions(const Evaluate& evaluate) const {
    Replacement replacement(evaluate);
    replacement.below(*node_, "", node_->place);
    replacement.throw_if_any();
}

}  // namespace espalier
