// Frames packed together in texts of a page.
#include "studio/server/frame_texts.h"

#include "espalier/archive/recorded_run.h"

#include "catch.h"
#include "page_letters.h"
#include "studio/packets/field_bytes.h"

#include <array>
#include <cstring>
#include <lzma.h>

namespace espalier::studio {
namespace {

std::string unpacked(const std::string& packed) {
    std::string bytes(1 << 20, '\0');
    std::uint64_t memory = UINT64_MAX;
    std::size_t in = 0, out = 0;
    REQUIRE(lzma_stream_buffer_decode(&memory, 0, nullptr, reinterpret_cast<const std::uint8_t*>(packed.data()), &in,
                                      packed.size(), reinterpret_cast<std::uint8_t*>(bytes.data()), &out,
                                      bytes.size()) == LZMA_OK);
    bytes.resize(out);
    return bytes;
}

std::vector<std::string> frames_of(const std::string& text) {
    const std::string bytes = unpacked(from_letters(text));
    std::vector<std::string> frames;
    for (std::size_t at = 0; at < bytes.size();) {
        std::uint32_t length;
        std::memcpy(&length, bytes.data() + at, 4);
        frames.push_back(bytes.substr(at + 4, length));
        at += 4 + length;
    }
    return frames;
}

}  // namespace

TEST_CASE("bytes come back from letters that need no escape, whatever their number", "[studio][share]") {
    std::string bytes;
    for (int i = 0; i < 300; ++i) {
        const std::string text = in_letters(bytes);
        CHECK(from_letters(text) == bytes);
        CHECK(text.find_first_of("<>&\"'\\`~") == std::string::npos);
        bytes += static_cast<char>(i * 167 + i * i / 7);
    }
    CHECK(in_letters(std::string(4, '\xff')).size() == 5);
}

TEST_CASE("every frame comes back in its order, eight in a text", "[studio][share]") {
    for (const std::size_t count : {0, 1, 7, 8, 9, 80}) {
        FrameTexts texts;
        for (std::size_t i = 0; i < count; ++i) texts.add(std::string(i * 37 % 101, static_cast<char>('a' + i % 26)));
        std::vector<std::string> frames;
        const std::vector<std::string> all = texts.take();
        CHECK(all.size() == (count + 7) / 8);
        for (const std::string& text : all) {
            for (std::string& frame : frames_of(text)) frames.push_back(std::move(frame));
        }
        REQUIRE(frames.size() == count);
        for (std::size_t i = 0; i < count; ++i) {
            CHECK(frames[i] == std::string(i * 37 % 101, static_cast<char>('a' + i % 26)));
        }
    }
}

TEST_CASE("what stays from frame to frame is packed once", "[studio][share]") {
    std::string frame;
    std::uint32_t number = 7;
    for (int i = 0; i < 40000; ++i) frame += static_cast<char>((number = number * 1664525 + 1013904223) >> 24);
    FrameTexts one, eight;
    one.add(frame);
    for (int i = 0; i < 8; ++i) {
        frame[static_cast<std::size_t>(i) * 4999] ^= 1;
        eight.add(frame);
    }
    CHECK(static_cast<double>(eight.take().front().size()) < 1.05 * static_cast<double>(one.take().front().size()));
}

TEST_CASE("a recorded field is told over its box, the nearest voxels where it has too many", "[studio][share]") {
    RecordedField field;
    field.name = "water";
    field.size = {2, 3, 100};
    field.origin = {1, -2, 0.5};
    field.voxel = {0.5, 1, 0.25};
    for (int i = 0; i < 600; ++i) field.values.push_back(static_cast<float>(i));
    const std::string bytes = field_bytes(field, 1, 7);
    std::array<std::uint32_t, 3> counts;
    std::array<float, 8> box;
    std::memcpy(counts.data(), bytes.data() + 12, 12);
    std::memcpy(box.data(), bytes.data() + 24, 32);
    CHECK(counts == std::array<std::uint32_t, 3>{2, 3, 64});
    CHECK(box == std::array<float, 8>{0.75f, -2.5f, 0.375f, 1.75f, 0.5f, 25.375f, 0, 599});
    const std::size_t values = bytes.size() - 2 * 3 * 64;
    CHECK(static_cast<unsigned char>(bytes[values]) == 0);
    CHECK(static_cast<unsigned char>(bytes.back()) == 255);
    // Layer 32 of 64 is layer 50 of 100.
    CHECK(static_cast<unsigned char>(bytes[values + 32 * 6]) == static_cast<int>(255 * 300 / 599.0 + 0.5));
}

}  // namespace espalier::studio
