// The fields of every frame: fields.pvd, fields/NAME/NNNN.vti for any viewer and fields/NAME/NNNN.vdb beside it.
//
// Parameters: fields (list of field names, default none; ["all"] for every field), field_files (list of "vti", "vdb";
// default both). A field that does not change is written once and named by every time step.
// The .vti has a value at every voxel's centre, over the domain or the active box, and field data unit and meaning.
#include "espalier/timeline/recorder.h"

#include "base/bytes.h"
#include "base/folder.h"
#include "base/text.h"
#include "geometry/grid_operations.h"
#include "timeline/files/collection_file.h"
#include "timeline/files/vti_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace espalier::timeline {
namespace {

class FieldRecorder final : public Recorder {
public:
    FieldRecorder(const Settings& settings, const RecorderContext& context)
        : folder_(context.folder),
          compression_(context.compression),
          collection_(context.folder / "fields.pvd"),
          names_(settings.texts_or("fields", {})),
          place_(settings.place("fields")) {
        const std::vector<std::string> known{"vti", "vdb"};
        const std::vector<std::string> files = settings.texts_or("field_files", known);
        for (const std::string& file : files) {
            if (std::find(known.begin(), known.end(), file) != known.end()) continue;
            throw UserError(settings.place("field_files"), fmt::format("'field_files' may hold vti and vdb, not '{}'{}",
                                                                       file, did_you_mean(file, known)));
        }
        vti_ = std::find(files.begin(), files.end(), "vti") != files.end();
        vdb_ = std::find(files.begin(), files.end(), "vdb") != files.end();
    }

    bool reads_plants() const override { return false; }
    std::vector<std::string> fields() const override { return names_; }
    void require(const Fields& fields) const override {
        const std::vector<std::string> known = names_of(fields);
        for (const std::string& name : names_) {
            if (!fields.find(name) && names_ != std::vector<std::string>{"all"}) {
                throw UserError(place_,
                                fmt::format("there is no field '{}'{}; the fields of this scene are: {}", name,
                                            did_you_mean(name, known),
                                            known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", "))));
            }
            if (name.empty() || name.front() == '.' || name.find('/') != std::string::npos) {
                throw UserError(place_,
                                fmt::format("field '{}' cannot be recorded: its name must serve as a folder's", name));
            }
        }
    }
    bool wanted() const { return !names_.empty() && (vti_ || vdb_); }

    void record(const Frame& frame) override {
        if (!frame.begins) return;
        if (written_.empty()) find_fields(*frame.fields);
        for (std::size_t i = 0; i < names_.size(); ++i) {
            const Field& field = *frame.fields->find(names_[i]);
            Written& last = written_[i];
            if (!is_written(field, last)) {
                last = {};  // in case the next line throws
                last.name = write(field, frame);
            }
            last.grid = field.grid;
            collection_.add(frame.time, static_cast<int>(i), names_[i], last.name + (vti_ ? ".vti" : ".vdb"));
        }
        collection_.write();
    }

    void finish() override {}

    void save(std::ostream& out) const override {
        collection_.save(out);
        // A run that goes on may be saved again before its first frame.
        const std::vector<Written>& files = written_.empty() ? restored_ : written_;
        put(out, static_cast<std::uint64_t>(files.size()));
        for (const Written& last : files) {
            put_text(out, last.name);
            put(out, last.grid ? grid_operations().digest(*last.grid) : last.digest);
        }
    }

    void restore(std::istream& in) override {
        collection_.restore(in);
        for (auto fields = get<std::uint64_t>(in); fields > 0; --fields) {
            Written last;
            last.name = get_text(in, 1 << 16);
            last.digest = get<std::uint64_t>(in);
            restored_.push_back(std::move(last));
        }
    }

private:
    /// The last files of a field.
    struct Written {
        std::string name;  ///< without extension
        std::shared_ptr<const FieldGrid> grid;
        std::uint64_t digest = 0;  ///< digest of the grid, all that a checkpoint holds of it
    };

    static std::vector<std::string> names_of(const Fields& fields) {
        std::vector<std::string> names;
        for (const auto& [name, field] : fields.all()) names.push_back(name);
        return names;
    }

    // At the first frame every process has provided its fields.
    void find_fields(const Fields& fields) {
        if (names_ == std::vector<std::string>{"all"}) names_ = names_of(fields);
        require(fields);
        written_ = restored_;
        written_.resize(names_.size());
    }

    // True if the last files show the field as it is.
    static bool is_written(const Field& field, const Written& last) {
        if (last.name.empty()) return false;
        if (!field.changes) return true;
        if (!field.grid) return false;
        const geometry::GridOperations& grids = grid_operations();
        return last.grid ? grids.same(*field.grid, *last.grid) : grids.digest(*field.grid) == last.digest;
    }

    // Returns the files' common name, without extension.
    std::string write(const Field& field, const Frame& frame) const {
        const std::string name = fmt::format("fields/{}/{:04}", field.name, frame.step);
        make_folder_below(folder_, std::filesystem::path("fields") / field.name);
        if (vti_) write_vti(folder_ / (name + ".vti"), field, frame.time, frame.step, compression_);
        if (vdb_) grid_operations().write_vdb(folder_ / (name + ".vdb"), field);
        return name;
    }

    std::filesystem::path folder_;
    Compression compression_;
    CollectionFile collection_;
    std::vector<std::string> names_;
    Place place_;
    bool vti_ = true, vdb_ = true;
    std::vector<Written> written_, restored_;  ///< per field
};

const Registered<RecorderType> entry{
    {"fields", "fields.pvd and fields/NAME/NNNN.vti, .vdb: the fields of the environment",
     "fields       []; names of the fields to write, as [\"light\"]; [\"all\"]: all fields\n"
     "field_files  [\"vti\", \"vdb\"]; the formats: vti for ParaView, vdb for OpenVDB",
     [](Settings& settings, const RecorderContext& context) -> std::unique_ptr<Recorder> {
         auto recorder = std::make_unique<FieldRecorder>(settings, context);
         if (!recorder->wanted()) return nullptr;
         return recorder;
     }}};

}  // namespace
}  // namespace espalier::timeline
