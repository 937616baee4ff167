#include "picture/files/vp9_film.h"

#include "espalier/base/error.h"

#include "picture/files/webm_file.h"

#include <fmt/format.h>
#include <vtkImageData.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vpx/vp8cx.h>
#include <vpx/vpx_encoder.h>

namespace espalier::picture {
namespace {

/// Of 0 (the best) to 63: the eye sees no difference in leaves, and 100 pictures take about 2 MB.
constexpr int quality = 28;
/// Of 0 (the smallest file) to 8.
constexpr int speed = 5;
constexpr unsigned pictures_between_keys = 60;  // where a player can jump to

/// The colours of a block of pixels by BT.601 in the range of television, in 65536ths.
struct Colour {
    int red = 0, green = 0, blue = 0;

    Colour& operator+=(const unsigned char* pixel) {
        red += pixel[0];
        green += pixel[1];
        blue += pixel[2];
        return *this;
    }
    /// Of the sum of `count` pixels.
    static unsigned char rounded(int sum, int zero, int count) {
        const int half = count * 32768;
        return static_cast<unsigned char>(zero + (sum + (sum < 0 ? -half : half)) / (count * 65536));
    }
    unsigned char luma() const { return rounded(16829 * red + 33039 * green + 6416 * blue, 16, 1); }
    unsigned char blue_difference(int count) const {
        return rounded(-9714 * red - 19070 * green + 28784 * blue, 128, count);
    }
    unsigned char red_difference(int count) const {
        return rounded(28784 * red - 24103 * green - 4681 * blue, 128, count);
    }
};

class Vp9Film final : public Film {
public:
    Vp9Film(const std::filesystem::path& path, const PictureSize& size, double pictures_per_second)
        : path_(path), file_(path, size, pictures_per_second) {
        vpx_codec_enc_cfg_t settings{};
        require(vpx_codec_enc_config_default(vpx_codec_vp9_cx(), &settings, 0));
        settings.g_w = static_cast<unsigned>(size.width);
        settings.g_h = static_cast<unsigned>(size.height);
        settings.g_timebase = {1000, std::max(1, static_cast<int>(std::lround(1000 * pictures_per_second)))};
        settings.g_threads = 1;
        settings.rc_end_usage = VPX_Q;
        settings.kf_max_dist = pictures_between_keys;
        require(vpx_codec_enc_init(&codec_, vpx_codec_vp9_cx(), &settings, 0));
        begun_ = true;
        require(vpx_codec_control(&codec_, VP8E_SET_CPUUSED, speed));
        require(vpx_codec_control(&codec_, VP8E_SET_CQ_LEVEL, quality));
        require(vpx_codec_control(&codec_, VP9E_SET_COLOR_SPACE, VPX_CS_SMPTE_170));
        require(vpx_codec_control(&codec_, VP9E_SET_COLOR_RANGE, VPX_CR_STUDIO_RANGE));
        if (!vpx_img_alloc(&image_, VPX_IMG_FMT_I420, settings.g_w, settings.g_h, 32)) fail("no memory");
    }
    ~Vp9Film() override {
        vpx_img_free(&image_);
        if (begun_) vpx_codec_destroy(&codec_);
    }
    Vp9Film(const Vp9Film&) = delete;
    Vp9Film& operator=(const Vp9Film&) = delete;

    void add(vtkImageData& picture) override {
        take(picture);
        require(vpx_codec_encode(&codec_, &image_, pictures_++, 1, 0, VPX_DL_GOOD_QUALITY));
        write_packets();
    }

    // The encoder looks ahead and holds pictures back.
    void finish() override {
        do require(vpx_codec_encode(&codec_, nullptr, pictures_, 1, 0, VPX_DL_GOOD_QUALITY));
        while (write_packets());
        file_.finish();
    }

private:
    /// Rows of a picture count from below, those of a film from above. Colours have a value for 2 x 2 pixels.
    void take(vtkImageData& picture) {
        const int* size = picture.GetDimensions();
        const int width = size[0], height = size[1];
        for (int y = 0; y < height; y += 2) {
            for (int x = 0; x < width; x += 2) {
                Colour block;
                int count = 0;
                for (int v = y; v < std::min(y + 2, height); ++v) {
                    for (int u = x; u < std::min(x + 2, width); ++u, ++count) {
                        const auto* pixel =
                            static_cast<const unsigned char*>(picture.GetScalarPointer(u, height - 1 - v, 0));
                        image_.planes[VPX_PLANE_Y][v * image_.stride[VPX_PLANE_Y] + u] = (Colour() += pixel).luma();
                        block += pixel;
                    }
                }
                image_.planes[VPX_PLANE_U][y / 2 * image_.stride[VPX_PLANE_U] + x / 2] = block.blue_difference(count);
                image_.planes[VPX_PLANE_V][y / 2 * image_.stride[VPX_PLANE_V] + x / 2] = block.red_difference(count);
            }
        }
    }

    bool write_packets() {
        bool any = false;
        vpx_codec_iter_t at = nullptr;
        while (const vpx_codec_cx_pkt_t* packet = vpx_codec_get_cx_data(&codec_, &at)) {
            if (packet->kind != VPX_CODEC_CX_FRAME_PKT) continue;
            any = true;
            file_.add({static_cast<const char*>(packet->data.frame.buf), packet->data.frame.sz},
                      (packet->data.frame.flags & VPX_FRAME_IS_KEY) != 0);
        }
        return any;
    }

    void require(vpx_codec_err_t result) const {
        if (result != VPX_CODEC_OK) fail(vpx_codec_err_to_string(result));
    }
    [[noreturn]] void fail(const char* why) const {
        throw RunError(fmt::format("cannot write {}: libvpx says: {}", path_.string(), why));
    }

    std::filesystem::path path_;
    WebmFile file_;
    vpx_codec_ctx_t codec_{};
    vpx_image_t image_{};
    bool begun_ = false;
    vpx_codec_pts_t pictures_ = 0;
};

}  // namespace

std::unique_ptr<Film> vp9_film(const std::filesystem::path& path, const PictureSize& size, double pictures_per_second) {
    return std::make_unique<Vp9Film>(path, size, pictures_per_second);
}

}  // namespace espalier::picture
