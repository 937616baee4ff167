// The ranks of MPI: a module that the program opens when mpiexec or srun started it.
#include "espalier/base/error.h"
#include "espalier/simulation/ranks.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <mpi.h>
#include <thread>
#include <utility>

namespace espalier::app {
namespace {

// MPI counts in int.
constexpr std::size_t most_at_once = std::size_t{1} << 30;

class MpiRanks final : public Ranks {
public:
    MpiRanks() {
        int given = 0;
        MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &given);
        MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
        MPI_Comm_size(MPI_COMM_WORLD, &count_);
        char node[MPI_MAX_PROCESSOR_NAME];
        int length = 0;
        MPI_Get_processor_name(node, &length);
        node_.assign(node, static_cast<std::size_t>(length));
    }

    // All ranks come here when the run has ended or failed for all. One that fails alone must not let them wait.
    ~MpiRanks() override {
        if (!is_agreed() && count_ > 1) MPI_Abort(MPI_COMM_WORLD, 2);
        MPI_Finalize();
    }

    int rank() const override { return rank_; }
    int count() const override { return count_; }
    std::string node() const override { return node_; }
    std::string name() const override { return fmt::format("rank {} of {} on {}", rank_, count_, node_); }

    std::vector<std::string> trade(std::vector<std::string> to_each) override {
        const auto count = static_cast<std::size_t>(count_);
        std::vector<unsigned long long> sent(count), coming(count);
        for (std::size_t rank = 0; rank < count; ++rank) sent[rank] = to_each[rank].size();
        std::vector<MPI_Request> requests(1);
        MPI_Ialltoall(sent.data(), 1, MPI_UNSIGNED_LONG_LONG, coming.data(), 1, MPI_UNSIGNED_LONG_LONG, MPI_COMM_WORLD,
                      requests.data());
        wait(requests);
        std::vector<std::string> received(count);
        for (std::size_t rank = 0; rank < count; ++rank) {
            if (static_cast<int>(rank) == rank_) continue;
            received[rank].resize(coming[rank]);
            in_pieces(received[rank], [&](char* at, int size) {
                MPI_Irecv(at, size, MPI_BYTE, static_cast<int>(rank), 0, MPI_COMM_WORLD, &requests.emplace_back());
            });
        }
        for (std::size_t rank = 0; rank < count; ++rank) {
            if (static_cast<int>(rank) == rank_) continue;
            in_pieces(to_each[rank], [&](char* at, int size) {
                MPI_Isend(at, size, MPI_BYTE, static_cast<int>(rank), 0, MPI_COMM_WORLD, &requests.emplace_back());
                count_sent(1, static_cast<std::uint64_t>(size));
            });
        }
        wait(requests);
        received[static_cast<std::size_t>(rank_)] = std::move(to_each[static_cast<std::size_t>(rank_)]);
        return received;
    }

private:
    // MPI itself would wait at full speed, on a core that another rank may need.
    static void wait(std::vector<MPI_Request>& requests) {
        constexpr int most_at_speed = 100;
        constexpr std::chrono::microseconds pause(50);
        int done = 0;
        for (int tries = 0; !done; ++tries) {
            if (tries > most_at_speed) std::this_thread::sleep_for(pause);
            MPI_Testall(static_cast<int>(requests.size()), requests.data(), &done, MPI_STATUSES_IGNORE);
        }
        requests.clear();
    }

    template <class Piece>
    static void in_pieces(std::string& bytes, const Piece& piece) {
        for (std::size_t at = 0; at < bytes.size(); at += most_at_once) {
            piece(bytes.data() + at, static_cast<int>(std::min(most_at_once, bytes.size() - at)));
        }
    }

    int rank_ = 0, count_ = 1;
    std::string node_;
};

}  // namespace
}  // namespace espalier::app

extern "C" {

espalier::Ranks* espalier_ranks() {
    return new espalier::app::MpiRanks;
}

/// "Open MPI v4.1.4", "MPICH Version: 4.0.2".
const char* espalier_mpi_library() {
    static const std::string name = [] {
        char text[MPI_MAX_LIBRARY_VERSION_STRING];
        int length = 0;
        MPI_Get_library_version(text, &length);
        std::string first(text, static_cast<std::size_t>(length));
        first.resize(std::min(first.find_first_of(",\n"), first.size()));
        std::replace(first.begin(), first.end(), '\t', ' ');
        return first;
    }();
    return name.c_str();
}
}
