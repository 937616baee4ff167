// What pages see: a plant that grows, or a run that was recorded.
#pragma once

#include "espalier/base/error.h"
#include "espalier/base/read_log.h"
#include "espalier/studio/studio.h"

#include "environment/light/sky/scene_sky.h"
#include "studio/document/document.h"
#include "studio/packets/limb_axes.h"
#include "studio/packets/textures.h"
#include "studio/protocol/picked.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace espalier::studio {

class KeptSteps;

struct FieldDescription {
    std::string name, unit, meaning;
};

/// What is known once the files were read.
struct GrowthStart {
    std::map<std::filesystem::path, ReadLog::File> files;
    std::vector<std::string> plants;
    std::vector<Diagnostic> warnings;
    std::vector<FieldDescription> fields;
    int last_step = 0;
    std::uint64_t seed = 0;
    std::optional<environment::SceneSky> sky;    ///< of its light process, if that has one
    std::optional<DocumentState> recorded_from;  ///< what a recorded run grew from, if it tells
};

struct GrownStep {
    int step = 0, last_step = 0;
    std::size_t modules = 0, internodes = 0;
    int derived = 0;         ///< steps that were derived for it, and not taken from an earlier growth
    double seconds = 0;      ///< since it began
    std::string statistics;  ///< the rows of statistics.csv that this step added, with the header in the first
    std::map<std::string, std::string> units = {};  ///< of its columns that have one
    bool is_end = false;                            ///< no step follows
};

/// Told on the thread of what is shown.
class GrowthListener {
public:
    virtual ~GrowthListener() = default;
    virtual void started(std::uint32_t growth, GrowthStart start) = 0;
    /// A later step than all before can be shown, or it has become clear that none will follow.
    virtual void grown(std::uint32_t growth, GrownStep step) = 0;
    /// An earlier step can be shown; `statistics` as in GrownStep.
    virtual void drawn(std::uint32_t growth, int step, std::string statistics) = 0;
    /// Models have printed more; also in the midst of a step, and on any thread.
    virtual void printed(std::uint32_t growth, std::string text) = 0;
    /// It was told to stop before its end, and no more steps come.
    virtual void stopped(std::uint32_t growth) = 0;
    /// The next step may have so many modules: no more steps come until it is told to go on.
    virtual void asks(std::uint32_t growth, std::size_t modules) = 0;
    /// It could not be read, or did not go on. A growth that is told to end says nothing.
    virtual void failed(std::uint32_t growth, std::vector<Diagnostic> why) = 0;
};

/// Works beside the thread that serves and calls this.
class PlantSource {
public:
    virtual ~PlantSource() = default;

    virtual std::uint32_t number() const = 0;
    /// Returns the version of the document.
    virtual std::uint64_t version() const = 0;
    virtual const Opened& opened() const = 0;
    virtual double seconds() const = 0;  ///< since it began

    virtual bool has(int step) const = 0;
    /// It has been drawn.
    virtual bool has_packet(int step) const = 0;
    /// A step that has been derived is drawn next.
    virtual void draw(int step) = 0;
    // As docs/developer/studio-protocol.md has them. Packets and axes are those of a step that was drawn.
    virtual std::string packet(int step) const = 0;
    virtual LimbAxes limb_axes(int step) const = 0;
    virtual std::vector<std::string> shapes() const = 0;
    virtual std::vector<BrowserTexture> textures() const = 0;
    virtual std::vector<std::string> column_names() const = 0;
    virtual std::string column(int step, const std::string& name) const = 0;
    virtual Picked module_info(int step, std::uint32_t module) const = 0;
    /// Throws UserError if there is no such field at this step.
    virtual std::string field(int step, const std::string& name) const = 0;

    /// As it grows; null of a recorded run, and before a growth has started.
    virtual std::shared_ptr<const Scene> scene() const { return nullptr; }
    /// The steps that another growth may go on from; null: none.
    virtual std::shared_ptr<const KeptSteps> shared_steps() const { return nullptr; }
    /// Goes on to a later step, for a later version of the document that asks for nothing else. False if it cannot.
    virtual bool extend(int /*last_step*/, std::uint64_t /*version*/) { return false; }
    /// Steps that no page looks at are not drawn for the time being: another growth is to begin.
    virtual void pause_drawing(bool /*pauses*/) {}
    /// A growth that asks may be as large as it will.
    virtual void go_on() {}
    /// No more steps, but it still answers questions.
    virtual void stop() {}
    /// It ends after the step at hand.
    virtual void cancel() = 0;
    /// True once its work has ended: the destructor does not wait.
    virtual bool has_ended() const = 0;
};

}  // namespace espalier::studio
