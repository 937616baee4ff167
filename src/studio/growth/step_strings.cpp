#include "studio/growth/step_strings.h"

namespace espalier::studio {

std::shared_ptr<const StepStrings> StepStrings::filed(const std::shared_ptr<Spool>& spool) const {
    DerivedStep empty{derived_.step, std::vector<DerivedStep::OfPlant>(plants()), derived_.births};
    auto filed = std::make_shared<StepStrings>(std::move(empty), origin_);
    filed->spool_ = spool;
    for (const DerivedStep::OfPlant& plant : derived_.plants) {
        const ModuleString& string = *plant.string;
        filed->filed_.push_back({spool->add_all(std::span<const LetterId>(string.letters)),
                                 spool->add_all(std::span<const double>(string.parameters)),
                                 spool->add_all(std::span<const Birth>(string.births)), spool->add(plant.memory),
                                 string.siblings});
    }
    return filed;
}

ModuleString StepStrings::string(std::size_t plant) const {
    if (!spool_) return *derived_.plants.at(plant).string;
    const FiledPlant& filed = filed_.at(plant);
    ModuleString string;
    spool_->read(filed.letters, string.letters);
    spool_->read(filed.parameters, string.parameters);
    spool_->read(filed.births, string.births);
    string.siblings = filed.siblings;
    return string;
}

DerivedStep StepStrings::derived() const {
    if (!spool_) return derived_;
    DerivedStep derived{derived_.step, {}, derived_.births};
    for (std::size_t i = 0; i < filed_.size(); ++i) {
        derived.plants.push_back({std::make_shared<const ModuleString>(string(i)), spool_->text(filed_[i].memory)});
    }
    return derived;
}

std::size_t StepStrings::bytes() const {
    std::size_t bytes = 0;
    for (const DerivedStep::OfPlant& plant : derived_.plants) {
        bytes += plant.memory.size() + (plant.string ? plant.string->content() : 0);
    }
    return bytes;
}

}  // namespace espalier::studio
