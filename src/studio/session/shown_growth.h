// The growth that pages see, and what they are told of it.
#pragma once

#include "studio/growth/plant_source.h"
#include "studio/session/message.h"
#include "studio/session/page.h"

#include <cstdint>
#include <memory>
#include <string>

namespace espalier::studio {

class HandedFiles;

/// How far a growth has come.
struct GrowthProgress {
    std::string state = "done", reason;
    GrownStep newest;
};

class ShownGrowth {
public:
    ShownGrowth(std::unique_ptr<PlantSource> source, GrowthStart start);

    PlantSource& source() const { return *source_; }
    std::uint32_t number() const { return source_->number(); }
    const GrowthStart& start() const { return start_; }
    std::unique_ptr<PlantSource> release() { return std::move(source_); }

    Json progress_message(const GrowthProgress& progress) const;
    Json columns_message() const;
    Json fields_message() const;
    Json view_message() const;

    /// Now, or once it is drawn.
    void send_when_drawn(Viewer& viewer, int step, HandedFiles& files) const;
    /// The packet of a step that is drawn, behind the shapes and textures that the page does not have.
    void send(Viewer& viewer, int step, HandedFiles& files) const;

private:
    Json textures_message(HandedFiles& files) const;

    std::unique_ptr<PlantSource> source_;
    GrowthStart start_;
};

}  // namespace espalier::studio
