#include "view/history_reader.h"

#include "base/reason.h"

#include <utility>

namespace espalier::view {

HistoryReader::HistoryReader() : thread_([this] { work(); }) {}

HistoryReader::~HistoryReader() {
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
    }
    wake_.notify_all();
    thread_.join();
}

void HistoryReader::ask(std::shared_ptr<const RecordedRun> run, const OrganKey& organ, int seen_at) {
    {
        const std::lock_guard lock(mutex_);
        question_ = {std::move(run), organ, seen_at};
        answer_.reset();
    }
    wake_.notify_all();
}

std::optional<HistoryReader::Answer> HistoryReader::poll() {
    const std::lock_guard lock(mutex_);
    return std::exchange(answer_, std::nullopt);
}

// False if something else was asked meanwhile.
bool HistoryReader::tell(Answer answer) {
    const std::lock_guard lock(mutex_);
    if (ending_ || question_) return false;
    answer_ = std::move(answer);
    return true;
}

HistoryReader::Answer HistoryReader::read(const Question& question) {
    Answer answer;
    try {
        const auto progress = [&](const OrganHistory& so_far, std::size_t done, std::size_t frames) {
            return tell({so_far, done, frames, false, ""});
        };
        const auto history = reader_.history(*question.run, question.organ, question.seen_at, progress);
        if (history) answer.history = *history;
    } catch (const std::exception& error) {
        answer.error = reason_of(error);
    }
    answer.finished = true;
    return answer;
}

void HistoryReader::work() {
    std::unique_lock lock(mutex_);
    while (!ending_) {
        if (!question_) {
            wake_.wait(lock);
            continue;
        }
        const Question question = std::move(*question_);
        question_.reset();
        lock.unlock();
        tell(read(question));
        lock.lock();
    }
}

}  // namespace espalier::view
