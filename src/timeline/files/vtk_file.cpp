#include "timeline/files/vtk_file.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"
#include "espalier/base/read_log.h"

#include "base/parallel.h"
#include "base/xml_text.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <limits>
#include <span>

namespace espalier::timeline {
namespace {

/// Less than this is encoded in some milliseconds; the run, which goes on beside, needs its threads itself.
constexpr std::size_t worth_sharing = std::size_t{1} << 23;

std::string_view view(const Column<char>& text) {
    return {text.data(), text.size()};
}

}  // namespace

void VtkFile::begin_after(std::string_view type) {
    begin(type);
    after_ = true;
}

void VtkFile::begin(std::string_view type) {
    for (std::size_t i = count_; i < parts_.size(); ++i) parts_[i].encoded = false;  // left from files before the last
    count_ = 0;
    after_ = false;
    open_.clear();
    markup_ = "<?xml version=\"1.0\"?>\n";
    // Inline, not appended: readers older than VTK 9.3 mistake appended data for XML where the system's expat (2.5 of
    // Debian 12 as updated, 2.6) defers its parsing; Debian's ParaView 5.11 is one of them.
    open("VTKFile", fmt::format(R"(type="{}" version="1.0" byte_order="{}" header_type="UInt64" compressor="{}")", type,
                                std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian",
                                compression_ == Compression::zlib ? "vtkZLibDataCompressor" : "vtkLZ4DataCompressor"));
}

void VtkFile::open(std::string_view element, std::string_view attributes) {
    markup_ += fmt::format("<{}{}{}>\n", element, attributes.empty() ? "" : " ", attributes);
    open_.emplace_back(element);
}

void VtkFile::close() {
    markup_ += fmt::format("</{}>\n", open_.back());
    open_.pop_back();
}

void VtkFile::add(const DataArray& array) {
    add("DataArray", array, array.tuples);
}

void VtkFile::add_points(const DataArray& points) {
    const std::span<const float> numbers(static_cast<const float*>(points.values), 3 * points.tuples);
    bool finite = true;
    for (const float number : numbers) finite &= std::isfinite(number);
    if (!finite) {
        throw RunError(
            fmt::format("a point lies farther than {:.3g} from the origin, which no file of the timeline "
                        "can hold; are lengths or sizes too large?",
                        std::numeric_limits<float>::max()));
    }
    open("Points");
    add(points);
    close();
}

void VtkFile::add_texts(const std::string& name, const std::vector<std::string>& texts) {
    std::string bytes;
    for (const std::string& text : texts) bytes.append(text).push_back('\0');
    DataArray array = data_array<char>(name, bytes);
    add("Array", array, texts.size()).own(std::move(bytes));
}

void VtkFile::add_time(double time, int step) {
    const auto bytes = [](const auto& value) {
        return std::string(reinterpret_cast<const char*>(&value), sizeof value);
    };
    const std::int32_t number = step;
    add("DataArray", data_array<double>("TimeValue", {&time, 1}), 1).own(bytes(time));
    add("DataArray", data_array<std::int32_t>("step", {&number, 1}), 1).own(bytes(number));
}

VtkFile::Part& VtkFile::add(std::string_view element, const DataArray& array, std::size_t tuples) {
    if (count_ == parts_.size()) parts_.emplace_back();
    Part& part = parts_[count_++];
    part.markup = std::exchange(markup_, fmt::format("\n</{}>\n", element));
    part.markup +=
        fmt::format(R"(<{} type="{}" Name="{}" NumberOfComponents="{}" NumberOfTuples="{}" format="binary">)", element,
                    array.type, xml_text(array.name), array.components, tuples);
    part.markup += '\n';
    part.encoded = after_ && part.encoded && !array.changed && part.array.name == array.name;
    part.array = array;
    return part;
}

void VtkFile::encode_all() {
    std::size_t bytes = 0;
    for (std::size_t i = 0; i < count_; ++i) bytes += parts_[i].encoded ? 0 : parts_[i].array.bytes();
    const auto encode_some = [this](const tbb::blocked_range<std::size_t>& some) {
        for (std::size_t i = some.begin(); i < some.end(); ++i) {
            Part& part = parts_[i];
            if (part.encoded) continue;
            part.text.clear();
            encode(part.array, compression_, part.text);
            part.encoded = true;
        }
    };
    const tbb::blocked_range<std::size_t> all(0, count_);
    if (bytes < worth_sharing) {
        encode_some(all);
    } else {
        for_all_in_parallel(all, encode_some);
    }
}

std::vector<std::string_view> VtkFile::pieces() {
    while (!open_.empty()) close();
    encode_all();
    std::vector<std::string_view> pieces;
    for (std::size_t i = 0; i < count_; ++i) {
        pieces.push_back(parts_[i].markup);
        pieces.push_back(view(parts_[i].text));
    }
    pieces.push_back(markup_);
    return pieces;
}

void VtkFile::write(const std::filesystem::path& path) {
    write_text(path, pieces());
}

// One text after the other: all of them would take as much memory as the arrays.
std::uint64_t VtkFile::digest() {
    while (!open_.empty()) close();
    std::uint64_t sum = espalier::digest("");
    Column<char> text;
    for (std::size_t i = 0; i < count_; ++i) {
        text.clear();
        encode(parts_[i].array, compression_, text);
        sum = espalier::digest(view(text), espalier::digest(parts_[i].markup, sum));
    }
    return espalier::digest(markup_, sum);
}

}  // namespace espalier::timeline
