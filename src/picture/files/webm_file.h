// WebM: the part of Matroska (RFC 9559) that browsers play, with one track of VP9.
#pragma once

#include "espalier/picture/chart_page.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::picture {

class WebmFile {
public:
    /// Throws RunError if nothing can be written there.
    WebmFile(const std::filesystem::path& path, const PictureSize& size, double pictures_per_second);

    /// One encoded picture. The first is a key picture, which needs no other. Throws RunError.
    void add(std::string_view bytes, bool is_key);
    /// Writes where key pictures are, so that players can jump to them. Without it the file is not complete.
    void finish();

private:
    struct Cue {
        std::uint64_t time, place;
    };

    std::uint64_t time_of(std::uint64_t picture) const;  ///< milliseconds
    void write_cluster();
    void write(std::string_view bytes);
    void write_at(std::uint64_t place, std::string_view bytes);

    std::filesystem::path path_;
    std::ofstream file_;
    double pictures_per_second_;
    std::uint64_t pictures_ = 0, written_ = 0, segment_at_ = 0, duration_at_ = 0;
    std::string cluster_;  ///< blocks that are not written yet
    std::uint64_t cluster_time_ = 0;
    std::vector<Cue> cues_;
};

}  // namespace espalier::picture
