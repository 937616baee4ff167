// The history of the organ that is picked, read by a thread of its own.
#pragma once

#include "espalier/archive/organ_history.h"

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace espalier::view {

class HistoryReader {
public:
    struct Answer {
        OrganHistory history;  ///< so far
        std::size_t done = 0, frames = 0;
        bool finished = false;
        std::string error;
    };

    HistoryReader();
    ~HistoryReader();
    HistoryReader(const HistoryReader&) = delete;
    HistoryReader& operator=(const HistoryReader&) = delete;

    /// Instead of what was asked before.
    void ask(std::shared_ptr<const RecordedRun> run, const OrganKey& organ, int seen_at);
    /// What is new since the last call.
    std::optional<Answer> poll();

private:
    struct Question {
        std::shared_ptr<const RecordedRun> run;
        OrganKey organ;
        int seen_at;
    };

    void work();
    Answer read(const Question& question);
    bool tell(Answer answer);

    std::mutex mutex_;
    std::condition_variable wake_;
    std::optional<Question> question_;
    std::optional<Answer> answer_;
    bool ending_ = false;
    OrganReader reader_;
    std::thread thread_;
};

}  // namespace espalier::view
