// Reads a film of WebM as RFC 8794 and RFC 9559 say, and decodes its pictures.
#pragma once

#include <vtkImageData.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>
#include <vpx/vp8dx.h>
#include <vpx/vpx_decoder.h>

namespace espalier {

class WebmReader {
public:
    struct Picture {
        long time;  ///< milliseconds
        bool is_key;
        std::string_view bytes;
    };
    std::uint64_t width = 0, height = 0;
    double milliseconds = 0;
    std::string codec;
    std::map<std::uint64_t, std::uint64_t> colour;
    std::vector<Picture> pictures;
    std::vector<std::pair<std::uint64_t, std::uint64_t>> cues;  ///< time, place of the cluster in the segment

    explicit WebmReader(const std::string& bytes) {
        const Element head = element(bytes);
        if (head.id != 0x1A45DFA3 || value(head, 0x4282) != "webm") throw std::runtime_error("no WebM");
        const Element body = element(std::string_view(bytes).substr(head.size));
        if (body.id != 0x18538067 || head.size + body.size != bytes.size()) throw std::runtime_error("no segment");
        segment_ = body.content;
        for (const Element& part : elements(segment_)) read(part);
    }

    std::uint64_t cluster_time_at(std::uint64_t place) const {
        const Element cluster = element(segment_.substr(place));
        if (cluster.id != 0x1F43B675) throw std::runtime_error("no cluster there");
        return number(value(cluster, 0xE7));
    }

private:
    struct Element {
        std::uint64_t id;
        std::string_view content;
        std::size_t size;  ///< with its head
    };

    static std::uint64_t number(std::string_view bytes) {
        std::uint64_t result = 0;
        for (const char byte : bytes) result = result << 8 | static_cast<unsigned char>(byte);
        return result;
    }
    static std::size_t length(std::string_view bytes) {
        return static_cast<std::size_t>(std::countl_zero(static_cast<unsigned char>(bytes.at(0)))) + 1;
    }
    static Element element(std::string_view bytes) {
        const std::size_t of_id = length(bytes), of_size = length(bytes.substr(of_id));
        const std::uint64_t marked = number(bytes.substr(of_id, of_size));
        const auto size = static_cast<std::size_t>(marked & ~(std::uint64_t{1} << (7 * of_size)));
        if (of_id + of_size + size > bytes.size()) throw std::runtime_error("an element ends behind its own");
        return {number(bytes.substr(0, of_id)), bytes.substr(of_id + of_size, size), of_id + of_size + size};
    }
    static std::vector<Element> elements(std::string_view bytes) {
        std::vector<Element> result;
        for (; !bytes.empty(); bytes.remove_prefix(result.back().size)) result.push_back(element(bytes));
        return result;
    }
    static std::string_view value(const Element& parent, std::uint64_t id) {
        for (const Element& child : elements(parent.content)) {
            if (child.id == id) return child.content;
        }
        return {};
    }

    void read(const Element& part) {
        if (part.id == 0x1549A966) milliseconds = std::bit_cast<double>(number(value(part, 0x4489)));
        if (part.id == 0x1654AE6B) read_track(elements(part.content).at(0));
        if (part.id == 0x1F43B675) read_cluster(part);
        if (part.id != 0x1C53BB6B) return;
        for (const Element& point : elements(part.content)) {
            const Element where{0, value(point, 0xB7), 0};
            cues.emplace_back(number(value(point, 0xB3)), number(value(where, 0xF1)));
        }
    }
    void read_track(const Element& track) {
        codec = value(track, 0x86);
        const Element video{0, value(track, 0xE0), 0};
        width = number(value(video, 0xB0));
        height = number(value(video, 0xBA));
        for (const Element& said : elements(value(video, 0x55B0))) colour[said.id] = number(said.content);
    }
    void read_cluster(const Element& cluster) {
        const auto begin = static_cast<long>(number(value(cluster, 0xE7)));
        for (const Element& block : elements(cluster.content)) {
            if (block.id != 0xA3) continue;
            const auto after = static_cast<std::int16_t>(number(block.content.substr(1, 2)));
            pictures.push_back({begin + after, (block.content[3] & 0x80) != 0, block.content.substr(4)});
        }
    }

    std::string_view segment_;
};

/// Red, green and blue, the highest row first.
struct DecodedPicture {
    int width, height;
    std::vector<double> rgb;

    /// Mean difference from a picture whose rows count from below, of 255.
    double difference(vtkImageData& other) const {
        const int* size = other.GetDimensions();
        if (size[0] != width || size[1] != height) return 255;
        double sum = 0;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const auto* pixel = static_cast<const unsigned char*>(other.GetScalarPointer(x, height - 1 - y, 0));
                for (int k = 0; k < 3; ++k) {
                    sum += std::abs(rgb[static_cast<std::size_t>(3 * (y * width + x) + k)] - pixel[k]);
                }
            }
        }
        return sum / (3.0 * width * height);
    }
};

/// By BT.601 in the range of television.
inline DecodedPicture decoded_picture(const vpx_image_t& image) {
    DecodedPicture picture{static_cast<int>(image.d_w), static_cast<int>(image.d_h), {}};
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const auto sample = [&](int plane, int u, int v) {
                return image.planes[plane][v * image.stride[plane] + u];
            };
            const double luma = (sample(0, x, y) - 16) * 255.0 / 219;
            const double blue = (sample(1, x / 2, y / 2) - 128) * 255.0 / 224;
            const double red = (sample(2, x / 2, y / 2) - 128) * 255.0 / 224;
            for (const double part : {luma + 1.402 * red, luma - 0.344136 * blue - 0.714136 * red, luma + 1.772 * blue})
                picture.rgb.push_back(std::clamp(part, 0.0, 255.0));
        }
    }
    return picture;
}

inline std::vector<DecodedPicture> decoded_pictures(const WebmReader& film) {
    vpx_codec_ctx_t codec{};
    if (vpx_codec_dec_init(&codec, vpx_codec_vp9_dx(), nullptr, 0) != VPX_CODEC_OK) throw std::runtime_error("no VP9");
    std::vector<DecodedPicture> result;
    for (const WebmReader::Picture& picture : film.pictures) {
        const auto* bytes = reinterpret_cast<const std::uint8_t*>(picture.bytes.data());
        vpx_codec_decode(&codec, bytes, static_cast<unsigned>(picture.bytes.size()), nullptr, 0);
        vpx_codec_iter_t at = nullptr;
        while (const vpx_image_t* image = vpx_codec_get_frame(&codec, &at)) result.push_back(decoded_picture(*image));
    }
    vpx_codec_destroy(&codec);
    return result;
}

}  // namespace espalier
