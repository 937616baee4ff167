#include "studio/growth/kept_steps.h"

#include <algorithm>

namespace espalier::studio {

KeptSteps::KeptSteps(std::uint32_t growth, const std::filesystem::path& file, std::size_t memory)
    : writer_(growth, file.parent_path()),
      file_(file),
      memory_(memory),
      fields_(std::make_shared<KeptMessages>(file.string() + "-fields")),
      organs_(std::make_shared<KeptMessages>(file.string() + "-organs")) {}

ModuleString KeptSteps::Step::string(std::size_t plant) const {
    ModuleString string = strings->string(plant);
    if (changes && changes->plants[plant]) changes->plants[plant]->apply(string);
    return string;
}

void KeptSteps::expect(const Scene& scene) {
    for (const Plant& plant : scene.plants) writer_.expect(plant.turtle.shapes);
}

int KeptSteps::inherit(const KeptSteps& before, const Origin& now) {
    std::map<int, Step> theirs, ours;
    int stopped_at = -1;
    {
        const std::lock_guard lock(before.mutex_);
        theirs = before.steps_;
        stopped_at = before.stopped_at_;
    }
    std::map<const Origin*, std::shared_ptr<const ReusePlan>> known;  // by where strings come from: a few at most
    int last = -1;
    for (auto& [number, step] : theirs) {
        const std::shared_ptr<const Origin>& origin = step.strings->origin();
        if (!origin || number != last + 1 || number > now.last_step) break;
        const auto [place, is_new] = known.try_emplace(origin.get());
        if (is_new) {
            if (std::optional<ReusePlan> found = reuse_plan(*origin, now)) {
                place->second = std::make_shared<const ReusePlan>(std::move(*found));
            }
        }
        const std::shared_ptr<const ReusePlan>& plan = place->second;
        if (!plan || number >= plan->steps) break;
        ours[number] = {
            nullptr, {}, step.strings, plan->changes_strings() ? plan : nullptr, std::move(step.quantities)};
        last = number;
    }
    if (now.exchanges) {
        if (last < now.last_step && last != stopped_at) return -1;
        fields_ = before.fields_;
        organs_ = before.organs_;
    }
    for (auto& [number, step] : ours) keep(number, std::move(step));
    if (last == stopped_at) note_stop(last);
    return last;
}

void KeptSteps::note_stop(int step) {
    const std::lock_guard lock(mutex_);
    stopped_at_ = step;
}

void KeptSteps::add_derived(DerivedStep derived, std::shared_ptr<const Origin> origin) {
    const int number = derived.step;
    keep(number, {nullptr, {}, std::make_shared<const StepStrings>(std::move(derived), std::move(origin)), nullptr});
}

std::size_t KeptSteps::add(const timeline::Frame& frame) {
    Packet packet = writer_.write(frame);
    Step drawn;
    {
        const std::lock_guard lock(mutex_);
        if (!packet.shapes.empty()) shapes_.push_back(std::move(packet.shapes));
        if (textures_.size() < writer_.textures().size()) textures_ = writer_.textures();
        if (const auto known = steps_.find(frame.step); known != steps_.end()) drawn = known->second;
    }
    if (!drawn.strings) {
        DerivedStep derived{frame.step, {}};
        for (const timeline::PlantFrame& plant : frame.plants) derived.plants.push_back({plant.string, ""});
        drawn.strings = std::make_shared<const StepStrings>(std::move(derived), nullptr);
    }
    if (drawn.quantities.empty()) {
        for (const timeline::PlantFrame& plant : frame.plants) drawn.quantities.push_back(plant.quantities);
    }
    drawn.drawing = std::make_shared<const Drawing>(Drawing{std::move(packet.bytes), std::move(packet.axes)});
    keep(frame.step, std::move(drawn));
    return packet.internodes;
}

void KeptSteps::keep(int number, Step step) {
    const std::lock_guard lock(mutex_);
    const auto [place, is_new] = steps_.try_emplace(number);
    if (!is_new) in_memory_ -= place->second.bytes();
    in_memory_ += step.bytes();
    place->second = std::move(step);
    while (in_memory_ > memory_) file_oldest();
}

void KeptSteps::file_oldest() {
    if (!spool_) spool_ = std::make_shared<Spool>(file_);
    const auto oldest =
        std::find_if(steps_.begin(), steps_.end(), [](const auto& entry) { return entry.second.is_in_memory(); });
    Step& step = oldest->second;
    in_memory_ -= step.bytes();
    if (step.drawing) step.filed_drawing = {spool_->add(step.drawing->packet), spool_->add(step.drawing->axes.bytes())};
    step.drawing.reset();
    if (!step.strings->is_filed()) step.strings = step.strings->filed(spool_);
    in_memory_ += step.bytes();
}

bool KeptSteps::has(int step) const {
    const std::lock_guard lock(mutex_);
    return steps_.contains(step);
}

bool KeptSteps::has_packet(int step) const {
    const std::lock_guard lock(mutex_);
    const auto found = steps_.find(step);
    return found != steps_.end() && (found->second.drawing || found->second.filed_drawing);
}

std::string KeptSteps::packet(int number) const {
    const Step kept = step(number);
    return kept.drawing ? kept.drawing->packet : spool_->text(kept.filed_drawing.value().packet);
}

LimbAxes KeptSteps::limb_axes(int number) const {
    const Step kept = step(number);
    if (kept.drawing) return kept.drawing->axes.axes(textures());
    return KeptAxes(spool_->text(kept.filed_drawing.value().axes)).axes(textures());
}

std::vector<std::string> KeptSteps::shapes() const {
    const std::lock_guard lock(mutex_);
    return shapes_;
}

std::vector<BrowserTexture> KeptSteps::textures() const {
    const std::lock_guard lock(mutex_);
    return textures_;
}

DerivedStep KeptSteps::derived(int number) const {
    const Step kept = step(number);
    DerivedStep derived = kept.strings->derived();
    for (std::size_t plant = 0; kept.changes && plant < derived.plants.size(); ++plant) {
        if (!kept.changes->plants[plant]) continue;
        auto string = std::make_shared<ModuleString>(*derived.plants[plant].string);
        kept.changes->plants[plant]->apply(*string);
        derived.plants[plant].string = std::move(string);
    }
    return derived;
}

std::vector<std::vector<Quantity>> KeptSteps::quantities(int number) const {
    return step(number).quantities;
}

std::vector<ModuleString> KeptSteps::strings(int number) const {
    const Step kept = step(number);
    std::vector<ModuleString> strings;
    for (std::size_t plant = 0; plant < kept.strings->plants(); ++plant) strings.push_back(kept.string(plant));
    return strings;
}

ModuleString KeptSteps::string(int number, std::size_t plant) const {
    return step(number).string(plant);
}

KeptSteps::Step KeptSteps::step(int number) const {
    const std::lock_guard lock(mutex_);
    return steps_.at(number);
}

}  // namespace espalier::studio
