#include "base/csv_file.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "base/folder.h"
#include "base/text.h"

#include <fmt/format.h>

#include <cmath>
#include <system_error>

namespace espalier {

namespace fs = std::filesystem;

namespace {

void require_written(const fs::path& path, const std::error_code& error) {
    if (error) throw RunError(fmt::format("cannot write {}: {}", path.string(), reason_of(error)));
}

fs::path kept_name(const fs::path& path) {
    return path.parent_path() / fmt::format(".{}.kept", path.filename().string());
}

bool has_at_least(const fs::path& path, std::size_t size) {
    std::error_code error;
    return fs::symlink_status(path, error).type() == fs::file_type::regular && fs::file_size(path, error) >= size &&
           !error;
}

void bring_back(const fs::path& path, std::size_t size) {
    std::error_code ignored;
    const fs::file_type type = fs::symlink_status(path, ignored).type();
    const bool is_lost =
        type == fs::file_type::not_found || (type == fs::file_type::regular && !has_at_least(path, size));
    if (!is_lost || !has_at_least(kept_name(path), size)) return;
    fs::remove(path, ignored);
    fs::create_hard_link(kept_name(path), path, ignored);
}

}  // namespace

CsvFile::CsvFile(const fs::path& path, std::string_view header) : path_(path) {
    forget(path);
    write_text(path, fmt::format("{}\n", header));
    open();
    size_ = header.size() + 1;
}

CsvFile::CsvFile(const fs::path& path, std::size_t size) : path_(path), size_(size) {
    bring_back(path, size);
    std::error_code error;
    const std::uintmax_t there = fs::file_size(path, error);
    if (error || there < size) {
        throw RunError(fmt::format("{} is shorter than it was at the checkpoint", path.string()));
    }
    open();
    require_written(path_, file_.truncate(size));
}

void CsvFile::keep() const {
    std::error_code ignored;
    const fs::path kept = kept_name(path_);
    if (!fs::exists(path_, ignored) || fs::equivalent(path_, kept, ignored)) return;
    fs::remove(kept, ignored);
    fs::create_hard_link(path_, kept, ignored);
}

void CsvFile::forget(const fs::path& path) {
    std::error_code ignored;
    fs::remove(kept_name(path), ignored);
}

void CsvFile::open() {
    std::error_code error;
    file_ = platform::OpenFile(path_, platform::OpenFile::Mode::append, error);
    require_written(path_, error);
}

void CsvFile::append(std::string_view lines) {
    if (const std::error_code error = file_.write(lines)) {
        require_written(path_, file_.truncate(size_));
        require_written(path_, error);
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

std::vector<std::string> csv_cells(std::string_view line, char separator) {
    std::vector<std::string> cells(1);
    bool quoted = false;
    for (const char c : line) {
        if (c == '"') {
            quoted = !quoted;
        } else if (c == separator && !quoted) {
            cells.emplace_back();
        } else {
            cells.back() += c;
        }
    }
    return cells;
}

}  // namespace espalier
