#include "timeline/files/collection_file.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "base/bytes.h"
#include "base/text.h"
#include "base/xml_text.h"

#include <fmt/format.h>

#include <string_view>
#include <system_error>

namespace espalier::timeline {
namespace {

using platform::OpenFile;

constexpr std::uint64_t most_index_bytes = std::uint64_t{1} << 32;
constexpr std::size_t page = 4096;  // the smallest there are
constexpr std::string_view opening =
    "<?xml version=\"1.0\"?>\n"
    "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
    "  <Collection>\n";
constexpr std::string_view closing = "  </Collection>\n</VTKFile>\n";

}  // namespace

void CollectionFile::add(double time, int part, const std::string& name, const std::string& file) {
    entries_ += fmt::format("    <DataSet timestep=\"{}\" group=\"\" part=\"{}\" name=\"{}\" file=\"{}\"/>\n",
                            format_exact(time), part, xml_text(name), xml_text(file));
}

// Writing the index anew after every frame costs the square of the frames, so what fits is put over the file's end. The
// kernel copies a write within one page whole or not at all, also when the program is killed; anything longer goes the
// way of every other file, beside and then renamed.
void CollectionFile::write() {
    const std::size_t at = opening.size() + written_;
    std::string tail = entries_.substr(written_) + std::string(closing);
    const bool within_page = at / page == (at + tail.size() - 1) / page;
    if (file_.is_open() && within_page) {
        extend(at, tail);
    } else {
        write_anew();
    }
    written_ = entries_.size();
}

void CollectionFile::write_anew() {
    file_.close();
    write_text(path_, fmt::format("{}{}{}", opening, entries_, closing));
    std::error_code ignored;  // without it every index is written anew
    file_ = OpenFile(path_, OpenFile::Mode::overwrite, ignored);
}

void CollectionFile::extend(std::size_t at, const std::string& tail) {
    const std::error_code error = file_.write_at(at, tail);
    if (!error) return;
    // The old end again: it takes no room that the file did not have.
    const bool restored = !file_.write_at(at, closing) && !file_.truncate(at + closing.size());
    throw RunError(
        fmt::format("cannot write {}: {}{}", path_.string(), error.message(), restored ? "" : "; its end is lost"));
}

void CollectionFile::save(std::ostream& out) const {
    put_text(out, entries_);
}

void CollectionFile::restore(std::istream& in) {
    entries_ = get_text(in, most_index_bytes);
    if (entries_.empty()) return;
    write_anew();
    written_ = entries_.size();
}

}  // namespace espalier::timeline
