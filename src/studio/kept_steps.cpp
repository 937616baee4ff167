#include "studio/kept_steps.h"

namespace espalier::studio {

std::size_t KeptSteps::add(const timeline::Frame& frame) {
    const Packet packet = writer_.write(frame);
    Step step{spool_.add(packet.bytes), {}};
    for (const timeline::PlantFrame& plant : frame.plants) {
        const ModuleString& string = *plant.string;
        step.strings.push_back({spool_.add_all(std::span<const LetterId>(string.letters)),
                                spool_.add_all(std::span<const double>(string.parameters)),
                                spool_.add_all(std::span<const Birth>(string.births)), string.siblings});
    }
    const std::lock_guard lock(mutex_);
    if (!packet.shapes.empty()) shapes_.push_back(packet.shapes);
    steps_[frame.step] = std::move(step);
    return packet.internodes;
}

bool KeptSteps::has(int step) const {
    const std::lock_guard lock(mutex_);
    return steps_.contains(step);
}

std::string KeptSteps::packet(int number) const {
    return spool_.text(step(number).packet);
}

std::vector<std::string> KeptSteps::shapes() const {
    const std::lock_guard lock(mutex_);
    return shapes_;
}

std::vector<ModuleString> KeptSteps::strings(int number) const {
    std::vector<ModuleString> strings;
    for (const KeptString& kept : step(number).strings) strings.push_back(read(kept));
    return strings;
}

ModuleString KeptSteps::string(int number, std::size_t plant) const {
    return read(step(number).strings.at(plant));
}

KeptSteps::Step KeptSteps::step(int number) const {
    const std::lock_guard lock(mutex_);
    return steps_.at(number);
}

ModuleString KeptSteps::read(const KeptString& kept) const {
    ModuleString string;
    spool_.read(kept.letters, string.letters);
    spool_.read(kept.parameters, string.parameters);
    spool_.read(kept.births, string.births);
    string.siblings = kept.siblings;
    return string;
}

}  // namespace espalier::studio
