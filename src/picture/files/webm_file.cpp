#include "picture/files/webm_file.h"

#include "espalier/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace espalier::picture {
namespace {

// Identities of elements (RFC 8794, RFC 9559), with their length marks.
enum Element : std::uint32_t {
    ebml = 0x1A45DFA3,
    ebml_version = 0x4286,
    ebml_read_version = 0x42F7,
    ebml_max_id_length = 0x42F2,
    ebml_max_size_length = 0x42F3,
    doc_type = 0x4282,
    doc_type_version = 0x4287,
    doc_type_read_version = 0x4285,
    segment = 0x18538067,
    seek_head = 0x114D9B74,
    seek = 0x4DBB,
    seek_id = 0x53AB,
    seek_position = 0x53AC,
    info = 0x1549A966,
    timestamp_scale = 0x2AD7B1,
    duration = 0x4489,
    muxing_app = 0x4D80,
    writing_app = 0x5741,
    tracks = 0x1654AE6B,
    track_entry = 0xAE,
    track_number = 0xD7,
    track_uid = 0x73C5,
    track_type = 0x83,
    flag_lacing = 0x9C,
    codec_id = 0x86,
    default_duration = 0x23E383,
    video = 0xE0,
    pixel_width = 0xB0,
    pixel_height = 0xBA,
    colour = 0x55B0,
    matrix_coefficients = 0x55B1,
    range = 0x55B9,
    transfer_characteristics = 0x55BA,
    primaries = 0x55BB,
    cluster = 0x1F43B675,
    timestamp = 0xE7,
    simple_block = 0xA3,
    cues = 0x1C53BB6B,
    cue_point = 0xBB,
    cue_time = 0xB3,
    cue_track_positions = 0xB7,
    cue_track = 0xF7,
    cue_cluster_position = 0xF1,
};

constexpr std::uint64_t longest_cluster = 10'000;  // milliseconds; times in it have 16 bits

std::string big_endian(std::uint64_t number, int bytes) {
    std::string text;
    for (int i = bytes - 1; i >= 0; --i) text += static_cast<char>(number >> (8 * i) & 0xFF);
    return text;
}

std::string number_bytes(std::uint64_t number) {
    return big_endian(number, std::max(1, (static_cast<int>(std::bit_width(number)) + 7) / 8));
}

/// Always in eight bytes: sizes can be written over when they are known.
std::string size_bytes(std::uint64_t size) {
    return big_endian(size | std::uint64_t{1} << 56, 8);
}

std::string element(Element id, std::string_view content) {
    return number_bytes(id) + size_bytes(content.size()) + std::string(content);
}

std::string number(Element id, std::uint64_t value) {
    return element(id, number_bytes(value));
}

std::string real(Element id, double value) {
    return element(id, big_endian(std::bit_cast<std::uint64_t>(value), 8));
}

std::string head() {
    return element(ebml, number(ebml_version, 1) + number(ebml_read_version, 1) + number(ebml_max_id_length, 4) +
                             number(ebml_max_size_length, 8) + element(doc_type, "webm") + number(doc_type_version, 4) +
                             number(doc_type_read_version, 2));
}

/// Where the cues are, in eight bytes that are known at the end.
std::string place_of_cues(std::uint64_t place) {
    return element(seek, element(seek_id, number_bytes(cues)) + element(seek_position, big_endian(place, 8)));
}

std::string track(const PictureSize& size, double pictures_per_second) {
    // The matrix of BT.601 in the range of television, primaries of BT.709, transfer of sRGB. A film that does not say
    // so is shown by each browser in its own way: a green of 108 becomes 103 or 110.
    const std::string says =
        number(matrix_coefficients, 6) + number(range, 1) + number(transfer_characteristics, 13) + number(primaries, 1);
    const std::string shape = number(pixel_width, static_cast<std::uint64_t>(size.width)) +
                              number(pixel_height, static_cast<std::uint64_t>(size.height)) + element(colour, says);
    const auto nanoseconds = static_cast<std::uint64_t>(std::llround(1e9 / pictures_per_second));
    constexpr std::uint64_t moving_pictures = 1;
    return element(track_entry, number(track_number, 1) + number(track_uid, 1) + number(track_type, moving_pictures) +
                                    number(flag_lacing, 0) + element(codec_id, "V_VP9") +
                                    number(default_duration, nanoseconds) + element(video, shape));
}

constexpr std::uint64_t head_of_segment = 4 + 8;  // its identity and its size

}  // namespace

WebmFile::WebmFile(const std::filesystem::path& path, const PictureSize& size, double pictures_per_second)
    : path_(path), file_(path, std::ios::binary), pictures_per_second_(pictures_per_second) {
    write(head());
    segment_at_ = written_;
    write(number_bytes(segment) + size_bytes(0) + element(seek_head, place_of_cues(0)));
    const std::string before = number(timestamp_scale, 1'000'000), length = real(duration, 0);
    const std::string about = before + length + element(muxing_app, "Espalier") + element(writing_app, "Espalier");
    const std::string all = element(info, about);
    duration_at_ = written_ + (all.size() - about.size()) + before.size();
    write(all + element(tracks, track(size, pictures_per_second)));
}

std::uint64_t WebmFile::time_of(std::uint64_t picture) const {
    return static_cast<std::uint64_t>(std::llround(1000 * static_cast<double>(picture) / pictures_per_second_));
}

void WebmFile::add(std::string_view bytes, bool is_key) {
    const std::uint64_t time = time_of(pictures_++);
    if (is_key || time - cluster_time_ > longest_cluster) {
        write_cluster();
        cluster_time_ = time;
        if (is_key) cues_.push_back({time, written_ - segment_at_ - head_of_segment});
    }
    constexpr char track_one = '\x81', key = '\x80';
    cluster_ += element(simple_block,
                        track_one + big_endian(time - cluster_time_, 2) + (is_key ? key : '\0') + std::string(bytes));
}

void WebmFile::write_cluster() {
    if (cluster_.empty()) return;
    write(element(cluster, number(timestamp, cluster_time_) + cluster_));
    cluster_.clear();
}

void WebmFile::finish() {
    write_cluster();
    const std::uint64_t content_at = segment_at_ + head_of_segment, place = written_ - content_at;
    std::string points;
    for (const Cue& cue : cues_) {
        const std::string where = number(cue_track, 1) + number(cue_cluster_position, cue.place);
        points += element(cue_point, number(cue_time, cue.time) + element(cue_track_positions, where));
    }
    write(element(cues, points));
    write_at(segment_at_,
             number_bytes(segment) + size_bytes(written_ - content_at) + element(seek_head, place_of_cues(place)));
    write_at(duration_at_, real(duration, 1000 * static_cast<double>(pictures_) / pictures_per_second_));
    file_.close();
    if (!file_) throw RunError(fmt::format("cannot write {}", path_.string()));
}

void WebmFile::write(std::string_view bytes) {
    file_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!file_) throw RunError(fmt::format("cannot write {}", path_.string()));
    written_ += bytes.size();
}

void WebmFile::write_at(std::uint64_t place, std::string_view bytes) {
    file_.seekp(static_cast<std::streamoff>(place));
    file_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace espalier::picture
