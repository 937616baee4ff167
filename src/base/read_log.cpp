#include "espalier/base/read_log.h"

#include <utility>

namespace espalier {
namespace {

thread_local ReadLog* log_of_thread = nullptr;

}  // namespace

std::uint64_t digest(std::string_view bytes, std::uint64_t before) {
    std::uint64_t hash = before;
    for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001B3;
    return hash;
}

ReadLog::ReadLog(std::size_t most_kept) : most_kept_(most_kept) {}

ReadLog::~ReadLog() = default;

ReadLog* ReadLog::current() {
    return log_of_thread;
}

ReadLog::Scope::Scope(ReadLog* log) : before_(std::exchange(log_of_thread, log)) {}

ReadLog::Scope::~Scope() {
    log_of_thread = before_;
}

std::map<std::filesystem::path, ReadLog::File> ReadLog::files() const {
    const std::lock_guard lock(mutex_);
    return files_;
}

void ReadLog::note(const std::filesystem::path& path, std::string_view bytes) {
    if (ReadLog* log = log_of_thread) log->add(path, bytes);
}

void ReadLog::add(const std::filesystem::path& path, std::string_view bytes) {
    const std::filesystem::path name = std::filesystem::absolute(path).lexically_normal();
    const std::lock_guard lock(mutex_);
    const auto [place, is_new] = files_.try_emplace(name);
    if (!is_new) return;
    File& file = place->second;
    file.digest = digest(bytes);
    file.size = bytes.size();
    file.kept = bytes.size() <= most_kept_ - kept_;
    if (!file.kept) return;
    file.bytes = bytes;
    kept_ += bytes.size();
}

}  // namespace espalier
