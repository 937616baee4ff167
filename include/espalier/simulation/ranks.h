// Several processes that grow one world together, each in its own memory: the ranks of MPI.
#pragma once

#include "espalier/base/stations.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace espalier::simulation {

/// What one rank knows of the others. All ranks call the same functions in the same order.
class Ranks {
public:
    virtual ~Ranks() = default;

    virtual int rank() const = 0;   ///< counts from 0
    virtual int count() const = 0;  ///< how many there are
    /// "rank 2 of 8 on node17", for messages.
    virtual std::string name() const = 0;
    /// The machine that it runs on; ranks on the same one share its memory.
    virtual std::string node() const { return {}; }

    /// Sends to_each[r] to rank r. Returns what each rank sent to this one, by rank. What is sent to oneself is moved.
    virtual std::vector<std::string> trade(std::vector<std::string> to_each) = 0;

    /// From now on all ranks know how the run ends.
    void agree() { is_agreed_ = true; }
    bool is_agreed() const { return is_agreed_; }

    /// What this rank has sent to others so far.
    std::uint64_t messages() const { return messages_; }
    std::uint64_t bytes() const { return bytes_; }

protected:
    void count_sent(std::uint64_t messages, std::uint64_t bytes) {
        messages_ += messages;
        bytes_ += bytes;
    }

private:
    std::uint64_t messages_ = 0, bytes_ = 0;
    bool is_agreed_ = false;
};

// The functions below take a null pointer for a world that one process grows alone.

/// True on the rank that writes the run, and where there are no others.
bool is_first(const Ranks* ranks);
/// Returns, on every rank, what each of them gave.
std::vector<std::string> from_all(Ranks* ranks, const std::string& own);
/// Returns, on every rank, what the first one gave.
std::string from_first(Ranks* ranks, const std::string& own);
/// How many ranks, this one among them, are on its machine; 1 where there are no others.
std::size_t ranks_on_node(Ranks* ranks);
/// Returns, on every rank, whether one of them gave true.
bool any(Ranks* ranks, bool own);
/// Does the work on every rank. If it fails on some, it throws on all: UserError, RunError or Stopped, with the message
/// and the name of the lowest rank that failed. Within `work` no rank may wait for another.
void together(Ranks* ranks, const std::function<void()>& work);

}  // namespace espalier::simulation
