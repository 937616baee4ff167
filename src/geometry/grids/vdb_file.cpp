#include "geometry/grids/vdb_file.h"

#include "espalier/geometry/openvdb_grid.h"

#include "base/usable_memory.h"
#include "geometry/grids/vdb_tree.h"

#include <fmt/format.h>
#include <openvdb/io/io.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <utility>

namespace espalier::geometry {
namespace {

constexpr std::int64_t magic = 0x56444220;
constexpr std::uint32_t oldest_format = 222, newest_format = 224;
constexpr std::uint64_t uuid_length = 36;
constexpr std::string_view half_suffix = "_HalfFloat";

std::optional<VdbTree> tree_of(std::string_view type) {
    static const std::array<VdbTree, 4> known{
        VdbTree{"Tree_float_5_4_3", 4, 2, 1}, VdbTree{"Tree_double_5_4_3", 8, 2, 1},
        VdbTree{"Tree_vec3s_5_4_3", 12, 6, 3}, VdbTree{"Tree_vec3d_5_4_3", 24, 6, 3}};
    const bool is_half = type.ends_with(half_suffix);
    if (is_half) type.remove_suffix(half_suffix.size());
    const auto found =
        std::find_if(known.begin(), known.end(), [&](const VdbTree& tree) { return tree.grid_type == type; });
    if (found == known.end()) return std::nullopt;
    VdbTree tree = *found;
    tree.is_half = is_half;
    return tree;
}

// How many numbers of 64 bits each map has.
void require_transform(VdbBytes& file) {
    static const std::map<std::string, int> numbers{
        {"UniformScaleMap", 15},   {"ScaleMap", 15},  {"UniformScaleTranslateMap", 18},
        {"ScaleTranslateMap", 18}, {"AffineMap", 16}, {"UnitaryMap", 16},
        {"TranslationMap", 3}};
    const auto found = numbers.find(file.text());
    if (found == numbers.end()) throw VdbError("a grid in it has no regular lattice");
    for (int i = 0; i < found->second; ++i) {
        if (!std::isfinite(file.get<double>())) throw VdbError("a lattice in it is not made of finite numbers");
    }
}

// Texts and flags alone mean something here. OpenVDB's own reader would believe the lengths in the others, too.
openvdb::Metadata::Ptr known_metadata(const std::string& type, const std::string& bytes) {
    if (type == "string") return std::make_shared<openvdb::StringMetadata>(bytes);
    if (type == "bool" && bytes.size() == 1) return std::make_shared<openvdb::BoolMetadata>(bytes[0] != 0);
    return nullptr;
}

std::string without_suffix(const std::string& unique_name) {
    return unique_name.substr(0, unique_name.find('\x1e'));
}

/// What OpenVDB must know of a file whose grid it reads from the stream.
class TaggedStream {
public:
    TaggedStream(std::istream& in, const openvdb::VersionId& library, std::uint32_t format, std::uint32_t compression)
        : in_(in) {
        openvdb::io::setStreamMetadataPtr(in_, metadata_, /*transfer=*/false);
        openvdb::io::setVersion(in_, library, format);
        openvdb::io::setDataCompression(in_, compression);
        openvdb::io::setGridBackgroundValuePtr(in_, nullptr);
    }
    ~TaggedStream() {
        openvdb::io::setGridBackgroundValuePtr(in_, nullptr);
        openvdb::io::clearStreamMetadataPtr(in_);
    }
    TaggedStream(const TaggedStream&) = delete;
    TaggedStream& operator=(const TaggedStream&) = delete;

private:
    std::istream& in_;
    openvdb::io::StreamMetadata::Ptr metadata_ = std::make_shared<openvdb::io::StreamMetadata>();
};

}  // namespace

std::uint64_t memory_for_grids() {
    return usable_memory();
}

VdbFile::VdbFile(std::istream& in, std::uint64_t memory) : file_(in), memory_(memory) {
    initialize_openvdb();
    read_header();
    read_metadata();
    list_grids();
}

void VdbFile::read_header() {
    if (file_.size() < sizeof magic || file_.get<std::int64_t>() != magic) throw VdbError("it does not begin as one");
    format_ = file_.get<std::uint32_t>();
    if (format_ < oldest_format || format_ > newest_format) {
        throw VdbError(fmt::format("it has format {}; {} to {} are read, which programs write since 2013", format_,
                                   oldest_format, newest_format));
    }
    library_.first = file_.get<std::uint32_t>();
    library_.second = file_.get<std::uint32_t>();
    has_places_ = file_.get<char>() != 0;
    file_.skip(uuid_length);
}

openvdb::MetaMap VdbFile::read_metadata() {
    openvdb::MetaMap known;
    for (auto left = file_.get<std::uint32_t>(); left > 0; --left) {
        const std::string name = file_.text(), type = file_.text();
        const auto length = file_.get<std::uint32_t>();
        constexpr std::uint32_t longest_kept = 1 << 20;
        if (length > longest_kept) {
            file_.skip(length);
            continue;
        }
        if (const auto value = known_metadata(type, file_.text(length))) known.insertMeta(name, *value);
    }
    return known;
}

void VdbFile::list_grids() {
    for (auto left = file_.get<std::int32_t>(); left > 0; --left) {
        Entry entry;
        entry.unique_name = file_.text();
        entry.type = file_.text();
        entry.tree_of = file_.text();
        file_.skip(2 * sizeof(std::int64_t));  // where it and its values begin
        const auto end = static_cast<std::uint64_t>(file_.get<std::int64_t>());
        entry.begin = file_.position();
        if (has_places_ && end < entry.begin) throw VdbError("a place in it lies before another");
        file_.seek(has_places_ ? end : end_of(entry));
        names_.push_back(without_suffix(entry.unique_name));
        entries_.push_back(std::move(entry));
    }
}

std::uint64_t VdbFile::end_of(const Entry& entry) {
    std::optional<VdbTree> tree = tree_of(entry.type);
    if (!tree) throw VdbError(fmt::format("it does not say where a grid of type {} ends", entry.type));
    tree->memory = memory_;
    tree->compression = file_.get<std::uint32_t>();
    read_metadata();
    require_transform(file_);
    if (entry.tree_of.empty()) require_whole(file_, *tree);
    return file_.position();
}

const VdbFile::Entry& VdbFile::entry(const std::string& unique_name) const {
    const auto found = std::find_if(entries_.begin(), entries_.end(),
                                    [&](const Entry& entry) { return entry.unique_name == unique_name; });
    if (found == entries_.end()) throw VdbError(fmt::format("it has no grid '{}'", unique_name));
    return *found;
}

openvdb::GridBase::Ptr VdbFile::read(const std::string& name) {
    const auto found = std::find(names_.begin(), names_.end(), name);
    if (found == names_.end()) throw VdbError(fmt::format("it has no grid '{}'", name));
    const Entry& wanted = entries_[static_cast<std::size_t>(found - names_.begin())];
    openvdb::GridBase::Ptr grid = read(wanted);
    if (wanted.tree_of.empty()) return grid;
    const Entry& other = entry(wanted.tree_of);
    if (!other.tree_of.empty() || other.type != wanted.type) throw VdbError("two grids in it cannot share a tree");
    grid->setTree(read(other)->baseTreePtr());
    return grid;
}

openvdb::GridBase::Ptr VdbFile::read(const Entry& entry) {
    std::optional<VdbTree> tree = tree_of(entry.type);
    if (!tree) {
        throw VdbError(
            fmt::format("the grid '{}' is neither of numbers nor of vectors", without_suffix(entry.unique_name)));
    }
    file_.seek(entry.begin);
    tree->memory = memory_;
    tree->compression = file_.get<std::uint32_t>();
    const openvdb::GridBase::Ptr grid = openvdb::GridBase::createGrid(openvdb::Name(tree->grid_type));
    grid->setSaveFloatAsHalf(tree->is_half);
    const openvdb::MetaMap metadata = read_metadata();
    for (auto one = metadata.beginMeta(); one != metadata.endMeta(); ++one) grid->insertMeta(one->first, *one->second);
    const std::uint64_t begin = file_.position();
    require_transform(file_);
    const bool has_tree = entry.tree_of.empty();
    if (has_tree) require_whole(file_, *tree);
    const std::uint64_t end = file_.position();

    file_.seek(begin);
    std::istream& in = file_.stream();
    const TaggedStream tagged(in, library_, format_, tree->compression);
    grid->readTransform(in);
    if (has_tree) grid->readTopology(in);
    if (has_tree) grid->readBuffers(in);
    if (!in || static_cast<std::uint64_t>(in.tellg()) != end)
        throw VdbError("a grid in it ends elsewhere than it says");
    return grid;
}

}  // namespace espalier::geometry
