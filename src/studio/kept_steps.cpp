#include "studio/kept_steps.h"

#include <algorithm>

namespace espalier::studio {

std::size_t KeptSteps::Step::bytes() const {
    std::size_t bytes = packet ? packet->size() : 0;
    for (const auto& string : strings) bytes += string->content();
    return bytes;
}

std::size_t KeptSteps::add(const timeline::Frame& frame) {
    Packet packet = writer_.write(frame);
    Step step;
    step.packet = std::make_shared<const std::string>(std::move(packet.bytes));
    for (const timeline::PlantFrame& plant : frame.plants) step.strings.push_back(plant.string);
    const std::lock_guard lock(mutex_);
    if (!packet.shapes.empty()) shapes_.push_back(std::move(packet.shapes));
    if (textures_.size() < writer_.textures().size()) textures_ = writer_.textures();
    in_memory_ += step.bytes();
    steps_[frame.step] = std::move(step);
    while (in_memory_ > memory_) file_oldest();
    return packet.internodes;
}

void KeptSteps::file_oldest() {
    if (!spool_) spool_ = std::make_unique<Spool>(file_);
    const auto oldest =
        std::find_if(steps_.begin(), steps_.end(), [](const auto& entry) { return entry.second.packet != nullptr; });
    Step& step = oldest->second;
    in_memory_ -= step.bytes();
    step.filed_packet = spool_->add(*step.packet);
    for (const auto& string : step.strings) {
        step.filed_strings.push_back({spool_->add_all(std::span<const LetterId>(string->letters)),
                                      spool_->add_all(std::span<const double>(string->parameters)),
                                      spool_->add_all(std::span<const Birth>(string->births)), string->siblings});
    }
    step.packet.reset();
    step.strings.clear();
}

bool KeptSteps::has(int step) const {
    const std::lock_guard lock(mutex_);
    return steps_.contains(step);
}

std::string KeptSteps::packet(int number) const {
    const Step kept = step(number);
    return kept.packet ? *kept.packet : spool_->text(kept.filed_packet);
}

std::vector<std::string> KeptSteps::shapes() const {
    const std::lock_guard lock(mutex_);
    return shapes_;
}

std::vector<WornPicture> KeptSteps::textures() const {
    const std::lock_guard lock(mutex_);
    return textures_;
}

std::vector<ModuleString> KeptSteps::strings(int number) const {
    const Step kept = step(number);
    std::vector<ModuleString> strings;
    for (std::size_t plant = 0; plant < std::max(kept.strings.size(), kept.filed_strings.size()); ++plant) {
        strings.push_back(read(kept, plant));
    }
    return strings;
}

ModuleString KeptSteps::string(int number, std::size_t plant) const {
    return read(step(number), plant);
}

KeptSteps::Step KeptSteps::step(int number) const {
    const std::lock_guard lock(mutex_);
    return steps_.at(number);
}

ModuleString KeptSteps::read(const Step& step, std::size_t plant) const {
    if (step.packet) return *step.strings.at(plant);
    const FiledString& filed = step.filed_strings.at(plant);
    ModuleString string;
    spool_->read(filed.letters, string.letters);
    spool_->read(filed.parameters, string.parameters);
    spool_->read(filed.births, string.births);
    string.siblings = filed.siblings;
    return string;
}

}  // namespace espalier::studio
