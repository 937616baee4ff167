#include "archive/vtk_xml.h"

#include "espalier/base/file.h"

#include "base/base64.h"
#include "base/number.h"
#include "base/text.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkDataCompressor.h>
#include <vtkLZ4DataCompressor.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkZLibDataCompressor.h>

#include <algorithm>
#include <array>
#include <span>

namespace espalier::archive {
namespace {

constexpr std::size_t most_ratio = 1100;  // zlib packs 1032 bytes into one at most, LZ4 255
/// What a block claims to unpack to is taken before it is known to be so: VTK's default is 32 KiB, a run's 256 KiB.
constexpr std::size_t largest_block = std::size_t{16} << 20;
constexpr std::uint64_t header_words = 3;  // number of blocks, size of a block, size of the last if it is a smaller one

std::vector<std::uint64_t> words(const std::vector<char>& bytes) {
    std::vector<std::uint64_t> result(bytes.size() / sizeof(std::uint64_t));
    if (!result.empty()) std::memcpy(result.data(), bytes.data(), result.size() * sizeof(std::uint64_t));
    return result;
}

/// VTK's inline data: the header in base64, then all blocks in base64. Returns false if it is damaged.
class CompressedBlocks {
public:
    explicit CompressedBlocks(vtkDataCompressor& compressor) : compressor_(compressor) {}

    bool read(std::string_view text, std::vector<char>& result) {
        return read_header(text) && decode_base64(text.substr(base64_length(header_.size() * 8)), packed_) &&
               unpack(result);
    }

private:
    bool read_header(std::string_view text) {
        std::vector<char> bytes;
        if (!decode_base64(text.substr(0, base64_length(header_words * 8)), bytes)) return false;
        header_ = words(bytes);
        if (header_.size() < header_words || header_[0] > text.size()) return false;
        const std::uint64_t all = header_words + header_[0];
        if (!decode_base64(text.substr(0, base64_length(all * 8)), bytes)) return false;
        header_ = words(bytes);
        return header_.size() == all;
    }

    bool unpack(std::vector<char>& result) {
        const std::uint64_t blocks = header_[0], partial = header_[2];
        result.clear();
        std::size_t at = 0;
        for (std::uint64_t block = 0; block < blocks; ++block) {
            const std::uint64_t packed = header_[header_words + block];
            const std::uint64_t plain = block + 1 == blocks && partial > 0 ? partial : header_[1];
            if (packed == 0 || packed > packed_.size() - at || plain > largest_block) return false;
            if (!unpack(at, packed, plain, result)) return false;
            at += packed;
        }
        return at == packed_.size();
    }

    bool unpack(std::size_t at, std::size_t packed, std::size_t plain, std::vector<char>& result) {
        const std::size_t before = result.size();
        result.resize(before + plain);
        const auto* from = reinterpret_cast<const unsigned char*>(packed_.data() + at);
        auto* to = reinterpret_cast<unsigned char*>(result.data() + before);
        return compressor_.Uncompress(from, packed, to, plain) == plain;
    }

    vtkDataCompressor& compressor_;
    std::vector<std::uint64_t> header_;
    std::vector<char> packed_;
};

/// Null for a name that the timeline does not write. VTK prints errors unless they are observed.
vtkSmartPointer<vtkDataCompressor> compressor_of(std::string_view name) {
    vtkSmartPointer<vtkDataCompressor> compressor;
    if (name == "vtkLZ4DataCompressor") compressor = vtkSmartPointer<vtkLZ4DataCompressor>::New();
    if (name == "vtkZLibDataCompressor") compressor = vtkSmartPointer<vtkZLibDataCompressor>::New();
    if (!compressor) return compressor;
    vtkNew<vtkCallbackCommand> silence;
    silence->SetCallback([](vtkObject*, unsigned long, void*, void*) {});
    compressor->AddObserver(vtkCommand::ErrorEvent, silence);
    compressor->AddObserver(vtkCommand::WarningEvent, silence);
    return compressor;
}

}  // namespace

VtkXmlFile::VtkXmlFile(const std::filesystem::path& path, const std::string& type)
    : path_(path), text_(read_text(path)) {
    try {
        root_ = parse_xml(text_);
    } catch (const XmlError& error) {
        fail(error.what());
    }
    data_set_ = root_.child(type);
    if (root_.attribute("type") != type || !data_set_ || root_.attribute("header_type") != "UInt64" ||
        root_.attribute("byte_order") != "LittleEndian" || !compressor_of(root_.attribute("compressor"))) {
        fail(fmt::format("it is no {} as a run writes it", type));
    }
}

const XmlElement& VtkXmlFile::piece() const {
    return child(*data_set_, "Piece");
}

const XmlElement& VtkXmlFile::child(const XmlElement& parent, std::string_view name) const {
    const XmlElement* found = parent.child(name);
    if (!found) fail(fmt::format("it has no element '{}'", name));
    return *found;
}

std::size_t VtkXmlFile::count(const XmlElement& element, std::string_view attribute) const {
    const std::string& text = element.attribute(attribute);
    const std::optional<std::size_t> value = whole_text_as<std::size_t>(text);
    if (!value || *value > text_.size() * most_ratio) {
        fail(fmt::format("{} is no number that can be right: '{}'", attribute, text));
    }
    return *value;
}

const XmlElement* VtkXmlFile::find(const XmlElement& section, std::string_view name) {
    const auto found = std::find_if(section.children.begin(), section.children.end(),
                                    [&](const XmlElement& array) { return array.attribute("Name") == name; });
    return found == section.children.end() ? nullptr : &*found;
}

const XmlElement& VtkXmlFile::needed(const XmlElement& section, std::string_view name) const {
    const XmlElement* found = find(section, name);
    if (!found) fail(fmt::format("it has no array '{}'", name));
    return *found;
}

VtkArray VtkXmlFile::array(const XmlElement& element) const {
    VtkArray result;
    result.type = element.attribute("type");
    if (!element.attribute("NumberOfComponents").empty()) {
        result.components = std::max<std::size_t>(1, count(element, "NumberOfComponents"));
    }
    const auto compressor = compressor_of(root_.attribute("compressor"));
    const bool binary = element.attribute("format") == "binary";
    if (!binary || !CompressedBlocks(*compressor).read(trimmed(element.text, " \t\r\n"), result.bytes)) {
        fail(fmt::format("the data of array '{}' are damaged", element.attribute("Name")));
    }
    return result;
}

std::vector<std::string> VtkXmlFile::texts(std::string_view name) const {
    const XmlElement* section = data_set_->child("FieldData");
    const XmlElement* element = section ? find(*section, name) : nullptr;
    std::vector<std::string> result;
    if (!element) return result;
    const VtkArray raw = array(*element);
    if (raw.type != "String") fail(fmt::format("array '{}' is of another type than a run writes", name));
    auto begin = raw.bytes.begin();
    for (auto end = std::find(begin, raw.bytes.end(), '\0'); end != raw.bytes.end();
         end = std::find(begin, raw.bytes.end(), '\0')) {
        result.emplace_back(begin, end);
        begin = end + 1;
    }
    return result;
}

void VtkXmlFile::fail(const std::string& what) const {
    throw UserError(fmt::format("{} is damaged: {}", path_.string(), what));
}

}  // namespace espalier::archive
