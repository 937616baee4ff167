#include "studio/growth/spool.h"

#include "espalier/base/error.h"

#include <fmt/format.h>

#include <utility>

namespace espalier::studio {

Spool::Spool(std::filesystem::path file)
    : path_(std::move(file)), file_(path_, std::ios::in | std::ios::out | std::ios::trunc | std::ios::binary) {
    if (!file_) throw RunError(fmt::format("cannot make {}", path_.string()));
}

Spool::~Spool() {
    file_.close();
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
}

Spool::Place Spool::add(std::string_view bytes) {
    const std::lock_guard lock(mutex_);
    if (size_ + bytes.size() > most_bytes) {
        throw RunError(fmt::format(
            "the steps take more than {} GiB: grow fewer of them, or record the growth with `run`", most_bytes >> 30));
    }
    file_.seekp(static_cast<std::streamoff>(size_));
    file_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!file_.flush()) {
        file_.clear();
        throw RunError(fmt::format("cannot write {}: the disk is full?", path_.string()));
    }
    return {std::exchange(size_, size_ + bytes.size()), bytes.size()};
}

std::string Spool::text(Place place) const {
    std::string bytes(place.size, '\0');
    read(place, bytes.data());
    return bytes;
}

void Spool::read(Place place, char* at) const {
    const std::lock_guard lock(mutex_);
    file_.seekg(static_cast<std::streamoff>(place.offset));
    if (!file_.read(at, static_cast<std::streamsize>(place.size))) {
        file_.clear();
        throw RunError(fmt::format("cannot read {}", path_.string()));
    }
}

}  // namespace espalier::studio
