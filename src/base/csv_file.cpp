#include "base/csv_file.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "base/text.h"

#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <fcntl.h>
#include <system_error>
#include <unistd.h>

namespace espalier {
namespace {

[[noreturn]] void fail_to_write(const std::filesystem::path& path, int error) {
    throw RunError(fmt::format("cannot write {}: {}", path.string(), std::generic_category().message(error)));
}

}  // namespace

CsvFile::CsvFile(const std::filesystem::path& path, std::string_view header) : path_(path) {
    write_text(path, fmt::format("{}\n", header));
    descriptor_ = ::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
    if (descriptor_ < 0) fail_to_write(path, errno);
    size_ = header.size() + 1;
}

CsvFile::CsvFile(const std::filesystem::path& path, std::size_t size) : path_(path), size_(size) {
    std::error_code error;
    const std::uintmax_t there = std::filesystem::file_size(path, error);
    if (error || there < size) {
        throw RunError(fmt::format("{} is shorter than it was at the checkpoint", path.string()));
    }
    descriptor_ = ::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
    if (descriptor_ < 0 || ::ftruncate(descriptor_, static_cast<off_t>(size)) != 0) fail_to_write(path_, errno);
}

CsvFile::~CsvFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

void CsvFile::append(std::string_view lines) {
    std::string_view rest = lines;
    while (!rest.empty()) {
        const ssize_t written = ::write(descriptor_, rest.data(), rest.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) {
            const int error = errno;
            if (::ftruncate(descriptor_, static_cast<off_t>(size_)) != 0) fail_to_write(path_, errno);
            fail_to_write(path_, error);
        }
        rest.remove_prefix(static_cast<std::size_t>(written));
    }
    size_ += lines.size();
}

std::string csv_text(std::string_view text) {
    if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"') quoted += '"';
        quoted += c;
    }
    return quoted + '"';
}

std::string csv_number(double value) {
    return std::isfinite(value) ? format_exact(value) : "";
}

std::vector<std::string> csv_cells(std::string_view line) {
    std::vector<std::string> cells(1);
    bool quoted = false;
    for (const char c : line) {
        if (c == '"') {
            quoted = !quoted;
        } else if (c == ',' && !quoted) {
            cells.emplace_back();
        } else {
            cells.back() += c;
        }
    }
    return cells;
}

}  // namespace espalier
