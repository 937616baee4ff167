#include "studio/session/shown_growth.h"

#include "simulation/run/view_record.h"
#include "studio/session/handed_files.h"
#include "studio/session/pages.h"
#include "studio/session/sky_message.h"

#include <utility>

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;

struct GrowthState {
    static constexpr TypeName type{"Growth", "how far a growth has come"};
    std::uint32_t growth = 0;
    std::uint64_t version = 0;
    std::string state;
    int step = 0, last = 0;
    std::size_t modules = 0, internodes = 0;
    int derived = 0;
    double seconds = 0;
    std::string reason;
    std::vector<std::string> plants;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("growth", self.growth, "its number: another number is another growth");
        field("version", self.version, "version of the document that grows");
        field("state", self.state,
              "`asks` before it becomes very large, `stopped` by a request, `failed` with a reason",
              one_of("growing asks done stopped failed"));
        field("step", self.step, "newest step; -1: none so far", at_least(-1));
        field("last", self.last, "step to which it grows");
        field("modules", self.modules, "of the newest step");
        field("internodes", self.internodes, "of the newest step");
        field("derived", self.derived, "steps that were derived for it; the others are those of an earlier growth");
        field("seconds", self.seconds, "from its beginning to the newest step");
        field("reason", self.reason, "why it failed, or what it asks");
        field("plants", self.plants, "names of its plants");
    }
};

struct ColumnNames {
    static constexpr TypeName type{"Columns", "what modules can be coloured by"};
    std::uint32_t growth = 0;
    std::vector<std::string> columns;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("growth", self.growth, "number of the growth");
        field("columns", self.columns, "names for `column`");
    }
};

struct FieldName {
    static constexpr TypeName type{"FieldName", "a field of a process"};
    std::string name, unit, meaning;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("name", self.name, "for `field`");
        field("unit", self.unit, "empty for a pure number");
        field("meaning", self.meaning, "what its numbers are");
    }
};

struct FieldNames {
    static constexpr TypeName type{"Fields", "the fields of a growth"};
    std::uint32_t growth = 0;
    std::vector<FieldName> fields;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("growth", self.growth, "number of the growth");
        field("fields", self.fields, "none of a recorded run");
    }
};

struct Textures {
    static constexpr TypeName type{"Textures", "pictures that plants wear"};
    std::uint32_t growth = 0;
    std::vector<Nullable<std::uint32_t>> files, reliefs;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("growth", self.growth, "number of the growth");
        field("files", self.files, "numbers for `/file/` of the colours, PNG or JPEG; null: none");
        field("reliefs", self.reliefs, "the same for their normals in tangent space");
    }
};

struct AuthorView {
    static constexpr TypeName type{"AuthorView", "how the author of a model looked at it, as in run.json"};
    std::array<double, 3> towards_eye{};
    double twist = 0;
    bool perspective = false;
    double angle = 0;
    std::optional<std::array<double, 3>> towards_light, background;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("towards_eye", self.towards_eye, "from the point that is looked at");
        field("twist", self.twist, "turn about the line of sight, degrees");
        field("perspective", self.perspective, "false: a parallel projection");
        field("angle", self.angle, "of the field of view, degrees");
        field("towards_light", self.towards_light, "missing if the view file says nothing of light");
        field("background", self.background, "red, green and blue, 0 to 1");
    }
};

struct ViewOfGrowth {
    static constexpr TypeName type{"View", "how a growth was looked at"};
    std::uint32_t growth = 0;
    Nullable<AuthorView> view;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("growth", self.growth, "number of the growth");
        field("view", self.view, "of the first plant with a view file; null if there is none");
    }
};

const Message<GrowthState> growth_message{
    "growth", "how far it has come; pages keep the old picture until the first packet of a new growth"};
const Message<ColumnNames> columns_message_type{"columns", "once a growth has started"};
const Message<FieldNames> fields_message_type{"fields", "once a growth has started"};
const Message<Textures> textures_message_type{"textures", "before a packet that wears more than those before it"};
const Message<ViewOfGrowth> view_message_type{"view", "once a growth has started"};

}  // namespace

ShownGrowth::ShownGrowth(std::unique_ptr<PlantSource> source, GrowthStart start)
    : source_(std::move(source)), start_(std::move(start)) {}

Json ShownGrowth::progress_message(const GrowthProgress& progress) const {
    const GrownStep& newest = progress.newest;
    return growth_message({number(), source_->version(), progress.state, newest.step, newest.last_step, newest.modules,
                           newest.internodes, newest.derived, newest.seconds, progress.reason, start_.plants});
}

Json ShownGrowth::columns_message() const {
    return columns_message_type({number(), source_->column_names()});
}

Json ShownGrowth::fields_message() const {
    FieldNames names{number(), {}};
    for (const FieldDescription& field : start_.fields) names.fields.push_back({field.name, field.unit, field.meaning});
    return fields_message_type(names);
}

Json ShownGrowth::view_message() const {
    ViewOfGrowth shown{number(), {}};
    const Json view = source_->scene() ? simulation::view_json(*source_->scene()) : Json();
    if (!view.is_null()) shown.view = from_json<AuthorView>(view);
    return view_message_type(shown);
}

Json ShownGrowth::textures_message(HandedFiles& files) const {
    const auto number_of = [&](const fs::path& file) {
        return file.empty() ? Nullable<std::uint32_t>() : Nullable<std::uint32_t>(files.number(file));
    };
    Textures textures{number(), {}, {}};
    for (const BrowserTexture& texture : source_->textures()) {
        textures.files.push_back(number_of(texture.colours));
        textures.reliefs.push_back(number_of(texture.normals));
    }
    return textures_message_type(textures);
}

void ShownGrowth::send_when_drawn(Viewer& viewer, int step, HandedFiles& files) const {
    if (source_->has_packet(step)) return send(viewer, step, files);
    viewer.awaits.insert(step);
    source_->draw(step);
}

void ShownGrowth::send(Viewer& viewer, int step, HandedFiles& files) const {
    viewer.awaits.erase(step);
    const std::vector<std::string> shapes = source_->shapes();
    if (viewer.growth != number()) viewer.shapes = viewer.textures = 0;
    viewer.growth = number();
    const std::size_t textures = source_->textures().size();
    if (std::exchange(viewer.textures, textures) < textures) Pages::send(viewer, textures_message(files));
    if (start_.sky) Pages::send(viewer, sky_message(number(), step, start_.sky->at_step(step)));
    for (; viewer.shapes < shapes.size(); ++viewer.shapes) viewer.page.send_bytes(shapes[viewer.shapes]);
    viewer.page.send_bytes(source_->packet(step));
}

}  // namespace espalier::studio
