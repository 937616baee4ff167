// Ranks that are threads of one program: what MPI does between processes, without it.
#pragma once

#include "espalier/simulation/ranks.h"

#include <barrier>
#include <cstddef>
#include <functional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

/// What the ranks have in common: a letter box from each to each.
class LetterBoxes {
public:
    explicit LetterBoxes(std::size_t count)
        : letters_(count, std::vector<std::string>(count)), all_(static_cast<std::ptrdiff_t>(count)) {}

    std::size_t count() const { return letters_.size(); }
    std::vector<std::string> trade(std::size_t rank, std::vector<std::string> to_each) {
        for (std::size_t to = 0; to < count(); ++to) letters_[to][rank] = std::move(to_each[to]);
        all_.arrive_and_wait();
        std::vector<std::string> received = std::move(letters_[rank]);
        letters_[rank].assign(count(), "");
        all_.arrive_and_wait();
        return received;
    }

private:
    std::vector<std::vector<std::string>> letters_;  // to each, from each
    std::barrier<> all_;
};

class ThreadRanks final : public espalier::Ranks {
public:
    ThreadRanks(LetterBoxes& boxes, std::size_t rank) : boxes_(boxes), rank_(rank) {}

    int rank() const override { return static_cast<int>(rank_); }
    int count() const override { return static_cast<int>(boxes_.count()); }
    std::string name() const override { return "rank " + std::to_string(rank_); }
    /// Two of them are on a machine.
    std::string node() const override { return "node " + std::to_string(rank_ / 2); }
    std::vector<std::string> trade(std::vector<std::string> to_each) override {
        for (std::size_t to = 0; to < to_each.size(); ++to) {
            if (to != rank_ && !to_each[to].empty()) count_sent(1, to_each[to].size());
        }
        return boxes_.trade(rank_, std::move(to_each));
    }

private:
    LetterBoxes& boxes_;
    std::size_t rank_;
};

/// Calls work(ranks) on as many threads; returns what each of them threw, as text: "" for nothing.
inline std::vector<std::string> on_ranks(std::size_t count, const std::function<void(espalier::Ranks&)>& work) {
    LetterBoxes boxes(count);
    std::vector<std::string> errors(count);
    std::vector<std::thread> threads;
    for (std::size_t rank = 0; rank < count; ++rank) {
        threads.emplace_back([&, rank] {
            ThreadRanks ranks(boxes, rank);
            try {
                work(ranks);
            } catch (const std::exception& error) {
                errors[rank] = error.what();
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    return errors;
}
