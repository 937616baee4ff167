#include "picture/files/film.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"
#include "espalier/picture/render.h"

#include "base/platform.h"
#include "base/text.h"
#include "picture/files/vp9_film.h"

#include <fmt/format.h>
#include <vtkImageData.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace espalier::picture {
namespace {

namespace fs = std::filesystem;

// What a pixel's brightness and colour differences mean. Where a film does not say so, browsers guess, each in its own
// way: a green of 108 becomes 103 or 110.
constexpr const char* with_even_sides =
    "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=smpte170m:out_range=tv,format=yuv420p";
const std::vector<std::string> tags{"-colorspace",      "smpte170m", "-color_range", "tv",
                                    "-color_primaries", "bt709",     "-color_trc",   "iec61966-2-1"};

/// How each kind is encoded: for any player, with even sides where the format wants them.
std::vector<std::string> encoding_of(const std::string& extension) {
    if (extension == ".gif") {
        return {"-filter_complex",
                "split[a][b];[a]palettegen=max_colors=128[p];[b][p]paletteuse=dither=none:diff_mode=rectangle", "-loop",
                "0"};
    }
    std::vector<std::string> words{"-vf", with_even_sides};
    words.insert(words.end(), tags.begin(), tags.end());
    words.insert(words.end(), {"-c:v", "libx264", "-crf", "18", "-movflags", "+faststart"});
    return words;
}

constexpr const char* ffmpeg = "ffmpeg";

[[noreturn]] void reject_without_ffmpeg(const fs::path& path, const std::error_code& error) {
    throw RunError(
        fmt::format("{} is written by ffmpeg, which is not here ({}).\n"
                    "On Debian: apt-get install ffmpeg; .webm needs nothing more",
                    path.extension().string(), error.message()));
}

bool is_in_path(const std::string& program) {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path ? path : "/bin:/usr/bin");
    for (std::string folder; std::getline(folders, folder, ':');) {
        if (!platform::denied(fs::path(folder) / program, platform::Access::execute)) return true;
    }
    return false;
}

/// ffmpeg as a child that reads raw pictures.
class FfmpegFilm final : public Film {
public:
    FfmpegFilm(const fs::path& path, const PictureSize& size, double pictures_per_second) : path_(path) {
        std::vector<std::string> words{ffmpeg, "-hide_banner", "-loglevel", "error", "-y", "-f", "rawvideo"};
        const auto add = [&](const std::vector<std::string>& more) {
            words.insert(words.end(), more.begin(), more.end());
        };
        add({"-pix_fmt", "rgb24", "-s", fmt::format("{}x{}", size.width, size.height), "-r",
             fmt::format("{:g}", pictures_per_second), "-i", "pipe:0", "-an"});
        add(encoding_of(kind_of_file(path)));
        add({"-fflags", "+bitexact", "-flags:v", "+bitexact", "file:" + path.string()});
        start_ffmpeg(std::move(words));
    }
    ~FfmpegFilm() override {
        pictures_.close();
        if (child_ > 0) {
            platform::end(child_, platform::Ending::at_once);
            platform::wait_for(child_);
        }
    }
    FfmpegFilm(const FfmpegFilm&) = delete;
    FfmpegFilm& operator=(const FfmpegFilm&) = delete;

    // Rows of a picture count from below, those of a film from above.
    void add(vtkImageData& picture) override {
        const int* size = picture.GetDimensions();
        for (int row = size[1] - 1; row >= 0; --row) {
            const char* const pixels = static_cast<const char*>(picture.GetScalarPointer(0, row, 0));
            if (platform::send(pictures_, {pixels, 3 * static_cast<std::size_t>(size[0])})) fail();
        }
    }

    void finish() override {
        pictures_.close();
        if (platform::wait_for(std::exchange(child_, 0)) != 0) fail();
    }

private:
    void start_ffmpeg(std::vector<std::string> words) {
        // A connection, not a pipe: writing to an ffmpeg that has gone is then an error, not a signal that ends this
        // program.
        platform::OpenFile theirs;
        const std::error_code error =
            words_ ? platform::connect(pictures_, theirs) : std::error_code(errno, std::generic_category());
        if (error) throw RunError("cannot talk to ffmpeg: " + error.message());
        try {
            child_ = platform::start({std::move(words), {}, theirs.number(), platform::number_of(words_.get())});
        } catch (const std::system_error& missing) {
            reject_without_ffmpeg(path_, missing.code());
        }
    }

    /// With ffmpeg's own last words.
    [[noreturn]] void fail() {
        pictures_.close();
        if (child_ > 0) platform::wait_for(std::exchange(child_, 0));
        std::string said(4096, '\0');
        std::rewind(words_.get());
        said.resize(std::fread(said.data(), 1, said.size(), words_.get()));
        while (!said.empty() && said.back() == '\n') said.pop_back();
        throw RunError(fmt::format("ffmpeg did not write {}: {}", path_.string(), said));
    }

    fs::path path_;
    int child_ = 0;
    platform::OpenFile pictures_;
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> words_{std::tmpfile(), std::fclose};
};

}  // namespace

std::string kind_of_file(const fs::path& path) {
    return in_small_letters(path.extension().string());
}

void require_film_writer(const fs::path& path) {
    if (kind_of_file(path) != ".webm" && !is_in_path(ffmpeg))
        reject_without_ffmpeg(path, std::make_error_code(std::errc::no_such_file_or_directory));
}

std::unique_ptr<Film> film_of(const fs::path& path, const PictureSize& size, double pictures_per_second) {
    if (kind_of_file(path) == ".webm") return vp9_film(path, size, pictures_per_second);
    return std::make_unique<FfmpegFilm>(path, size, pictures_per_second);
}

}  // namespace espalier::picture
