// Settings that a program makes.
#include "espalier/base/settings.h"

#include "settings_node.h"

namespace espalier {
namespace {

using Node = Settings::Node;

template <class Value>
std::shared_ptr<Node> list_of(const std::vector<Value>& values) {
    auto list = std::make_shared<Node>(Node::Type::array);
    for (const Value& value : values) list->items.push_back(Node::make(value));
    return list;
}

std::shared_ptr<Node> copy_of(const Node& node, const std::string& name) {
    auto copy = std::make_shared<Node>(node);
    copy->place = {name, 0, 0};
    copy->was_read = false;
    copy->defaults.clear();
    for (auto& item : copy->items) item = copy_of(*item, name);
    return copy;
}

}  // namespace

SettingValue::SettingValue(bool value) : node_(Node::make(value)) {}
SettingValue::SettingValue(double value) : node_(Node::make(value)) {}
SettingValue::SettingValue(const char* text) : node_(Node::make(std::string(text))) {}
SettingValue::SettingValue(const std::string& text) : node_(Node::make(text)) {}
SettingValue::SettingValue(const std::filesystem::path& path) : node_(Node::make(path.string())) {}
SettingValue::SettingValue(glm::dvec3 vector) : SettingValue({vector.x, vector.y, vector.z}) {}
SettingValue::SettingValue(const std::vector<double>& list) : node_(list_of(list)) {}
SettingValue::SettingValue(const std::vector<std::string>& list) : node_(list_of(list)) {}
SettingValue::SettingValue(const Settings& table) : node_(table.node_) {}

SettingValue::SettingValue(std::initializer_list<SettingValue> list)
    : node_(std::make_shared<Node>(Node::Type::array)) {
    for (const SettingValue& value : list) node_->items.push_back(value.node_);
}

SettingValue SettingValue::whole(std::int64_t value) {
    return SettingValue(Node::make(value));
}

Settings::Settings(std::initializer_list<Entry> entries) : Settings() {
    for (const Entry& entry : entries) node_->put(entry.key, entry.value.node_);
}

void Settings::put(std::string_view key, SettingValue value) {
    node_->put(std::string(key), std::move(value.node_));
}

Settings Settings::copy(const std::string& name) const {
    return Settings(copy_of(*node_, name));
}

}  // namespace espalier
