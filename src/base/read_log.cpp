#include "espalier/base/read_log.h"

#include <utility>

namespace espalier {
namespace {

thread_local ReadLog* log_of_thread = nullptr;

std::filesystem::path name_of(const std::filesystem::path& path) {
    return std::filesystem::absolute(path).lexically_normal();
}

}  // namespace

std::uint64_t digest(std::string_view bytes, std::uint64_t before) {
    std::uint64_t hash = before;
    for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001B3;
    return hash;
}

ReadLog::ReadLog(std::size_t most_kept, UnsavedTexts unsaved, std::optional<ReadPermission> permission)
    : most_kept_(most_kept),
      unsaved_(std::move(unsaved)),
      permission_(permission || !log_of_thread ? std::move(permission) : log_of_thread->permission_) {}

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

void ReadLog::note(const std::filesystem::path& path, std::string_view bytes, bool kept) {
    if (ReadLog* log = log_of_thread) log->add(path, bytes, kept);
}

std::optional<std::string> ReadLog::unsaved(const std::filesystem::path& path) {
    if (!log_of_thread || log_of_thread->unsaved_.empty()) return std::nullopt;
    const auto found = log_of_thread->unsaved_.find(name_of(path));
    return found == log_of_thread->unsaved_.end() ? std::nullopt : std::optional(found->second);
}

const ReadPermission* ReadLog::permission() {
    return log_of_thread && log_of_thread->permission_ ? &*log_of_thread->permission_ : nullptr;
}

void ReadLog::add(const std::filesystem::path& path, std::string_view bytes, bool kept) {
    const std::lock_guard lock(mutex_);
    const auto [place, is_new] = files_.try_emplace(name_of(path));
    if (!is_new) return;
    File& file = place->second;
    file.digest = digest(bytes);
    file.size = bytes.size();
    file.kept = kept && bytes.size() <= most_kept_ - kept_;
    if (!file.kept) return;
    file.bytes = bytes;
    kept_ += bytes.size();
}

}  // namespace espalier
